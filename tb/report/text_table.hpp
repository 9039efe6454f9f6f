#pragma once
// A table for a terminal.
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace dsdpv1::tb {

/// Limits the width of tables during its lifetime; the latest limit counts. Without a limit tables are not wrapped.
class TableWidth {
 public:
  static constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

  explicit TableWidth(std::size_t columns);
  ~TableWidth();
  TableWidth(const TableWidth&) = delete;
  TableWidth& operator=(const TableWidth&) = delete;

 private:
  std::size_t before_;
};

/// A line "  name  text", where it is too wide wrapped between words; `name` takes so many columns, or more.
std::string named_line(const std::string& name, const std::string& text, std::size_t columns = 13);

/// A line "  text", wrapped in the same way.
std::string line_of(const std::string& text);

/// The text at the line's begin, wrapped in the same way.
std::string wrapped_text(const std::string& text);

/// A command of a shell, after two blanks: where it is too wide it continues below, each line except the last with a
/// backslash.
std::string command_lines(const std::string& command);

/// Columns as wide as their widest cell, a rule under the head; numbers, also those with a unit of time, stand to the
/// right. Where that is too wide the widest columns are wrapped
/// between words; where that is not enough, or takes more lines, each row becomes a block of lines, a cell each.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> head) { add(std::move(head)); }
  void add(std::vector<std::string> row);
  std::string text() const;
  /// True if no cell of text() has to be wrapped.
  bool fits() const;

 private:
  using Widths = std::vector<std::size_t>;

  std::vector<bool> columns_of_numbers() const;
  Widths widths_of(std::size_t (*width)(const std::string& cell)) const;
  std::string as_columns(const Widths& widths) const;
  std::string as_blocks(std::size_t columns) const;

  std::vector<std::vector<std::string>> rows_;
};

}  // namespace dsdpv1::tb
