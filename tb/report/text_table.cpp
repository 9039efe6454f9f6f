#include "tb/report/text_table.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "bus/printable.hpp"

namespace dsdpv1::tb {
namespace {

std::size_t limit = TableWidth::kUnlimited;

constexpr std::size_t kGap = 2;  ///< before each column

/// In characters: bytes of UTF-8 that continue one do not count.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// "-1.5", "40743", "56.917 ns".
bool is_number(const std::string& cell) {
  const std::size_t from = cell.rfind('-', 0) == 0 ? 1 : 0, end = std::min(cell.find(' '), cell.size());
  const std::string digits = cell.substr(from, end - from), unit = cell.substr(end);
  if (digits.empty() || digits.find_first_not_of("0123456789.") != std::string::npos) return false;
  if (digits.find('.') != digits.rfind('.')) return false;
  return unit.empty() || unit == " ns" || unit == " us" || unit == " ms" || unit == " s";
}

/// A number and its unit are one.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t from = text.find_first_not_of(' '); from != std::string::npos;) {
    const std::size_t end = std::min(text.find(' ', from), text.size());
    const std::string word = text.substr(from, end - from);
    if (!words.empty() && is_number(words.back() + " " + word))
      words.back() += " " + word;
    else
      words.push_back(word);
    from = text.find_first_not_of(' ', end);
  }
  return words;
}

std::size_t longest_word_of(const std::string& text) {
  std::size_t longest = 0;
  for (const std::string& word : words_of(text)) longest = std::max(longest, width_of(word));
  return longest;
}

/// Wraps between words; a longer word is kept whole.
std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  if (width_of(text) <= width) return {text};
  std::vector<std::string> lines;
  for (const std::string& word : words_of(text))
    if (!lines.empty() && width_of(lines.back()) + 1 + width_of(word) <= width)
      lines.back() += " " + word;
    else
      lines.push_back(word);
  return lines;
}

std::string padded(const std::string& text, std::size_t width, bool to_the_right) {
  const std::string blanks(width - std::min(width, width_of(text)), ' ');
  return to_the_right ? blanks + text : text + blanks;
}

std::ptrdiff_t lines_of(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

std::string without_end(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::size_t total(const std::vector<std::size_t>& widths) {
  return std::accumulate(widths.begin(), widths.end(), widths.size() * kGap);
}

/// The widest that can be narrower becomes so, until all fit or none can.
void narrow(std::vector<std::size_t>& widths, const std::vector<std::size_t>& least, std::size_t columns) {
  while (total(widths) > columns) {
    std::size_t widest = widths.size();
    for (std::size_t i = 0; i < widths.size(); ++i)
      if (widths[i] > least[i] && (widest == widths.size() || widths[i] > widths[widest])) widest = i;
    if (widest == widths.size()) return;
    --widths[widest];
  }
}

/// A row, as many lines as its cell of most lines has. `numbers`: which columns stand to the right.
std::string row_text(const std::vector<std::string>& row, const std::vector<std::size_t>& widths,
                     const std::vector<bool>& numbers) {
  std::vector<std::vector<std::string>> cells;
  std::size_t lines = 1;
  for (std::size_t i = 0; i < row.size(); ++i) {
    cells.push_back(wrapped(row[i], widths[i]));
    lines = std::max(lines, cells.back().size());
  }
  std::string text;
  for (std::size_t number = 0; number < lines; ++number) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += std::string(kGap, ' ') + padded(number < cells[i].size() ? cells[i][number] : "", widths[i], numbers[i]);
    text += without_end(line);
  }
  return text;
}

}  // namespace

TableWidth::TableWidth(std::size_t columns) : before_(std::exchange(limit, columns)) {}
TableWidth::~TableWidth() { limit = before_; }

std::string named_line(const std::string& name, const std::string& text, std::size_t columns) {
  const std::string shown = bus::printable(text);
  const std::size_t lead = std::max(columns, width_of(name)), taken = lead + 2 * kGap;
  return row_text({name, shown}, {lead, std::min(width_of(shown), limit > taken ? limit - taken : 1)}, {false, false});
}

std::string line_of(const std::string& text) {
  const std::string shown = bus::printable(text);
  return row_text({shown}, {std::min(width_of(shown), limit > kGap ? limit - kGap : 1)}, {false});
}

std::string wrapped_text(const std::string& text) {
  std::string lines;
  for (const std::string& line : wrapped(text, limit)) lines += without_end(line);
  return lines;
}

std::string command_lines(const std::string& command) {
  constexpr std::size_t kTaken = 3 * kGap + 2;  // by blanks and the backslash
  if (width_of(command) <= limit) return without_end(command);
  std::string lines;
  for (const std::string& part : wrapped(command, limit > kTaken ? limit - kTaken : 1))
    lines += (lines.empty() ? std::string(kGap, ' ') : " \\\n" + std::string(3 * kGap, ' ')) + part;
  return lines + "\n";
}

void TextTable::add(std::vector<std::string> row) {
  for (std::string& cell : row) cell = bus::printable(cell);
  rows_.push_back(std::move(row));
}

bool TextTable::fits() const { return total(widths_of(width_of)) <= limit; }

std::string TextTable::text() const {
  Widths widths = widths_of(width_of);
  narrow(widths, widths_of(longest_word_of), limit);
  if (total(widths) > limit) return as_blocks(limit);
  std::string columns = as_columns(widths);
  if (widths == widths_of(width_of)) return columns;
  std::string blocks = as_blocks(limit);
  return lines_of(columns) <= lines_of(blocks) ? columns : blocks;
}

/// True for a column with a number in a cell, and only numbers, "-" and empty cells in the others.
std::vector<bool> TextTable::columns_of_numbers() const {
  std::vector<bool> some, only;
  for (const auto& row : rows_) {
    some.resize(std::max(some.size(), row.size()));
    only.resize(some.size(), true);
  }
  for (std::size_t row = 1; row < rows_.size(); ++row)
    for (std::size_t i = 0; i < rows_[row].size(); ++i) {
      const std::string& cell = rows_[row][i];
      if (is_number(cell))
        some[i] = true;
      else if (!cell.empty() && cell != "-")
        only[i] = false;
    }
  for (std::size_t i = 0; i < some.size(); ++i) some[i] = some[i] && only[i];
  return some;
}

TextTable::Widths TextTable::widths_of(std::size_t (*width)(const std::string& cell)) const {
  Widths widths;
  for (const auto& row : rows_) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  }
  return widths;
}

std::string TextTable::as_columns(const Widths& widths) const {
  std::string rule;
  for (const std::size_t width : widths) rule += std::string(kGap, ' ') + std::string(width, '-');
  const std::vector<bool> numbers = columns_of_numbers();
  std::string text = row_text(rows_.front(), widths, numbers) + rule + "\n";
  for (std::size_t i = 1; i < rows_.size(); ++i) text += row_text(rows_[i], widths, numbers);
  return text;
}

/// The head's word before each cell, an empty line between two rows.
std::string TextTable::as_blocks(std::size_t columns) const {
  const std::vector<std::string>& head = rows_.front();
  std::size_t name = 0;
  for (const std::string& each : head) name = std::max(name, width_of(each));
  const Widths widths = {name, columns > name + 2 * kGap ? columns - name - 2 * kGap : 1};
  std::string text;
  for (std::size_t i = 1; i < rows_.size(); ++i) {
    if (i > 1) text += '\n';
    for (std::size_t cell = 0; cell < std::min(head.size(), rows_[i].size()); ++cell)
      text += row_text({head[cell], rows_[i][cell]}, widths, {false, false});
  }
  return text;
}

}  // namespace dsdpv1::tb
