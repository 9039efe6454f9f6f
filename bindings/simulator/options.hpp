// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
// "name=value name=value": the text that passes a module's parameters.
#include <cstdint>
#include <string>
#include <vector>

#include "dsdpv1/dsdpv1.h"

namespace dsdpv1::simulator {

struct Option {
  std::string name, value;
};

/// Throws Error if a word is not NAME=VALUE. Words are separated by spaces or commas.
std::vector<Option> options_of(const char* text);

/// "kind=dsdpv1_rsu NAME=VALUE ...": the kind of chip, and the rest.
struct ChipOptions {
  std::string kind = "dsdpv1";
  std::vector<Option> parameters;
};
ChipOptions chip_options(const char* text);
/// The same for the C API; valid as long as `options`.
struct NativeOptions {
  explicit NativeOptions(const ChipOptions& options);
  std::vector<dpsim_parameter> parameters = {};
  dpsim_chip_options chosen = {};
};

/// Decimal, or 0x...; throws Error if it is not a number from `minimum` to `maximum`.
int64_t number_of(const Option& option, int64_t minimum, int64_t maximum);
/// A list separated by `separator`, without empty words.
std::vector<std::string> words_of(const char* text, const char* separators);

}  // namespace dsdpv1::simulator
