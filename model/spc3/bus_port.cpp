#include "model/spc3/bus_port.hpp"

#include <utility>

#include "model/spc3/reasons.hpp"

namespace dsdpv1::spc3 {
namespace {

using profibus::first_edge_after;
using profibus::kNever;

constexpr std::uint8_t kFloating = 0xFF;  // DB that nobody drives

}  // namespace

BusPort::BusPort(profibus::EventLog& log, const Config& config, AddressMap& map)
    : log_(log), config_(config), map_(map), inputs_() {
  for (int pin = 0; pin < kPinCount; ++pin) inputs_[static_cast<std::size_t>(pin)] = kPinRows[pin].level;
}

void BusPort::reset() {
  enabled_ = false;
  access_ = Access::kNone;
  xready_ = true;
  db_out_ = kLevelZ;
  ready_at_ = release_at_ = kNever;
}

void BusPort::set(Tick at, Pin pin, Level level) {
  if (std::exchange(inputs_[number(pin)], level) == level) return;
  switch (pin) {
    case Pin::kXTest0:
    case Pin::kXTest1:
      if (level == 0) log_.at_tick(at, Reason::kTestPin, pin == Pin::kXTest1 ? 1 : 0);
      return;
    case Pin::kXCs:
    case Pin::kXRd:
    case Pin::kXWr: return follow_strobes(at);
    default: return;
  }
}

// --- strobes ---------------------------------------------------------------------------------------------------------

bool BusPort::strobes(Access access) const {
  return !is_high(Pin::kXCs) && !is_high(access == Access::kRead ? Pin::kXRd : Pin::kXWr);
}

// With both strobes low the first goes on, and the other begins when the first has ended.
void BusPort::follow_strobes(Tick at) {
  if (access_ != Access::kNone && !strobes(access_)) end(at);
  const bool reads = strobes(Access::kRead), writes = strobes(Access::kWrite);
  if (access_ == Access::kNone && (reads || writes)) begin(at, reads ? Access::kRead : Access::kWrite);
  if (!reads || !writes || std::exchange(told_both_, true)) return;
  log_.at_tick(at, Reason::kBothStrobes, static_cast<unsigned>(level(Pin::kAb)), access_ == Access::kRead ? 0 : 1);
}

void BusPort::begin(Tick at, Access access) {
  access_ = access;
  acted_ = told_early_ = told_both_ = false;
  if (!enabled_) return log_.at_tick(at, Reason::kInReset, static_cast<unsigned>(level(Pin::kAb)));
  const std::uint32_t early = map_.early_ready() ? 1 : 0;
  ready_at_ = first_edge_after(at) + delay_of(config_, config_.ready - early);
  if (access == Access::kRead) db_out_ = kLevelX;
}

// A16: a write acts now, and so does a read without its answer.
void BusPort::end(Tick at) {
  const Access ended = std::exchange(access_, Access::kNone);
  if (!enabled_) return;
  const bool lost = ready_at_ != kNever && is_early(at, ended);
  if (ended == Access::kRead) {
    if (!acted_ && !lost) read(at);
    db_out_ = kLevelZ;
  } else if (!lost) {
    write(at);
  }
  ready_at_ = kNever;
  if (!xready_) release_at_ = first_edge_after(at) + delay_of(config_, config_.ready_release);
}

// A42: reports an access that is used before it is ready. Returns true if it is not served.
bool BusPort::is_early(Tick at, Access access) {
  if (!std::exchange(told_early_, true))
    log_.at_tick(at, Reason::kBeforeReady, static_cast<unsigned>(level(Pin::kAb)),
                 static_cast<unsigned>(ready_at_ - at / profibus::kTicksPerCycle), access == Access::kRead ? 0 : 1);
  return config_.ready_rule != 0;
}

// --- what an access does ---------------------------------------------------------------------------------------------

bool BusPort::knows_address(Tick at) {
  if (level(Pin::kAb) >= 0) return true;
  log_.at_tick(at, Reason::kUnknownAddress);
  return false;
}

void BusPort::read(Tick at) {
  acted_ = true;
  if (!knows_address(at)) return;
  db_out_ = map_.read(first_edge_after(at), static_cast<Address>(level(Pin::kAb)));
}

void BusPort::write(Tick at) {
  if (!knows_address(at)) return;
  const auto address = static_cast<Address>(level(Pin::kAb));
  Level value = level(Pin::kDbIn);
  if (value < 0) {
    log_.at_tick(at, Reason::kUnknownData, address);
    value = kFloating;
  }
  map_.write(first_edge_after(at), address, static_cast<std::uint8_t>(value));
}

Level BusPort::user_samples(Tick at) {
  if (access_ == Access::kRead && enabled_ && !acted_ && !is_early(at, access_)) read(at);
  return db_out_;
}

// --- the rising edge -------------------------------------------------------------------------------------------------

void BusPort::eval(Cycle now) {
  if (now == release_at_) {
    release_at_ = kNever;
    xready_ = true;
  }
  if (now != ready_at_) return;
  ready_at_ = release_at_ = kNever;
  xready_ = false;
  if (access_ == Access::kRead && !acted_) read(now * profibus::kTicksPerCycle);
}

}  // namespace dsdpv1::spc3
