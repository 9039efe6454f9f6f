// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#pragma once
// The head of a chip's state: frame, part, parameters.
#include "model/dsdpv1/config.hpp"
#include "model/profibus/chip_state.hpp"

namespace dsdpv1 {

/// Increment when the content or meaning of a block's stored state changes.
constexpr std::uint32_t kStateVersion = 2;

/// For profibus::save_chip.
struct StateHead {
  explicit StateHead(const Config& its_config) : config(its_config) {}

  static constexpr profibus::StateFrame kFrame = {0x5453'3156'5044'5344, kStateVersion};  // "DSDPV1ST"
  template <class Archive>
  void store_name(Archive& archive) {
    archive.within(Part::kDsdpv1, Part::kRsu, config.part);
  }
  const char* title() const { return row(config.part).title; }
  template <class Tell>
  void each_parameter(const Tell& tell) {
#define DSDPV1_PARAMETER(name, ...) tell(#name, config.name);
#define DSDPV1_RSU_LIST(name, ...) \
  for (std::uint32_t & each : config.name) tell(#name, each);
#include "model/dsdpv1/parameters.inc"
  }

  Config config;
};

}  // namespace dsdpv1
