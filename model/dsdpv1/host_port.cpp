#include "model/dsdpv1/host_port.hpp"

#include <algorithm>
#include <utility>

#include "model/dsdpv1/cells.hpp"
#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1 {
namespace {

constexpr Cycle kWriteSettles = 2;  // P8: the third rising edge after WR's, two after the first

}  // namespace

void HostPort::reset() {
  enabled_ = false;
  write_count_ = 0;
  hold_reported_ = true;
  reading_ = false;
  sample_at_ = profibus::kNever;
  drive_at_ = profibus::kNever;
  d_out_ = kLevelZ;
}

Level HostPort::level(Pin pin) const {
  switch (pin) {
    case Pin::kCsr: return csr_;
    case Pin::kRd: return rd_;
    case Pin::kWr: return wr_;
    case Pin::kA: return static_cast<Level>(a_);
    case Pin::kDIn: return d_in_;
    default: return d_out_;
  }
}

void HostPort::set(Tick at, Pin pin, Level level) {
  switch (pin) {
    case Pin::kCsr: return chip_select(at, level != 0);
    case Pin::kRd: return read_strobe(at, level != 0);
    case Pin::kWr: return write_strobe(at, level != 0);
    case Pin::kA:
      a_ = static_cast<regs::Address>(level);
      if (reading_ && sample_at_ != profibus::kNever && at > read_began_) {
        log_.at_tick(at, Reason::kReadAddressChanged, a_);
        read_spoilt_ = true;
      }
      return lines_changed(at);
    case Pin::kDIn: d_in_ = level; return lines_changed(at);
    default: return;
  }
}

// --- strobes ---------------------------------------------------------------------------------------------------------

void HostPort::chip_select(Tick at, bool level) {
  csr_ = level;
  if (!level && !rd_) begin_read(at);
  if (level && reading_) end_read(at);
  if (enabled_ && level && !wr_) log_.at_tick(at, Reason::kWriteDeselected, a_);
}

void HostPort::read_strobe(Tick at, bool level) {
  rd_ = level;
  if (!level && !csr_) begin_read(at);
  if (level && reading_) end_read(at);
}

void HostPort::write_strobe(Tick at, bool level) {
  wr_ = level;
  if (!level) wr_fell_ = at;
  if (level && !csr_) capture(at);
}

void HostPort::check_owner(Tick at) {
  if (!r_req_ || !r_sta_) log_.at_tick(at, Reason::kAccessNotOwned, a_, r_req_, r_sta_);
}

// --- reads -----------------------------------------------------------------------------------------------------------

void HostPort::begin_read(Tick at) {
  if (!enabled_) return;
  check_owner(at);
  reading_ = true;
  read_spoilt_ = false;
  tw_reported_ = false;
  read_began_ = at;
  sample_at_ = profibus::first_edge_after(at);
  d_out_ = kLevelX;  // P5: unknown until D is driven
}

void HostPort::end_read(Tick at) {
  check_tw(at);
  reading_ = false;
  sample_at_ = profibus::kNever;
  drive_at_ = profibus::kNever;
  d_out_ = kLevelZ;
}

Level HostPort::user_samples(Tick at) {
  if (!reading_ || at - read_began_ >= kTw) return d_out_;
  check_tw(at);
  return kLevelX;
}

void HostPort::check_tw(Tick at) {
  if (at - read_began_ >= kTw || std::exchange(tw_reported_, true)) return;
  log_.at_tick(at, Reason::kReadTooShort, a_, static_cast<unsigned>(at - read_began_));
}

Level HostPort::sample(Cycle now, bool unreadable) {
  if (read_spoilt_ || unreadable) return kLevelX;
  const Tick at = now * profibus::kTicksPerCycle;
  if (in_flight(a_)) {
    log_.at_tick(at, Reason::kReadInFlight, a_);
    return kLevelX;
  }
  if (ram_.unknown(a_)) {
    log_.at_tick(at, Reason::kReadUnknown, a_);
    return kLevelX;
  }
  return ram_.read(a_);
}

bool HostPort::in_flight(regs::Address address) const {
  for (unsigned i = 0; i < write_count_; ++i)
    if (write_at(i).address == address) return true;
  return false;
}

void HostPort::drive() {
  d_out_ = sampled_;
  drive_at_ = profibus::kNever;
}

// --- writes ----------------------------------------------------------------------------------------------------------

void HostPort::capture(Tick at) {
  if (!enabled_) return;
  check_owner(at);
  if (write_count_ == kWritesInFlight) {
    log_.at_tick(at, Reason::kWriteOverrun, a_);
    return;
  }
  const bool good = check_capture(at);
  const Cycle settles = profibus::first_edge_after(at) + kWriteSettles;
  write_at(write_count_++) = {settles, a_, static_cast<std::uint8_t>(d_in_ & 0xFF), good};
  captured_ = at;
  captured_address_ = a_;
  hold_reported_ = false;
}

bool HostPort::check_capture(Tick at) {
  bool good = true;
  const auto report = [&](profibus::Reason reason, Tick seen) {
    log_.at_tick(at, reason, a_, static_cast<unsigned>(std::min<Tick>(seen, 0xFFFF)));
    good = false;
  };
  if (at - wr_fell_ < kTs) report(Reason::kWriteLowTooShort, at - wr_fell_);
  if (at - lines_changed_ < kTd) report(Reason::kWriteSetup, at - lines_changed_);
  if (d_in_ < 0) report(Reason::kWriteFloating, 0);
  if (chips_own(a_)) log_.at_tick(at, Reason::kReadOnlyWritten, a_, static_cast<unsigned>(d_in_ & 0xFF));
  return good;
}

void HostPort::lines_changed(Tick at) {
  lines_changed_ = at;
  if (hold_reported_ || at - captured_ >= kTd) return;
  hold_reported_ = true;
  log_.at_tick(at, Reason::kWriteHold, captured_address_, static_cast<unsigned>(at - captured_));
  if (write_count_ > 0) write_at(write_count_ - 1).good = false;  // it settles 3 edges later, so it is still in flight
}

// P6. Before the start-up the content is not known.
void HostPort::settle(const Write& write, bool started_up) {
  const unsigned set = bits_set(write.address, ram_.read(write.address), write.value);
  if (set != 0 && started_up)
    log_.at_tick(write.settles * profibus::kTicksPerCycle, Reason::kBitSet, write.address, write.value, set);
  ram_.write(write.address, write.value);
  if (!write.good) ram_.mark_unknown(write.address);
}

/// When the first write settles that may set a bit of the chip's.
Cycle HostPort::next_judged() const {
  for (unsigned i = 0; i < write_count_; ++i)
    if (chip_sets_bits(write_at(i).address)) return write_at(i).settles;
  return profibus::kNever;
}

// --- accesses as a whole ---------------------------------------------------------------------------------------------

bool HostPort::carry_out(Tick begin, const HostAccess& access, Level& sampled) {
  if (!is_plain(begin, access)) return false;
  access.is_write() ? write_at_once(begin, access) : read_at_once(begin, access);
  a_ = static_cast<regs::Address>(HostAccess::kIdleAddress);
  sampled = sampled_;
  return true;
}

bool HostPort::is_plain_but_for_hold(Tick begin, const HostAccess& access) const {
  const bool at_rest = enabled_ && csr_ && rd_ && wr_ && d_in_ == kLevelZ;
  if (!at_rest || !access.is_right()) return false;
  const HostAccess::Times& times = access.times();
  const Tick change = begin + (access.is_write() ? std::min(times.address, times.data) : times.address);
  if (!hold_reported_ && change - captured_ < kTd) return false;
  if (access.is_write()) return write_count_ < kWritesInFlight && !chips_own(access.address()) && !may_set_bits(access);
  return !in_flight(access.address()) && !ram_.unknown(access.address());
}

bool HostPort::may_set_bits(const HostAccess& access) const {
  const regs::Address address = access.address();
  return chip_sets_bits(address) && (in_flight(address) || bits_set(address, ram_.read(address), access.value()) != 0);
}

void HostPort::write_at_once(Tick begin, const HostAccess& access) {
  const HostAccess::Times& times = access.times();
  wr_fell_ = begin + times.strobe;
  captured_ = begin + times.strobe_end;
  captured_address_ = access.address();
  write_at(write_count_++) = {profibus::first_edge_after(captured_) + kWriteSettles, captured_address_, access.value(),
                              true};
  hold_reported_ = false;
  lines_changed_ = begin + std::max(times.address_end, times.data_end);
}

void HostPort::read_at_once(Tick begin, const HostAccess& access) {
  const HostAccess::Times& times = access.times();
  read_began_ = begin + std::max(times.select, times.strobe);
  read_spoilt_ = tw_reported_ = false;
  sampled_ = ram_.read(access.address());
  lines_changed_ = begin + times.address_end;
}

void HostPort::tell_unheld(Tick fall, const HostAccess& access) {
  a_ = access.address();
  check_owner(fall);
}

Level HostPort::read_unheld(Tick begin, const HostAccess& access, bool unreadable) {
  read_at_once(begin, access);
  if (unreadable) sampled_ = kLevelX;
  a_ = static_cast<regs::Address>(HostAccess::kIdleAddress);
  return sampled_;
}

// --- the rising edge -------------------------------------------------------------------------------------------------

void HostPort::eval(Cycle now, bool owned, bool started_up) {
  if (now == sample_at_) {
    sampled_ = sample(now, owned || !started_up);
    sample_at_ = profibus::kNever;
    drive_at_ = now * profibus::kTicksPerCycle + profibus::kTicksPerCycle / 2;
  }
  settle_until(now, started_up);
}

void HostPort::settle_until(Cycle cycle, bool started_up) {
  while (write_count_ > 0 && write_at(0).settles <= cycle) {
    settle(write_at(0), started_up);
    first_write_ = (first_write_ + 1) % kWritesInFlight;
    --write_count_;
  }
}

Cycle HostPort::next() const { return std::min(sample_at_, write_count_ > 0 ? write_at(0).settles : profibus::kNever); }

}  // namespace dsdpv1
