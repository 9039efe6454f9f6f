#include "tb/report/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/printable.hpp"

namespace tb {

void TextTable::add(std::vector<std::string> row) {
  for (std::string& cell : row) cell = bus::printable(cell);
  widths_.resize(std::max(widths_.size(), row.size()));
  for (std::size_t i = 0; i < row.size(); ++i) widths_[i] = std::max(widths_[i], row[i].size());
  rows_.push_back(std::move(row));
}

std::string TextTable::text() const {
  std::string text;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    text += line(rows_[r]);
    if (r == 0) text += rule();
  }
  return text;
}

std::string TextTable::line(const std::vector<std::string>& row) const {
  std::string text = " ";
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool last = i + 1 == row.size();
    text += last ? " " + row[i] : fmt::format(" {:<{}} ", row[i], widths_[i]);
  }
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

std::string TextTable::rule() const {
  std::string text = " ";
  for (const std::size_t width : widths_) text += " " + std::string(width, '-') + " ";
  text.pop_back();
  return text + "\n";
}

}  // namespace tb
