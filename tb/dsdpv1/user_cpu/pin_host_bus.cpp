#include "tb/dsdpv1/user_cpu/pin_host_bus.hpp"

namespace user_cpu {

using dsdpv1::Level;
using dsdpv1::Pin;

void PinHostBus::set_r_req(Tick at, bool level) { chip_.set(at, Pin::kRReq, level ? 1 : 0); }

void PinHostBus::set_r_sta(Tick at, bool level) { chip_.set(at, Pin::kRSta, level ? 1 : 0); }

bool PinHostBus::l_req(Tick at) { return is_high(at, Pin::kLReq); }

bool PinHostBus::l_sta(Tick at) { return is_high(at, Pin::kLSta); }

bool PinHostBus::intr0(Tick at) { return is_high(at, Pin::kIntr0); }

unsigned PinHostBus::lamps(Tick at) {
  const auto bit = [&](Pin pin) { return static_cast<unsigned>(is_high(at, pin)); };
  return bit(Pin::kPbf) | bit(Pin::kBr) << 1U | bit(Pin::kReady) << 2U;
}

bool PinHostBus::is_high(Tick at, Pin pin) {
  chip_.advance(at);
  return chip_.level(pin) == 1;
}

// Keeps the plan in order of time; edges at the same tick happen in the order in which they were added.
void PinHostBus::insert(const Edge& edge) {
  std::size_t place = edges_.size++;
  for (; place > 0 && edges_.at[place - 1].tick > edge.tick; --place) edges_.at[place] = edges_.at[place - 1];
  edges_.at[place] = edge;
}

void PinHostBus::add(Tick offset, Pin pin, Level level) { insert({offset, false, pin, level}); }

void PinHostBus::add_sample(Tick offset) { insert({offset, true, Pin::kDOut, 0}); }

// Offsets are counted from the strobe's fall. What prepares the strobe is added before it, what ends with it after it.
void PinHostBus::plan_read(const AccessTiming& timing) {
  add(-timing.cs_lead, Pin::kCsr, 0);
  add(0, Pin::kRd, 0);
  add_sample(sample_in_read(timing));
  add(timing.rd_low, Pin::kRd, 1);
  add(timing.rd_low + timing.cs_trail, Pin::kCsr, 1);
  add(timing.rd_low + timing.address_hold, Pin::kA, kIdleAddress);
}

void PinHostBus::plan_write(const Access& access, const AccessTiming& timing) {
  add(-timing.cs_lead, Pin::kCsr, 0);
  add(0, Pin::kWr, 0);
  add(timing.wr_low - timing.data_setup, Pin::kDIn, access.value);
  add(timing.wr_low, Pin::kWr, 1);
  add(timing.wr_low + timing.data_hold, Pin::kDIn, dsdpv1::kLevelZ);
  add(timing.wr_low + timing.cs_trail, Pin::kCsr, 1);
  add(timing.wr_low + timing.address_hold, Pin::kA, kIdleAddress);
}

void PinHostBus::begin(Tick at, const Access& access, const AccessTiming& timing) {
  edges_.size = 0;
  add(-timing.address_setup, Pin::kA, static_cast<Level>(access.address));
  if (access.write)
    plan_write(access, timing);
  else
    plan_read(timing);
  sample_tick_ = place(at, timing.recovery) + sample_in_read(timing);
}

/// The tick of the strobe's fall.
Tick PinHostBus::place(Tick start, Tick recovery) {
  const Tick shift = start - edges_.at[0].tick;
  for (std::size_t i = 0; i < edges_.size; ++i) edges_.at[i].tick += shift;
  edge_ = 0;
  end_ = edges_.at[edges_.size - 1].tick + recovery;
  return shift;
}

void PinHostBus::run_edges(Tick now) {
  for (; next_edge() <= now; ++edge_) {
    const Edge& edge = edges_.at[edge_];
    if (edge.sample)
      sample(edge.tick);
    else
      chip_.set(edge.tick, edge.pin, edge.level);
  }
}

void PinHostBus::sample(Tick at) {
  const Level level = chip_.sample(at);
  bad_ = level < 0;
  value_ = bad_ ? std::uint8_t{0xFF} : static_cast<std::uint8_t>(level);
}

}  // namespace user_cpu
