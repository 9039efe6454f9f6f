// The commands 01 to 31 (4.5.1), in its order.
#include <algorithm>

#include "model/xgate/firmware.hpp"

namespace dsdpv1::xgate {
namespace {

constexpr std::uint8_t kExchange = 0x20, kExchangeKnown = 0x21, kRequests = 0x30;
constexpr std::uint8_t kSerialNumber = 0x08, kName = 0x09;
constexpr unsigned kSegments = 0x33;                                 // special, bits 5..4 and 1..0
constexpr std::uint32_t kLeastRate = 1200, kMostRate = 3'000'000;    // X13
constexpr std::uint8_t kNormal = 0, kSleep = 1, kStop = 2;           // command 12
constexpr std::uint8_t kAnew = 0, kAgain = 1;                        // command 13, byte 0
constexpr unsigned kToInit = 1, kToParameters = 2, kToExchange = 3;  // byte 1
constexpr std::uint8_t kWatchdogOn = 0x80;

void put(Frame& answer, std::uint32_t number) {
  const std::uint8_t bytes[] = {static_cast<std::uint8_t>(number & 0xFF), static_cast<std::uint8_t>(number >> 8)};
  answer.data.assign(bytes, 2);
}

void put(Frame& answer, const Words& words) { answer.data.assign(words.data(), static_cast<int>(words.size())); }

}  // namespace

/// `least` to `most` bytes of data.
struct Firmware::Command {
  std::uint8_t code;
  int least, most;
  bool exchanges;  ///< needs data exchange
  Error (Firmware::*run)(Cycle now, const Frame& frame);
};

const Firmware::Command Firmware::kCommands[] = {
    {0x01, 1, 1, false, &Firmware::read_device},     {0x02, 13, 13, false, &Firmware::write_device},
    {0x03, 3, 3, false, &Firmware::set_rate},        {0x04, 0, kMostData, false, &Firmware::initialise},
    {0x12, 1, 1, false, &Firmware::set_mode},        {0x13, 2, 2, false, &Firmware::set_step},
    {0x15, 2, 2, false, &Firmware::set_leds},        {0x16, 2, 2, false, &Firmware::set_watchdog},
    {0x20, 0, kMostData, true, &Firmware::exchange}, {0x21, 0, kMostData, true, &Firmware::exchange_known},
    {0x22, 0, 0, false, &Firmware::read_prm},        {0x23, 0, 0, false, &Firmware::read_cfg},
    {0x24, 0, 0, false, &Firmware::read_lengths},    {0x30, 0, kMostData, true, &Firmware::answer_requests},
    {0x31, 0, kMostData, true, &Firmware::diagnose},
};

Error Firmware::run(Cycle now, const Frame& frame) {
  if ((frame.special & kSegments) != kOneSegment) return error::kTooFew;  // X19
  if ((frame.special & kAlarmFlag) != 0) bus_.clear_acknowledged();
  const auto* const command = std::find_if(std::begin(kCommands), std::end(kCommands),
                                           [&](const Command& each) { return each.code == frame.command; });
  if (command == std::end(kCommands)) return error::kCommand;
  if (frame.size() < command->least || frame.size() > command->most) return error::kTooFew;
  if (command->exchanges)
    if (const Error fault = bus_.exchange_fault()) return fault;
  return (this->*command->run)(now, frame);
}

// --- 01 to 03: the device --------------------------------------------------------------------------------------------

Error Firmware::read_device(Cycle /*now*/, const Frame& frame) {
  switch (frame.at(0)) {
    case 0x01: put(answer_, config_.vendor); break;
    case 0x02: put(answer_, config_.device); break;
    case 0x03: put(answer_, config_.hardware); break;
    case 0x04: put(answer_, config_.software); break;
    case kSerialNumber: put(answer_, serial_); break;
    case kName: put(answer_, name_); break;
    default: return error::kParameter;
  }
  return error::kNone;
}

Error Firmware::write_device(Cycle /*now*/, const Frame& frame) {
  if (frame.at(0) != kSerialNumber && frame.at(0) != kName) return error::kParameter;
  Words& words = frame.at(0) == kSerialNumber ? serial_ : name_;
  std::copy_n(frame.data.bytes.begin() + 1, words.size(), words.begin());
  return error::kNone;
}

Error Firmware::set_rate(Cycle /*now*/, const Frame& frame) {
  const std::uint32_t rate = frame.at(0) | std::uint32_t{frame.at(1)} << 8 | std::uint32_t{frame.at(2)} << 16;
  if (rate < kLeastRate || rate > kMostRate) return error::kRate;
  link_.set_rate(rate);
  return error::kNone;
}

// --- 04, 12, 13: states ----------------------------------------------------------------------------------------------

Error Firmware::initialise(Cycle now, const Frame& frame) {
  if (bus_.exchanging() || (state_ != ModuleState::kReady && !started())) return error::kResource;
  Initialisation read;
  if (const Error wrong = read_initialisation(frame, config_, read)) return wrong;
  given_ = true;
  state_ = ModuleState::kStarted;
  bus_.start(now, read);
  return error::kNone;
}

Error Firmware::set_mode(Cycle now, const Frame& frame) {
  const std::uint8_t mode = frame.at(0);
  if (mode > kStop) return error::kParameter;
  if (state_ == ModuleState::kStopped) return mode == kStop ? error::kNone : error::kResource;  // only /Rst starts it
  if (mode == kNormal) {
    wake(now);
    return error::kNone;
  }
  bus_.stop(now);
  state_ = mode == kSleep ? ModuleState::kAsleep : ModuleState::kStopped;
  return error::kNone;
}

void Firmware::wake(Cycle now) {
  if (state_ != ModuleState::kAsleep) return;
  state_ = given_ ? ModuleState::kStarted : ModuleState::kReady;
  if (given_) bus_.restart(now);
}

Error Firmware::set_step(Cycle now, const Frame& frame) {
  const unsigned step = frame.at(1);
  if (frame.at(0) > kAgain || step < kToInit || step > kToExchange) return error::kParameter;
  if (state_ != ModuleState::kReady && !started()) return error::kResource;
  if (frame.at(0) == kAnew) {
    bus_.stop(now);
    bus_.reset();
    given_ = false;
    state_ = ModuleState::kReady;
  } else if (!given_) {
    return error::kResource;
  } else if (const Error wrong = step_again(now, step)) {
    return wrong;
  }
  if (config_.step_answer == StepAnswer::kExample) answer_.command = kInitialise;
  return error::kNone;
}

Error Firmware::step_again(Cycle now, unsigned step) {
  switch (step) {
    case kToInit: bus_.restart(now); break;
    case kToParameters: bus_.leave_master(now); break;
    default: return bus_.exchange_fault();
  }
  return error::kNone;
}

// --- 15, 16 ----------------------------------------------------------------------------------------------------------

Error Firmware::set_leds(Cycle /*now*/, const Frame& frame) {
  leds_.set(frame.at(0), frame.at(1));
  return error::kNone;
}

Error Firmware::set_watchdog(Cycle now, const Frame& frame) {
  const bool on = (frame.at(0) & kWatchdogOn) != 0;
  if (on && frame.at(1) == 0) return error::kTime;
  dog_on_ = on;
  dog_value_ = frame.at(1);
  feed(now);
  return error::kNone;
}

// --- 20 to 31: data --------------------------------------------------------------------------------------------------

void Firmware::answer_outputs() {
  answer_.command = kExchange;
  bus_.outputs(answer_);
}

/// 20 may be answered by requests of the master, or by the flag of new user parameters (4.5.1, 9, 10 and 14).
Error Firmware::exchange(Cycle now, const Frame& frame) {
  if (const Error wrong = bus_.set_inputs(now, frame)) return wrong;
  if (bus_.requests_open()) {
    answer_.command = kRequests;
    bus_.requests(answer_);
    return error::kNone;
  }
  answer_outputs();
  if (bus_.new_prm()) answer_.command = kExchangeKnown;
  return error::kNone;
}

Error Firmware::exchange_known(Cycle now, const Frame& frame) {
  if (const Error wrong = bus_.set_inputs(now, frame)) return wrong;
  bus_.prm_is_known();
  answer_outputs();
  answer_.command = kExchangeKnown;
  return error::kNone;
}

Error Firmware::read_prm(Cycle /*now*/, const Frame& /*frame*/) {
  return bus_.prm(answer_) ? error::kNone : error::kResource;
}

Error Firmware::read_cfg(Cycle /*now*/, const Frame& /*frame*/) {
  return bus_.cfg(answer_) ? error::kNone : error::kResource;
}

Error Firmware::read_lengths(Cycle /*now*/, const Frame& /*frame*/) {
  return bus_.lengths(answer_) ? error::kNone : error::kResource;
}

Error Firmware::answer_requests(Cycle now, const Frame& frame) {
  if (const Error wrong = bus_.answer_requests(now, frame)) return wrong;
  answer_outputs();
  return error::kNone;
}

Error Firmware::diagnose(Cycle now, const Frame& frame) {
  if (const Error wrong = bus_.diagnosis(now, frame)) return wrong;
  answer_outputs();
  return error::kNone;
}

}  // namespace dsdpv1::xgate
