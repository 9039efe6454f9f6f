#pragma once
// Splits one logical line of a GSD file and reads its values. Internal to the GSD reader.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bus/gsd/text.hpp"

namespace dsdpv1::bus::gsd {

/// `Keyword(index) = value`; every part may be missing.
struct Statement {
  std::string keyword;  ///< as written; empty if the line begins with none
  std::string key;      ///< the keyword in lower case
  std::optional<std::string> index;
  bool equals = false;
  std::string value;
  int line = 0;
  /// The keyword with its index, for messages: "Text(3)".
  std::string title() const { return index ? keyword + "(" + *index + ")" : keyword; }
};
Statement split_statement(const Line& line);

/// A whole number in decimal, hexadecimal (0x) or binary (0b) with an optional sign; nothing else may be in `text`.
std::optional<std::int64_t> to_number(std::string_view text);

/// Reads the values of one statement from left to right. A failed read reports one error at the statement's line, after
/// which the rest of the statement must be left alone.
class Values {
 public:
  Values(const Statement& statement, Diagnostics& diagnostics)
      : statement_(statement), rest_(trim(statement.value)), diagnostics_(diagnostics) {}

  bool at_end() const { return rest_.empty(); }
  bool at_string() const { return !rest_.empty() && rest_.front() == '"'; }
  /// A number between `low` and `high`.
  std::optional<std::int64_t> number(std::int64_t low, std::int64_t high);
  /// A quoted string; adjacent ones are joined, because some vendors wrap long texts.
  std::optional<std::string> string();
  /// A quoted string, or the unquoted rest of the line with a warning.
  std::string text();
  /// The rest as bytes 0..255 separated by commas; an empty list is an error.
  std::optional<Bytes> bytes();
  /// `low-high`, `value` and lists of both.
  std::optional<std::vector<GsdRange>> ranges();
  /// Warns if anything is left.
  void finish();

 private:
  bool accept(char c);
  /// The longest piece that may be a number: sign, digits, letters.
  std::string_view take_word();
  std::optional<std::int64_t> fail(std::string_view found, std::int64_t low, std::int64_t high);
  /// Between two values of a list. Returns false at its end.
  bool separator();

  const Statement& statement_;
  std::string_view rest_;
  Diagnostics& diagnostics_;
};

}  // namespace dsdpv1::bus::gsd
