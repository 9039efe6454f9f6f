// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#pragma once
// The state of a whole chip: frame, its name within the family, parameters, blocks.
//
// `Head`: made from the chip's `config`; its kFrame, store_name(archive), title(), and each_parameter(tell), which
// calls `tell(name, value)` for each parameter, with its name in scenarios. `Impl`: `config`, store(archive) of its
// blocks, and take_over(observed), which keeps the observers of the chip that it replaces.
#include <memory>
#include <utility>
#include <vector>

#include "model/profibus/state_frame.hpp"

namespace dsdpv1::profibus {

template <class Head, class Impl>
std::vector<std::uint8_t> save_chip(Impl& chip) {
  StateWriter writer;
  begin_frame(writer, Head::kFrame);
  Head head(chip.config);
  head.store_name(writer);
  head.each_parameter([&](const char* /*name*/, std::uint32_t& value) { writer(value); });
  chip.store(writer);
  return end_frame(writer.take());
}

/// Throws StateError, leaving the chip as it is, if the bytes are not a whole state of this name and these parameters.
template <class Head, class Impl>
void restore_chip(std::unique_ptr<Impl>& chip, const std::uint8_t* bytes, std::size_t size) {
  StateReader reader = open_frame(bytes, size, Head::kFrame);
  Head own(chip->config), saved = own;
  saved.store_name(reader);
  check_title(saved.title(), own.title());
  own.each_parameter([&](const char* name, std::uint32_t value) { check_parameter(reader, name, value); });
  auto restored = std::make_unique<Impl>(chip->config);
  restored->store(reader);
  check_frame(reader);
  restored->take_over(*chip);
  chip = std::move(restored);
}

}  // namespace dsdpv1::profibus
