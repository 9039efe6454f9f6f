#include "cosim/rtl_chip.hpp"

#include <algorithm>
#include <utility>

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

Level miso(const RtlOutputs& out) {
  return (out.word >> kWireMisoDriven & 1U) != 0 ? wire(out, kWireMiso) : dsdpv1::kLevelZ;
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
    case Pin::kTxd: return wire(out, kWireTxd);
    default: return wire(out, kWireReady);
  }
}

/// Strobes act at their own tick; all others are looked at by an edge of CLK or by a strobe.
bool acts_at_once(Pin pin) {
  return pin == Pin::kReset || pin == Pin::kCsr || pin == Pin::kRd || pin == Pin::kWr || pin == Pin::kXss ||
         pin == Pin::kSck;
}

}  // namespace

RtlChip::RtlChip(std::unique_ptr<RtlTop> top, const dsdpv1::Config& config, TickEnds ends)
    : top_(std::move(top)),
      timed_(dynamic_cast<TimedTop*>(top_.get())),
      rsu_(dsdpv1::has_serial_ports(config.part)),
      ends_(ends),
      miso_delay_(config.spi_miso_delay) {
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
  if (ends_ == TickEnds::kLater || pin == Pin::kMosi) return held_.push_back({at, pin, level});
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
    case Pin::kPbrxd: in.pbrxd = level != 0; break;
    default: apply_serial(pin, level); break;
  }
}

void RtlChip::apply_serial(Pin pin, Level level) {
  RtlInputs& in = top_->in;
  const auto strap = static_cast<std::uint8_t>(level);
  switch (pin) {
    case Pin::kXss: in.xss = level != 0; break;
    case Pin::kSck: in.sck = level != 0; break;
    case Pin::kMosi: in.mosi = level != 0; break;
    case Pin::kRxd: in.rxd = level != 0; break;
    case Pin::kMode: in.mode = strap; break;
    case Pin::kAdr: in.adr = strap; break;
    case Pin::kUbr: in.ubr = strap; break;
    default: in.uiv = strap; break;
  }
}

void RtlChip::advance(Tick to) {
  to = std::max(to, now_);  // who samples MISO asks for what was before this tick, after other inputs of it perhaps
  if (to > now_) ends_ == TickEnds::kLater ? end_tick() : take_mosi();
  const Tick last = ends_ == TickEnds::kLater ? to - 1 : to;
  while (next_edge_ <= last) {
    const Tick at = next_edge_;
    clock_edge();
    eval(at);
  }
  now_ = to;
  if (!coming_.empty()) move_miso(to);
}

void RtlChip::clock_edge() {
  top_->in.clk = !top_->in.clk;
  next_edge_ += kHalfCycle;
}

/// What happens at tick `now_`: CLK's edge and SCK's first one in one evaluation, then the other inputs.
void RtlChip::end_tick() {
  if (held_.empty()) return;
  const bool clk = next_edge_ == now_;
  if (clk) clock_edge();
  const auto sck =
      std::stable_partition(held_.begin(), held_.end(), [](const Change& change) { return change.pin == Pin::kSck; });
  if (sck != held_.begin()) apply(Pin::kSck, held_.front().level);
  if (clk || sck != held_.begin()) eval(now_);
  for (const Change& change : held_) {
    apply(change.pin, change.level);
    if (acts_at_once(change.pin)) eval(now_);
  }
  held_.clear();
}

/// As the host has set it, also while it waits for the end of its tick.
Level RtlChip::mosi() const {
  for (auto change = held_.rbegin(); change != held_.rend(); ++change)
    if (change->pin == Pin::kMosi) return change->level;
  return top_->in.mosi;
}

/// MOSI of a tick that is over: SCK's rise at that tick has not seen its change.
void RtlChip::take_mosi() {
  for (const Change& change : held_) apply(change.pin, change.level);
  held_.clear();
}

void RtlChip::eval(Tick at) {
  if (timed_ != nullptr) timed_->moment(at);
  if (!coming_.empty()) move_miso(at);
  top_->eval();
  if (top_->out == last_) return;
  const RtlOutputs before = last_;
  last_ = top_->out;
  report(at, before);
}

void RtlChip::report(Tick at, const RtlOutputs& before) {
  for (int i = static_cast<int>(Pin::kLReq); i < dsdpv1::kPinCount; ++i) {
    const Pin pin = static_cast<Pin>(i);
    const Level level = level_of(last_, pin);
    if (level != level_of(before, pin)) tell(at, pin, level);
  }
  if (!rsu_) return;
  miso_register(at, before);
  const Level txd = level_of(last_, Pin::kTxd);
  if (txd != level_of(before, Pin::kTxd)) tell(at, Pin::kTxd, txd);
}

/// SCK's fall reaches the pin later; XSS, RESET and the begin of listening at once, and what is on its way is dropped.
void RtlChip::miso_register(Tick at, const RtlOutputs& before) {
  const Level now = miso(last_), then = miso(before);
  if (now == then) return;
  if (now != dsdpv1::kLevelZ && then != dsdpv1::kLevelZ) return coming_.push_back({at + miso_delay_, Pin::kMiso, now});
  coming_.clear();
  tell(at, Pin::kMiso, miso_ = now);
}

void RtlChip::move_miso(Tick to) {
  for (; !coming_.empty() && coming_.front().at <= to; coming_.pop_front()) {
    miso_ = coming_.front().level;
    tell(coming_.front().at, Pin::kMiso, miso_);
  }
}

void RtlChip::tell(Tick at, Pin pin, Level level) {
  if ((watched_ & dsdpv1::mask(pin)) != 0) sink_.call(sink_.self, at, pin, level);
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
    case Pin::kXss: return in.xss;
    case Pin::kSck: return in.sck;
    case Pin::kMosi: return mosi();
    case Pin::kRxd: return in.rxd;
    case Pin::kMode: return in.mode;
    case Pin::kAdr: return in.adr;
    case Pin::kUbr: return in.ubr;
    case Pin::kUiv: return in.uiv;
    case Pin::kMiso: return miso_;
    default: return level_of(last_, pin);
  }
}

void RtlChip::watch(const dsdpv1::PinSink& sink, std::uint32_t pins) {
  sink_ = sink;
  watched_ = sink.call == nullptr ? 0 : pins & (rsu_ ? dsdpv1::kRsuOutputPins : dsdpv1::kOutputPins);
}

}  // namespace dsdpv1::cosim
