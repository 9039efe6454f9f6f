#pragma once
// A table for a terminal.
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace tb {

/// Columns as wide as their widest cell, a rule under the head.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> head) { add(std::move(head)); }
  void add(std::vector<std::string> row);
  std::string text() const;

 private:
  std::string line(const std::vector<std::string>& row) const;
  std::string rule() const;

  std::vector<std::vector<std::string>> rows_;
  std::vector<std::size_t> widths_;
};

}  // namespace tb
