#include "kinds/xgate/outside_host.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "kinds/board/untold.hpp"
#include "kinds/xgate/pins.hpp"

namespace dsdpv1::xgate {
namespace {

constexpr std::uint8_t kRateCommand = 0x03;
constexpr Tick kLookAgain = bus::kTicksPerSecond;

}  // namespace

OutsideHost::OutsideHost(kit::OwnPins& pins, user_cpu::OutsideLine& line, const ChipSettings& chip, Tick start)
    : pins_(pins), line_(line), rate_hold_(chip.hold_time), timing_(uart_timing(chip.rate)), now_(start), in_(timing_) {
  line_.to_chip.clear();
  line_.on_bytes = [this](Tick now) { came(now); };
  pins_.on_change = [this](Tick at, kit::PinNumber pin, kit::Level level) {
    if (pin != kHostTxd) return;
    in_.txd_changed(at, level != 0);
    if (on_plan) on_plan();
  };
  in_.begin(start, 1, kLookAgain);
}

OutsideHost::~OutsideHost() {
  line_.on_bytes = nullptr;
  pins_.on_change = nullptr;
}

user_cpu::UserCounters OutsideHost::counters() const {
  user_cpu::UserCounters counters;
  counters.program.reset();
  return counters;
}

// --- time ------------------------------------------------------------------------------------------------------------

Tick OutsideHost::next() const {
  const Tick out = sending() ? begun_ + out_[edge_].at : whole_ != 0 ? now_ : bus::kNever;
  return std::max(now_, std::min({out, in_.next(), give_up_, rate_at_}));
}

void OutsideHost::run(Tick now) {
  now_ = now;
  if (now >= rate_at_) set_rate(new_rate_);
  if (now >= give_up_) {
    command_.drop();
    whole_ = read_;
    give_up_ = bus::kNever;
  }
  receive(now);
  if (!sending() && whole_ != 0) begin(now);
  if (sending() && now >= begun_ + out_[edge_].at) send(now);
}

void OutsideHost::set_rate(std::uint32_t rate) {
  rate_at_ = bus::kNever;
  timing_ = uart_timing(rate);
  in_ = user_cpu::UartReceiver(timing_);
  in_.begin(now_, 1, kLookAgain);
}

// --- from the program ------------------------------------------------------------------------------------------------

void OutsideHost::came(Tick now) {
  now_ = std::max(now_, now);
  while (read_ < line_.to_chip.size()) read(line_.to_chip[read_]);
  give_up_ = whole_ < read_ ? now_ + kPatience : bus::kNever;
  if (on_plan) on_plan();
}

void OutsideHost::read(std::uint8_t byte) {
  const FrameParser::Got got = command_.take(byte);
  ++read_;
  if (!command_.open()) whole_ = read_;
  const Frame& frame = command_.frame();
  if (got != FrameParser::Got::kFrame || frame.command != kRateCommand || frame.size() != 3) return;
  asked_ = frame.at(0) | std::uint32_t{frame.at(1)} << 8 | std::uint32_t{frame.at(2)} << 16;
}

void OutsideHost::begin(Tick now) {
  const auto end = line_.to_chip.begin() + static_cast<std::ptrdiff_t>(whole_);
  out_ = UartTelegram({line_.to_chip.begin(), end}, timing_);
  line_.to_chip.erase(line_.to_chip.begin(), end);
  read_ -= std::exchange(whole_, 0);
  begun_ = now;
  edge_ = 0;
  answer_.drop();
}

/// Sets RXD; bits that leave it as it is have no turn.
void OutsideHost::send(Tick now) {
  const bool level = out_[edge_++].level;
  if (std::exchange(level_, level) != level) pins_.set(now, kHostRxd, level ? 1 : 0);
  while (edge_ + 1 < out_.size() && out_[edge_].level == level_) ++edge_;
}

// --- to the program --------------------------------------------------------------------------------------------------

void OutsideHost::receive(Tick now) {
  in_.run(now);
  while (in_.done()) {
    for (const std::uint8_t byte : in_.received()) answered(now, byte);
    in_.begin(now, 1, kLookAgain);
    in_.run(now);
  }
}

void OutsideHost::answered(Tick now, std::uint8_t byte) {
  line_.from_chip.push_back(byte);
  const bool complete = answer_.take(byte) == FrameParser::Got::kFrame;
  const bool right = answer_.frame().command == kRateCommand && (answer_.frame().special & kErrorFlag) == 0;
  if (!complete) return;
  const std::uint32_t asked = std::exchange(asked_, 0);
  if (!right || asked == 0) return;
  new_rate_ = asked;
  rate_at_ = now + rate_hold_;
}

tb::MakeUser outside_host(const tb::UserRequest& request) {
  request.left_out.merge(
      tb::untold(request.scenario, request.slave, {"", "is outside", tb::WithoutMailbox::kLeaveOut, "XGATE_ERR_"})
          .left_out);
  return [&pins = static_cast<kit::OwnPins&>(*request.chip.user_side()), &line = *request.outside,
          &chip = chip_settings_of(*request.slave.chip)](const user_cpu::StationConfig&, Tick start) {
    return std::make_unique<OutsideHost>(pins, line, chip, start);
  };
}

}  // namespace dsdpv1::xgate
