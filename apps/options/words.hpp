#pragma once
// Words and times of the command line as values. `option`: the command and its option, "dsdpv1-sim run: --engine". All
// throw tb::InputError, which says what is allowed.
#include <string>
#include <utility>
#include <vector>

#include "bus/time.hpp"

namespace dsdpv1::app {

/// Unless `word` is one of `allowed`.
void check_word(const std::string& option, const std::string& word, const std::vector<std::string>& allowed);

/// The value that `word` stands for.
template <typename Value>
Value value_of(const std::string& option, const std::string& word,
               const std::vector<std::pair<std::string, Value>>& values) {
  std::vector<std::string> allowed;
  for (const auto& [name, value] : values) {
    if (name == word) return value;
    allowed.push_back(name);
  }
  check_word(option, word, allowed);
  return values.front().second;
}

/// The index of a baud rate of bus/baud.hpp.
int baud_index(const std::string& option, const std::string& word);

/// Ticks, `least` or later.
bus::Tick time_of(const std::string& option, const std::string& text, bus::Tick least = 0);

}  // namespace dsdpv1::app
