#pragma once
// The user CPU's accesses at the pins of a chip of the SPC3 family, edge by edge, on each of its parallel buses.
#include <cstddef>

#include "kinds/user_cpu/host_bus.hpp"
#include "model/dsdpv1/host_access.hpp"
#include "model/spc3/bus_lines.hpp"
#include "tb/chip/pin_device.hpp"

namespace dsdpv1::spc3_user {

using bus::Tick;
using user_cpu::Access;

/// The times are those of dsdpv1::AccessTiming, with the strobe of the bus instead of RD and WR: XRD and XWR, AS or
/// E_CLOCK. AB and R_W move with A, XCS with CSR; with the latch of the 80C32 ALE falls between A and CSR.
class BusCycle {
 public:
  /// `pins` must outlive it.
  BusCycle(tb::PinDevice& pins, spc3::Bus bus) : pins_(pins), bus_(bus) {}

  /// The bus at rest.
  void idle(Tick at);
  /// As the FSMC of an STM32F103 (RM0008 21.5.4, figures of the asynchronous wait): a read is sampled four HCLK after
  /// XREADY is active, the strobe of a write ends three after it. The CPU looks once in an HCLK (p).
  void set_wait(const user_cpu::WaitTiming& wait) { wait_ = wait; }
  void begin(Tick at, const Access& access, const dsdpv1::AccessTiming& timing);
  Tick next_edge() const { return next_; }
  /// The edge due at next_edge().
  void run_edge();
  Tick end() const { return begin_ + shift_ + access_->duration(); }
  std::uint8_t read_value() const { return value_; }
  bool last_read_was_bad() const { return bad_; }
  const Access& access() const { return asked_; }

 private:
  using Edge = dsdpv1::HostAccess::Edge;
  Tick planned() const;
  void act(Tick at);
  Tick first_look() const;
  bool must_look() const;
  void look(Tick at);
  Tick looks_without_event(Tick at) const;
  void address_moves(Tick at, bool begins);
  void select(Tick at, bool begins);
  void strobe(Tick at, bool begins);
  void sample(Tick at);
  void set(Tick at, spc3::Pin pin, spc3::Level level) { pins_.set(at, spc3::number(pin), level); }

  tb::PinDevice& pins_;
  const spc3::Bus bus_;
  user_cpu::WaitTiming wait_;
  dsdpv1::HostAccessMaker maker_;
  const dsdpv1::HostAccess* access_ = &maker_.make(false, 0, 0, {});  ///< the present or last one
  Access asked_;
  Tick begin_ = 0, shift_ = 0;
  std::size_t edge_ = access_->size();
  Tick next_ = bus::kNever;  ///< kept, because it is read far more often than changed
  Tick looks_ = 0;           ///< at XREADY
  bool waits_ = false;       ///< XREADY has not been seen active yet
  std::uint8_t value_ = 0xFF;
  bool bad_ = false;
};

}  // namespace dsdpv1::spc3_user
