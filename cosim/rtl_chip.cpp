#include "cosim/rtl_chip.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::cosim {
namespace {

constexpr Tick kHalfCycle = bus::kTicksPerCycle / 2;

}  // namespace

RtlChip::RtlChip(std::unique_ptr<Rtl> rtl, const tb::ChipKind& kind, const tb::OwnSettings& chip,
                 const tb::PinDevice& fresh, TickEnds ends)
    : rtl_(std::move(rtl)),
      timing_(kind.rtl()->timing(chip)),
      ends_(timing_.clock == kNoPin ? TickEnds::kAtOnce : ends),
      delayed_(timing_.delay) {
  for (PinNumber pin = 0; pin < end_of(kind.pins()); ++pin)
    if (kind.pins()[pin].input)
      levels_.at(pin) = fresh.level(pin);
    else
      outputs_.push_back(pin);
  power_up(kind.board_pins().reset);
}

/// Before time begins: some cycles out of reset and some in it, so that every asynchronous reset has had its edge.
void RtlChip::power_up(PinNumber reset) {
  constexpr int kCyclesOut = 4, kCyclesIn = 4;
  const Level in = levels_.at(reset), out = in == 0 ? 1 : 0;
  for (int cycle = 0; cycle < kCyclesOut + kCyclesIn; ++cycle) {
    levels_.at(reset) = cycle < kCyclesOut ? out : in;
    for (const bool clk : {false, true}) rtl_->eval(clk, levels_.data());
  }
  rtl_->eval(false, levels_.data());
  last_ = levels_;
}

void RtlChip::set(Tick at, PinNumber pin, Level level) {
  advance(at);
  if (ends_ == TickEnds::kLater || pin == timing_.data) return held_.push_back({at, pin, level});
  apply(pin, level);
  if (acts_at_once(pin)) eval(at);
}

void RtlChip::advance(Tick to) {
  to = std::max(
      to, now_);  // a sample of a serial reply needs the level before this tick, but comes after other inputs at it
  if (to > now_) ends_ == TickEnds::kLater ? end_tick() : apply_held();
  const Tick last = ends_ == TickEnds::kLater ? to - 1 : to;
  while (next_edge_ <= last) {
    const Tick at = next_edge_;
    clock_edge();
    eval(at);
  }
  now_ = to;
  move_delayed(to);
}

void RtlChip::clock_edge() {
  clk_ = !clk_;
  next_edge_ += kHalfCycle;
}

/// The evaluation of tick `now_`: CLK's edge and the second clock's first one together, then the other inputs.
void RtlChip::end_tick() {
  if (held_.empty()) return;
  const bool clk = next_edge_ == now_;
  if (clk) clock_edge();
  const auto second = std::stable_partition(held_.begin(), held_.end(),
                                            [this](const Change& change) { return change.pin == timing_.clock; });
  if (second != held_.begin()) apply(timing_.clock, held_.front().level);
  if (clk || second != held_.begin()) eval(now_);
  for (const Change& change : held_) {
    apply(change.pin, change.level);
    if (acts_at_once(change.pin)) eval(now_);
  }
  held_.clear();
}

/// RtlTiming::data of a completed tick: the second clock's edge at that tick has not seen its change.
void RtlChip::apply_held() {
  for (const Change& change : held_) apply(change.pin, change.level);
  held_.clear();
}

void RtlChip::eval(Tick at) {
  rtl_->moment(at);
  move_delayed(at);
  rtl_->eval(clk_, levels_.data());
  if (levels_ == last_) return;
  for (const PinNumber pin : outputs_) {
    const Level now = levels_[pin], then = std::exchange(last_[pin], now);
    if (now == then) continue;
    if (pin != timing_.delayed || delayed_.change(at, then, now)) tell(at, pin, now);
  }
}

void RtlChip::move_delayed(Tick to) {
  for (Tick at = delayed_.next(); at <= to; at = delayed_.next()) tell(at, timing_.delayed, delayed_.take());
}

void RtlChip::tell(Tick at, PinNumber pin, Level level) {
  if ((watched_ & tb::mask_of(pin)) != 0) sink_.call(sink_.self, at, pin, level);
}

/// RtlTiming::data as set, even while it waits for the end of its tick.
Level RtlChip::level(PinNumber pin) const {
  if (pin == timing_.delayed) return delayed_.level();
  if (pin == timing_.data)
    for (auto change = held_.rbegin(); change != held_.rend(); ++change)
      if (change->pin == pin) return change->level;
  return levels_.at(pin);
}

void RtlChip::watch(const tb::PinSink& sink, tb::PinMask pins) {
  sink_ = sink;
  watched_ = sink.call == nullptr ? 0 : pins;
}

}  // namespace dsdpv1::cosim
