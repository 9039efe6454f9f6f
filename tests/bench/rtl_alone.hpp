#pragma once
// The Verilated reference RTL with as little round it as it can do with: for measurements of what RTL simulation costs
// by itself. It is compiled together with what Verilator makes of rtl_ref/, into a library of its own that shows
// nothing else: the library for lockstep has classes of the same names.
#include <cstdint>
#include <memory>

#include "model/dsdpv1/pins.hpp"
#include "model/profibus/character_run.hpp"

namespace dsdpv1::speed {

using profibus::Tick;

/// Pins as dsdpv1::Chip has them. Changes of L_REQ and PBTXD are counted, and reported to nobody.
class [[gnu::visibility("default")]] RtlAlone {
 public:
  RtlAlone();
  ~RtlAlone();
  RtlAlone(const RtlAlone&) = delete;
  RtlAlone& operator=(const RtlAlone&) = delete;

  void set(Tick at, Pin pin, Level level);
  /// RTL hears changes.
  bool hear(Tick /*at*/, const profibus::CharacterRun& /*run*/) { return false; }
  void advance(Tick to);
  /// Of L_REQ, L_STA and PBTXD; others are not asked for.
  Level level(Pin pin) const;
  std::uint64_t line_changes() const;
  std::uint64_t request_changes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dsdpv1::speed
