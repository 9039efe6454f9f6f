// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#include "bindings/simulator/options.hpp"

#include <cerrno>
#include <cstdlib>
#include <utility>

#include "bindings/simulator/object.hpp"

namespace dsdpv1::simulator {

std::vector<std::string> words_of(const char* text, const char* separators) {
  std::vector<std::string> words;
  const std::string all = text == nullptr ? "" : text;
  for (std::size_t begin = 0; (begin = all.find_first_not_of(separators, begin)) != std::string::npos;) {
    const std::size_t end = std::min(all.find_first_of(separators, begin), all.size());
    words.push_back(all.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

std::vector<Option> options_of(const char* text) {
  std::vector<Option> options;
  for (const std::string& word : words_of(text, " ,\t\n")) {
    const std::size_t sign = word.find('=');
    if (sign == std::string::npos || sign == 0)
      throw Error(DPSIM_ERR_ARGUMENT, "option " + word + " is none, expected NAME=VALUE");
    options.push_back({word.substr(0, sign), word.substr(sign + 1)});
  }
  return options;
}

ChipOptions chip_options(const char* text) {
  ChipOptions options;
  for (Option& each : options_of(text))
    if (each.name == "kind")
      options.kind = each.value;
    else
      options.parameters.push_back(std::move(each));
  return options;
}

int64_t number_of(const Option& option, int64_t minimum, int64_t maximum) {
  char* end = nullptr;
  errno = 0;
  const int64_t value = std::strtoll(option.value.c_str(), &end, 0);
  if (option.value.empty() || *end != 0 || errno != 0 || value < minimum || value > maximum)
    throw Error(DPSIM_ERR_ARGUMENT, "option " + option.name + " is " + option.value + ", expected " +
                                        std::to_string(minimum) + " to " + std::to_string(maximum));
  return value;
}

NativeOptions::NativeOptions(const ChipOptions& options) {
  parameters.reserve(options.parameters.size());
  for (const Option& each : options.parameters)
    parameters.push_back({each.name.c_str(), number_of(each, INT64_MIN, INT64_MAX)});
  chosen.size = sizeof chosen;
  chosen.kind = options.kind.c_str();
  chosen.parameters = parameters.data();
  chosen.parameter_count = parameters.size();
}

}  // namespace dsdpv1::simulator
