#pragma once
// The Verilated reference RTL with as little around it as possible: measures the cost of RTL simulation alone. It is
// compiled together with Verilator's output for rtl_ref/ into a separate library that exports nothing else, because the
// library for lockstep has classes of the same names.
#include <cstdint>
#include <memory>

#include "model/dsdpv1/pins.hpp"
#include "model/profibus/character_run.hpp"

namespace dsdpv1::speed {

using profibus::Tick;

/// Pins as in dsdpv1::Chip. Changes of L_REQ and PBTXD are counted but not reported.
class [[gnu::visibility("default")]] RtlAlone {
 public:
  RtlAlone();
  ~RtlAlone();
  RtlAlone(const RtlAlone&) = delete;
  RtlAlone& operator=(const RtlAlone&) = delete;

  void set(Tick at, Pin pin, Level level);
  /// RTL needs each change.
  bool hear(Tick /*at*/, const profibus::CharacterRun& /*run*/) { return false; }
  void advance(Tick to);
  /// For L_REQ, L_STA and PBTXD only.
  Level level(Pin pin) const;
  std::uint64_t line_changes() const;
  std::uint64_t request_changes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dsdpv1::speed
