#include "kinds/dsdpv1/checks/port_timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dsdpv1::checks {
namespace {

constexpr Tick kCycle = 250;           // P1
constexpr Tick kSettles = 2 * kCycle;  // P8: the third CLK edge after WR rose, two after the first

/// The first rising CLK edge strictly after a tick (P9).
constexpr Tick edge_after(Tick at) { return (at / kCycle + 1) * kCycle; }

}  // namespace

void PortTiming::reset(bool low) {
  in_reset_ = low;
  csr_early_.reset();
  csr_due_.reset();
  a_hold_.reset();
  d_hold_.reset();
  sample_.reset();
  writes_ = {};
  reading_ = accessing_ = false;
}

void PortTiming::pin(Tick at, Pin pin, Level level) {
  switch (pin) {
    case Pin::kCsr: return chip_select(at, level != 0);
    case Pin::kRd: return read_strobe(at, level != 0);
    case Pin::kWr: return write_strobe(at, level != 0);
    case Pin::kA: return address_changed(at, level);
    case Pin::kDIn: return data_changed(at, level);
    default: return chip_data_changed(at, level);
  }
}

// --- strobes ---------------------------------------------------------------------------------------------------------

void PortTiming::chip_select(Tick at, bool level) {
  csr_ = level;
  if (level) {
    if (!wr_) csr_early_ = at;
    if (csr_due_)
      recorder_.value(Check::kCsr, *csr_due_, at - *csr_due_, [this] { return fmt::format("B{:03X}", written_); });
    csr_due_.reset();
  }
  strobes_changed(at);
}

void PortTiming::read_strobe(Tick at, bool level) {
  rd_ = level;
  strobes_changed(at);
}

void PortTiming::write_strobe(Tick at, bool level) {
  wr_ = level;
  if (!level) {
    wr_fell_ = at;
    csr_early_.reset();
  } else if (in_reset_) {
    csr_early_.reset();
  } else if (!csr_ || csr_early_ == at) {
    capture(at);
  } else if (csr_early_) {
    recorder_.value(
        Check::kCsr, *csr_early_, *csr_early_ - at, [this] { return fmt::format("B{:03X}", a_); });
  }
  strobes_changed(at);
}

void PortTiming::strobes_changed(Tick at) {
  const bool running = !csr_ && (!rd_ || !wr_);
  if (running && !accessing_) {
    began_ = at;
    accessing_ = true;
    sink_.access_began(at);
  }
  const bool read = !csr_ && !rd_;
  if (read && !reading_) begin_read(at);
  if (!running && accessing_) {
    accessing_ = false;
    sink_.access_ended(at);
  }
  if (!read && reading_) end_read(at);
}

// --- writes ----------------------------------------------------------------------------------------------------------

void PortTiming::capture(Tick at) {
  const auto address = static_cast<std::uint16_t>(a_);
  const auto writing = [address] { return fmt::format("writing B{:03X}", address); };
  recorder_.value(Check::kTs, wr_fell_, at - wr_fell_, writing);
  const bool floating = d_in_ < 0;
  recorder_.value(Check::kTd, at, floating ? 0 : at - std::max(a_changed_, d_changed_),
                  [&] { return writing() + (floating ? ", nobody drives D" : ""); });
  end_holds(at);
  a_hold_ = d_hold_ = at;
  written_ = address;
  if (csr_)
    recorder_.value(Check::kCsr, at, 0, writing);
  else
    csr_due_ = at;
  writes_.at(write_count_++ % writes_.size()) = {address, edge_after(at) + kSettles};
  const std::optional<std::uint8_t> value = floating ? std::nullopt : std::optional(static_cast<std::uint8_t>(d_in_));
  sink_.accessed({true, address, value, std::min(began_, at), at});
}

/// A write follows without a change of A or D in between: they have been stable until now.
void PortTiming::end_holds(Tick at) {
  const auto writing = [this] { return fmt::format("writing B{:03X}", written_); };
  if (a_hold_) recorder_.value(Check::kAddressHold, *a_hold_, at - *a_hold_, writing);
  if (d_hold_) recorder_.value(Check::kDataHold, *d_hold_, at - *d_hold_, writing);
  a_hold_.reset();
  d_hold_.reset();
}

void PortTiming::data_changed(Tick at, Level level) {
  d_in_ = level;
  d_changed_ = at;
  if (!d_hold_) return;
  recorder_.value(Check::kDataHold, *d_hold_, at - *d_hold_,
                  [this] { return fmt::format("writing B{:03X}", written_); });
  d_hold_.reset();
}

// --- reads -----------------------------------------------------------------------------------------------------------

void PortTiming::begin_read(Tick at) {
  reading_ = true;
  read_spoilt_ = false;
  began_ = at;
  sample_edge_ = edge_after(at);
  a_valid_since_ = a_changed_;
  a_read_ = a_;
}

void PortTiming::address_changed(Tick at, Level level) {
  if (a_hold_) {
    recorder_.value(Check::kAddressHold, *a_hold_, at - *a_hold_,
                    [this] { return fmt::format("writing B{:03X}", written_); });
    a_hold_.reset();
  }
  a_ = level;
  a_changed_ = at;
  if (!reading_ || at >= sample_edge_) return;
  a_read_ = level;
  if (at == began_)
    a_valid_since_ = at;
  else if (!std::exchange(read_spoilt_, true))
    recorder_.value(Check::kTc, at, began_ - at, [level] { return fmt::format("reading B{:03X}", level); });
}

void PortTiming::chip_data_changed(Tick at, Level level) {
  if (at != d_out_changed_) d_out_before_ = d_out_;
  d_out_changed_ = at;
  d_out_ = level;
}

/// D as driven by the chip just before `at`; it may have been released at that very tick.
std::optional<std::uint8_t> PortTiming::chip_data(Tick at) const {
  const Level level = d_out_changed_ == at ? d_out_before_ : d_out_;
  return level < 0 ? std::nullopt : std::optional(static_cast<std::uint8_t>(level));
}

void PortTiming::end_read(Tick at) {
  reading_ = false;
  const auto address = static_cast<std::uint16_t>(a_read_);
  const auto reading = [address] { return fmt::format("reading B{:03X}", address); };
  const Tick sampled = std::min(std::exchange(sample_, std::nullopt).value_or(at), at);
  recorder_.value(Check::kTw, began_, sampled - began_, reading);
  if (!read_spoilt_) {
    recorder_.value(Check::kTc, began_, began_ - a_valid_since_, reading);
    check_read_back();
  }
  sink_.accessed({false, address, read_spoilt_ ? std::nullopt : chip_data(at), began_, at});
}

void PortTiming::check_read_back() {
  for (const Write& write : writes_) {
    if (write.address != a_read_ || write.settles < 0) continue;
    recorder_.value(Check::kReadBack, began_, sample_edge_ - write.settles,
                    [this] { return fmt::format("reading B{:03X}", a_read_); });
  }
}

}  // namespace dsdpv1::checks
