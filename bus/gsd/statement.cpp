#include "bus/gsd/statement.hpp"

#include <cctype>
#include <limits>

#include <fmt/format.h>

#include "bus/gsd/keywords.hpp"

namespace dsdpv1::bus::gsd {
namespace {

bool is_keyword_char(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; }

std::string_view take_keyword(std::string_view& rest) {
  std::size_t size = 0;
  while (size < rest.size() && is_keyword_char(rest[size])) ++size;
  const std::string_view keyword = rest.substr(0, size);
  rest = trim(rest.substr(size));
  return keyword;
}

/// "Unit_Diag_ !Bit": some files have blanks after an underscore, and a '!' for the text of a bit that is 0.
void take_rest_of_keyword(std::string& keyword, std::string_view& rest) {
  if (keyword.empty() || keyword.back() != '_') return;
  if (!rest.empty() && rest.front() == '!') {
    keyword += '!';
    rest = trim(rest.substr(1));
  }
  keyword += take_keyword(rest);
}

/// "24V Pins = 0": a known keyword with blanks for underscores.
void take_words(std::string& keyword, std::string_view& rest) {
  const std::size_t equals = rest.find('=');
  if (equals == 0 || equals == std::string_view::npos) return;
  const std::string words = fmt::format("{} {}", keyword, trim(rest.substr(0, equals)));
  if (guess_keyword(words) == nullptr) return;
  keyword = words;
  rest = rest.substr(equals);
}

std::optional<std::string> take_index(std::string_view& rest) {
  if (rest.empty() || rest.front() != '(') return std::nullopt;
  const std::size_t end = rest.find(')');
  if (end == std::string_view::npos) return std::nullopt;
  std::string index(trim(rest.substr(1, end - 1)));
  rest = trim(rest.substr(end + 1));
  return index;
}

/// -1 unless `c` is a digit.
int digit_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const int letter = std::tolower(static_cast<unsigned char>(c));
  return letter >= 'a' && letter <= 'f' ? letter - 'a' + 10 : -1;
}

int take_base(std::string_view& text) {
  if (text.size() < 2 || text[0] != '0') return 10;
  const int letter = std::tolower(static_cast<unsigned char>(text[1]));
  const int base = letter == 'x' ? 16 : letter == 'b' ? 2 : 10;
  if (base != 10) text.remove_prefix(2);
  return base;
}

constexpr std::int64_t kHuge = std::numeric_limits<std::int64_t>::max() / 32;  // beyond every range of a GSD file

}  // namespace

Statement split_statement(const Line& line) {
  Statement statement;
  statement.line = line.number;
  if (is_number_list(line.text)) {
    statement.value = line.text;
    return statement;
  }
  std::string_view rest = line.text;
  statement.keyword = std::string(take_keyword(rest));
  take_rest_of_keyword(statement.keyword, rest);
  take_words(statement.keyword, rest);
  statement.key = lower(statement.keyword);
  statement.index = take_index(rest);
  statement.equals = !rest.empty() && rest.front() == '=';
  if (statement.equals) rest = trim(rest.substr(1));
  statement.value = std::string(rest);
  return statement;
}

std::optional<std::int64_t> to_number(std::string_view text) {
  const bool negative = !text.empty() && text.front() == '-';
  if (negative || (!text.empty() && text.front() == '+')) text.remove_prefix(1);
  const int base = take_base(text);
  if (text.empty()) return std::nullopt;
  std::int64_t value = 0;
  for (const char c : text) {
    const int digit = digit_value(c);
    if (digit < 0 || digit >= base) return std::nullopt;
    value = value > kHuge ? kHuge : value * base + digit;
  }
  return negative ? -value : value;
}

bool Values::accept(char c) {
  if (rest_.empty() || rest_.front() != c) return false;
  rest_ = trim(rest_.substr(1));
  return true;
}

std::string_view Values::take_word() {
  std::size_t size = !rest_.empty() && (rest_.front() == '-' || rest_.front() == '+') ? 1 : 0;
  while (size < rest_.size() && is_keyword_char(rest_[size])) ++size;
  const std::string_view word = rest_.substr(0, size);
  rest_ = trim(rest_.substr(size));
  return word;
}

std::optional<std::int64_t> Values::fail(std::string_view found, std::int64_t low, std::int64_t high) {
  const std::string what = statement_.keyword.empty() ? "the line" : statement_.title();
  const std::string is = found.empty() ? "has no number where one is needed" : fmt::format("is {}", found);
  diagnostics_.error(statement_.line, fmt::format("{} {}, {} to {} is allowed", what, is, low, high));
  return std::nullopt;
}

std::optional<std::int64_t> Values::number(std::int64_t low, std::int64_t high) {
  const std::string_view all = rest_;
  const std::string_view word = take_word();
  const auto value = to_number(word);
  if (!value || *value < low || *value > high) return fail(word.empty() ? all : word, low, high);
  return value;
}

std::optional<std::string> Values::string() {
  if (!at_string()) {
    diagnostics_.error(statement_.line, fmt::format("{} has no name, a text in quotes is needed", statement_.title()));
    return std::nullopt;
  }
  std::string result;
  while (at_string()) {
    const std::size_t end = rest_.find('"', 1);  // strings in logical lines are always closed
    result += rest_.substr(1, end - 1);
    rest_ = trim(rest_.substr(end + 1));
  }
  return result;
}

std::string Values::text() {
  if (at_string()) return *string();
  diagnostics_.warning(statement_.line, fmt::format("{} is not in quotes", statement_.title()));
  std::string result(rest_);
  rest_ = {};
  return result;
}

bool Values::separator() {
  const bool comma = accept(',');
  if (at_end()) {
    if (comma)
      diagnostics_.warning(statement_.line, fmt::format("the list of {} ends with a comma", statement_.title()));
    return false;
  }
  if (!comma)
    diagnostics_.warning(statement_.line, fmt::format("a comma is missing in the list of {}", statement_.title()));
  return true;
}

std::optional<Bytes> Values::bytes() {
  Bytes result;
  do {
    const auto value = number(0, 255);
    if (!value) return std::nullopt;
    result.push_back(static_cast<std::uint8_t>(*value));
  } while (separator());
  return result;
}

std::optional<std::vector<GsdRange>> Values::ranges() {
  constexpr std::int64_t kLimit = 0xFFFFFFFF;
  std::vector<GsdRange> result;
  do {
    const auto low = number(-kLimit, kLimit);
    if (!low) return std::nullopt;
    const auto high = accept('-') ? number(-kLimit, kLimit) : low;
    if (!high) return std::nullopt;
    if (*high < *low) {
      diagnostics_.error(statement_.line,
                         fmt::format("the range {}-{} is empty, the lower value comes first", *low, *high));
      return std::nullopt;
    }
    result.push_back({*low, *high});
  } while (separator());
  return result;
}

void Values::finish() {
  if (!at_end())
    diagnostics_.warning(statement_.line,
                         fmt::format("\"{}\" behind the value of {} is ignored", rest_, statement_.title()));
}

}  // namespace dsdpv1::bus::gsd
