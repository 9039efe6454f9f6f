#include "model/spc3/bus_port.hpp"

#include <utility>

#include "model/spc3/reasons.hpp"

namespace dsdpv1::spc3 {
namespace {

using profibus::first_edge_after;
using profibus::kNever;

constexpr std::uint8_t kFloating = 0xFF;  // DB without a driver

}  // namespace

void BusPort::reset() {
  enabled_ = false;
  access_ = Access::kNone;
  xready_ = true;
  db_out_ = kLevelZ;
  ready_at_ = fall_at_ = release_at_ = kNever;
  spi_.reset();
}

void BusPort::release(Cycle now) {
  enabled_ = true;
  spi_.release();
  if (access_ != Access::kNone) begin(now * profibus::kTicksPerCycle, access_);
}

bool BusPort::set(Tick at, Pin pin, Level level) {
  const bool was_high = lines_.is_high(pin);
  if (!lines_.set(pin, level) || pin == Pin::kDbIn) return false;
  if (pin == Pin::kXTest0 || pin == Pin::kXTest1) {
    if (level == 0) log_.at_tick(at, Reason::kTestPin, pin == Pin::kXTest1 ? 1 : 0);
    return false;
  }
  if (pin >= Pin::kSerial) return lines_.is_high(pin) != was_high && set_spi(at, pin, level);
  return follow_strobes(at);
}

bool BusPort::set_spi(Tick at, Pin pin, Level level) {
  const Level miso = spi_.miso();
  if (pin == Pin::kSerial) {
    spi_.reset();
    if (enabled_) spi_.release();
    follow_strobes(at);
    return true;
  }
  if (lines_.bus() != Bus::kSpi) return false;
  if (pin == Pin::kXss) spi_.xss(at, level != 0, lines_.is_high(Pin::kSck));
  if (pin == Pin::kSck) spi_.sck(at, level != 0, lines_.is_high(Pin::kMosi));
  return pin == Pin::kSck || spi_.miso() != miso;
}

// --- strobes ---------------------------------------------------------------------------------------------------------

// With both strobes low the first continues, and the other begins when the first has ended.
bool BusPort::follow_strobes(Tick at) {
  const bool reads = lines_.reads(), writes = lines_.writes();
  const bool ends = access_ != Access::kNone && !(access_ == Access::kRead ? reads : writes);
  if (ends) end(at);
  const bool begins = access_ == Access::kNone && (reads || writes);
  if (begins) begin(at, reads ? Access::kRead : Access::kWrite);
  if (reads && writes && !std::exchange(told_both_, true))
    log_.at_tick(at, Reason::kBothStrobes, shown_address(), access_ == Access::kRead ? 0 : 1);
  return begins || ends;
}

void BusPort::begin(Tick at, Access access) {
  access_ = access;
  acted_ = told_early_ = told_both_ = false;
  if (!enabled_) return;
  await_answer(at);
  if (access == Access::kRead) db_out_ = kLevelX;
}

// A16, A42.
void BusPort::await_answer(Tick at) {
  const Cycle seen = first_edge_after(at);
  if (is_synchronous(lines_.bus())) {
    ready_at_ = access_ == Access::kRead ? seen + delay_of(config_, config_.strobe) : kNever;
    return;
  }
  ready_at_ = seen + delay_of(config_, config_.ready);
  fall_at_ = seen + delay_of(config_, config_.ready - (map_.early_ready() ? 1 : 0));
}

// A16: a write acts now, and so does a read without its answer.
void BusPort::end(Tick at) {
  const Access ended = std::exchange(access_, Access::kNone);
  if (!enabled_) return log_.at_tick(at, Reason::kInReset, shown_address());
  const bool lost = ready_at_ != kNever && is_early(at, ended);
  if (ended == Access::kRead) {
    if (!acted_ && !lost) read(at);
    db_out_ = kLevelZ;
  } else if (!lost) {
    write(at);
  }
  ready_at_ = fall_at_ = kNever;
  if (!xready_) release_at_ = first_edge_after(at) + delay_of(config_, config_.ready_release);
}

// A42: reports an access that is used before it is ready. Returns true if it is not served.
bool BusPort::is_early(Tick at, Access access) {
  if (is_synchronous(lines_.bus())) return false;
  if (!std::exchange(told_early_, true))
    log_.at_tick(at, Reason::kBeforeReady, shown_address(),
                 static_cast<unsigned>(ready_at_ - at / profibus::kTicksPerCycle), access == Access::kRead ? 0 : 1);
  return config_.ready_rule != 0;
}

// --- what an access does ---------------------------------------------------------------------------------------------

bool BusPort::knows_address(Tick at) {
  if (lines_.address() >= 0) return true;
  log_.at_tick(at, Reason::kUnknownAddress);
  return false;
}

void BusPort::read(Tick at) {
  acted_ = true;
  if (!knows_address(at)) return;
  db_out_ = map_.read(first_edge_after(at), static_cast<Address>(lines_.address()));
}

void BusPort::write(Tick at) {
  if (!knows_address(at)) return;
  const auto address = static_cast<Address>(lines_.address());
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
  if (now == fall_at_) {
    fall_at_ = release_at_ = kNever;
    xready_ = false;
  }
  if (now != ready_at_) return;
  ready_at_ = kNever;
  if (access_ == Access::kRead && !acted_) read(now * profibus::kTicksPerCycle);
}

}  // namespace dsdpv1::spc3
