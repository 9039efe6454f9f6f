#include "tb/dsdpv1/cosim/rtl_chip.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr Tick kHalfCycle = profibus::kTicksPerCycle / 2;

/// What the chip captures from a bus that nobody drives: as the model, which reads no bits from Z.
constexpr std::uint8_t kReleasedReadsAs = 0xFF;

Level wire(const RtlOutputs& out, Wire place) {
  return (out.unknown >> place & 1U) != 0 ? dsdpv1::kLevelX : static_cast<Level>(out.word >> place & 1U);
}

Level data(const RtlOutputs& out) {
  if ((out.unknown >> kWireDriven & 1U) != 0) return dsdpv1::kLevelX;
  if ((out.word >> kWireDriven & 1U) == 0) return dsdpv1::kLevelZ;
  return (out.unknown & 0xFFU) != 0 ? dsdpv1::kLevelX : static_cast<Level>(out.word & 0xFFU);
}

Level level_of(const RtlOutputs& out, Pin pin) {
  switch (pin) {
    case Pin::kLReq: return wire(out, kWireLReq);
    case Pin::kLSta: return wire(out, kWireLSta);
    case Pin::kDOut: return data(out);
    case Pin::kIntr0: return wire(out, kWireIntr0);
    case Pin::kPbtxd: return wire(out, kWirePbtxd);
    case Pin::kPbrts: return wire(out, kWirePbrts);
    case Pin::kPbf: return wire(out, kWirePbf);
    case Pin::kBr: return wire(out, kWireBr);
    default: return wire(out, kWireReady);
  }
}

/// Strobes act at their own tick; all others are looked at by an edge of CLK or by a strobe.
bool acts_at_once(Pin pin) { return pin == Pin::kReset || pin == Pin::kCsr || pin == Pin::kRd || pin == Pin::kWr; }

}  // namespace

RtlChip::RtlChip(std::unique_ptr<RtlTop> top) : top_(std::move(top)), timed_(dynamic_cast<TimedTop*>(top_.get())) {
  power_up();
}

/// Before time begins: some cycles out of reset and some in it, so that every asynchronous reset has had its edge.
void RtlChip::power_up() {
  constexpr int kCyclesOut = 4, kCyclesIn = 4;
  for (int cycle = 0; cycle < kCyclesOut + kCyclesIn; ++cycle) {
    top_->in.reset = cycle < kCyclesOut;
    for (const bool clk : {false, true}) {
      top_->in.clk = clk;
      top_->eval();
    }
  }
  top_->in.clk = false;
  top_->eval();
  last_ = top_->out;
}

void RtlChip::set(Tick at, Pin pin, Level level) {
  advance(at);
  apply(pin, level);
  if (acts_at_once(pin)) eval(at);
}

void RtlChip::apply(Pin pin, Level level) {
  RtlInputs& in = top_->in;
  switch (pin) {
    case Pin::kReset: in.reset = level != 0; break;
    case Pin::kRReq: in.r_req = level != 0; break;
    case Pin::kRSta: in.r_sta = level != 0; break;
    case Pin::kCsr: in.csr = level != 0; break;
    case Pin::kRd: in.rd = level != 0; break;
    case Pin::kWr: in.wr = level != 0; break;
    case Pin::kA: in.a = static_cast<std::uint16_t>(level); break;
    case Pin::kDIn:
      d_in_ = level;
      in.d = level < 0 ? kReleasedReadsAs : static_cast<std::uint8_t>(level);
      break;
    default: in.pbrxd = level != 0; break;
  }
}

void RtlChip::advance(Tick to) {
  for (; next_edge_ <= to; next_edge_ += kHalfCycle) {
    top_->in.clk = !top_->in.clk;
    eval(next_edge_);
  }
  now_ = to;
}

void RtlChip::eval(Tick at) {
  if (timed_ != nullptr) timed_->moment(at);
  top_->eval();
  if (top_->out == last_) return;
  const RtlOutputs before = last_;
  last_ = top_->out;
  report(at, before);
}

void RtlChip::report(Tick at, const RtlOutputs& before) {
  if (sink_.call == nullptr) return;
  for (int i = static_cast<int>(Pin::kLReq); i < dsdpv1::kPinCount; ++i) {
    const Pin pin = static_cast<Pin>(i);
    if ((watched_ & dsdpv1::mask(pin)) == 0) continue;
    const Level level = level_of(last_, pin);
    if (level != level_of(before, pin)) sink_.call(sink_.self, at, pin, level);
  }
}

Level RtlChip::level(Pin pin) const {
  const RtlInputs& in = top_->in;
  switch (pin) {
    case Pin::kReset: return in.reset;
    case Pin::kRReq: return in.r_req;
    case Pin::kRSta: return in.r_sta;
    case Pin::kCsr: return in.csr;
    case Pin::kRd: return in.rd;
    case Pin::kWr: return in.wr;
    case Pin::kA: return static_cast<Level>(in.a);
    case Pin::kDIn: return d_in_;
    case Pin::kPbrxd: return in.pbrxd;
    default: return level_of(last_, pin);
  }
}

void RtlChip::watch(const dsdpv1::PinSink& sink, std::uint32_t pins) {
  sink_ = sink;
  watched_ = pins & dsdpv1::kOutputPins;
}

}  // namespace dsdpv1::cosim
