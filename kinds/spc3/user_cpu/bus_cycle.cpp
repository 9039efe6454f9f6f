#include "kinds/spc3/user_cpu/bus_cycle.hpp"

#include <algorithm>

namespace dsdpv1::spc3_user {
namespace {

using spc3::Bus;
using spc3::Level;
using Role = dsdpv1::Pin;  ///< of a pin in HostAccess

constexpr Level kIdleAddress = dsdpv1::HostAccess::kIdleAddress;
constexpr Level kIdleHigh = 0xFF;                        ///< A15 to A8 of an 80C32: not this chip (A45)
constexpr int kBeforeSample = 4, kBeforeEndOfWrite = 3;  ///< HCLK

Tick clocks(const user_cpu::WaitTiming& wait, Tick count) { return count * bus::kTicksPerSecond / wait.hclk_hz; }

}  // namespace

void BusCycle::idle(Tick at) {
  set(at, spc3::Pin::kXCs, 1);
  set(at, spc3::Pin::kXWr, bus_ == Bus::kMotorolaSync ? 0 : 1);
  set(at, spc3::Pin::kAle, bus_ == Bus::kMotorolaAsync ? 1 : 0);
  set(at, spc3::Pin::kXRd, 1);
  set(at, spc3::Pin::kAb, bus_ == Bus::kIntelSync ? kIdleHigh : kIdleAddress);
  set(at, spc3::Pin::kDbIn, spc3::kLevelZ);
  edge_ = access_->size();
  next_ = bus::kNever;
}

void BusCycle::begin(Tick at, const Access& access, const dsdpv1::AccessTiming& timing) {
  dsdpv1::AccessTiming own = timing;
  if (bus_ == Bus::kIntelSync) own.cs_lead = std::min(own.cs_lead, own.address_setup / 2);
  access_ = &maker_.make(access.write, access.address, access.value, own);
  asked_ = access;
  begin_ = at;
  shift_ = 0;
  edge_ = 0;
  looks_ = 0;
  waits_ = wait_.on && !spc3::is_synchronous(bus_);
  next_ = planned();
}

// --- edges -----------------------------------------------------------------------------------------------------------

Tick BusCycle::planned() const {
  if (edge_ == access_->size()) return bus::kNever;
  return must_look() ? begin_ + first_look() + clocks(wait_, looks_) : begin_ + shift_ + (*access_)[edge_].at;
}

/// The first look at XREADY, before the sample of a read or the end of the strobe of a write; from the first edge on.
Tick BusCycle::first_look() const {
  const dsdpv1::HostAccess::Times& times = access_->times();
  const Tick first =
      asked_.write ? times.strobe_end - clocks(wait_, kBeforeEndOfWrite) : times.data - clocks(wait_, kBeforeSample);
  return std::max(first, times.strobe + 1);
}

bool BusCycle::must_look() const { return waits_ && (*access_)[edge_].at >= first_look(); }

void BusCycle::run_edge() {
  act(next_);
  next_ = planned();
}

void BusCycle::act(Tick at) {
  if (must_look()) return look(at);
  const Edge& edge = (*access_)[edge_++];
  switch (edge.pin) {
    case Role::kA: return address_moves(at, edge.at != access_->times().address_end);
    case Role::kCsr: return select(at, edge.level == 0);
    case Role::kDIn: return set(at, spc3::Pin::kDbIn, edge.level);
    case Role::kDOut: return sample(at);
    default: return strobe(at, edge.level == 0);
  }
}

void BusCycle::look(Tick at) {
  pins_.advance(at);
  const bool active = pins_.level(spc3::number(spc3::Pin::kXReady)) == (wait_.while_high ? 0 : 1);
  waits_ = !active;
  if (!active) looks_ += looks_without_event(at);
  shift_ = clocks(wait_, looks_);
}

/// From the look at `at` to the first that may find XREADY moved; in reset the chip has no event of its own.
Tick BusCycle::looks_without_event(Tick at) const {
  const Tick event = pins_.level(spc3::number(spc3::Pin::kReset)) != 0 ? at : pins_.next_event();
  if (event <= at || event == bus::kNever) return 1;
  Tick looks = std::max<Tick>(1, (event - at) * wait_.hclk_hz / bus::kTicksPerSecond);
  while (begin_ + first_look() + clocks(wait_, looks_ + looks) < event) ++looks;
  return looks;
}

// --- pins ------------------------------------------------------------------------------------------------------------

void BusCycle::address_moves(Tick at, bool begins) {
  if (!begins) {
    if (spc3::is_motorola(bus_)) set(at, spc3::Pin::kXRd, 1);
    return set(at, spc3::Pin::kAb, bus_ == Bus::kIntelSync ? kIdleHigh : kIdleAddress);
  }
  const auto high = static_cast<Level>(asked_.address >> 11 & 1);
  if (pins_.level(spc3::number(spc3::Pin::kAb11)) != high) set(at, spc3::Pin::kAb11, high);
  if (bus_ == Bus::kIntelSync) {
    set(at, spc3::Pin::kAle, 1);
    set(at, spc3::Pin::kAb, static_cast<Level>(asked_.address >> 8 & 7));
    return set(at, spc3::Pin::kDbIn, static_cast<Level>(asked_.address & 0xFF));
  }
  if (spc3::is_motorola(bus_)) set(at, spc3::Pin::kXRd, asked_.write ? 0 : 1);
  const auto address = static_cast<spc3::Address>(asked_.address);
  set(at, spc3::Pin::kAb, static_cast<Level>((spc3::is_motorola(bus_) ? spc3::swapped(address) : address) & 0x7FF));
}

void BusCycle::select(Tick at, bool begins) {
  if (bus_ != Bus::kIntelSync) return set(at, spc3::Pin::kXCs, begins ? 0 : 1);
  if (!begins) return;
  set(at, spc3::Pin::kAle, 0);
  set(at, spc3::Pin::kDbIn, spc3::kLevelZ);
}

void BusCycle::strobe(Tick at, bool begins) {
  switch (bus_) {
    case Bus::kMotorolaSync: return set(at, spc3::Pin::kXWr, begins ? 1 : 0);
    case Bus::kMotorolaAsync: return set(at, spc3::Pin::kAle, begins ? 0 : 1);
    default: return set(at, asked_.write ? spc3::Pin::kXWr : spc3::Pin::kXRd, begins ? 0 : 1);
  }
}

void BusCycle::sample(Tick at) {
  pins_.advance(at);
  const Level level = pins_.sample(at);
  bad_ = level < 0;
  value_ = bad_ ? std::uint8_t{0xFF} : static_cast<std::uint8_t>(level);
}

}  // namespace dsdpv1::spc3_user
