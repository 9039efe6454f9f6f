#pragma once
// The head of a chip's state: frame, name, parameters.
#include "model/profibus/chip_state.hpp"
#include "model/spc3/config.hpp"

namespace dsdpv1::spc3 {

/// Increment when the content or meaning of a block's stored state changes.
constexpr std::uint32_t kStateVersion = 4;

/// For profibus::save_chip.
struct StateHead {
  explicit StateHead(const Config& its_config) : config(its_config) {}

  static constexpr profibus::StateFrame kFrame = {0x5453'2020'3343'5053, kStateVersion};  // "SPC3  ST"
  template <class Archive>
  void store_name(Archive& archive) {
    archive.within(Variant::kApc3, Variant::kVpc3, config.variant);
  }
  const char* title() const { return row(config.variant).title; }
  template <class Tell>
  void each_parameter(const Tell& tell) {
#define SPC3_PARAMETER(name, ...) tell(#name, config.name);
#include "model/spc3/parameters.inc"
  }

  Config config;
};

}  // namespace dsdpv1::spc3
