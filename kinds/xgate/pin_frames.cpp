#include "kinds/xgate/pin_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "kinds/xgate/pins.hpp"
#include "model/xgate/host_link.hpp"

namespace dsdpv1::xgate {
namespace {

constexpr Tick kForever = Tick{1} << 60;
constexpr int kGapBytes = 10, kSetRate = 0x03, kPrintedError = 0x83, kErrorBytes = 3;

Tick ticks(std::uint32_t cycles) { return Tick{cycles} * bus::kTicksPerCycle; }

/// As far as the bytes go.
Frame frame_of(const bus::Bytes& bytes) {
  Frame frame;
  const auto at = [&bytes](std::size_t place) { return place < bytes.size() ? bytes[place] : std::uint8_t{0}; };
  frame.command = at(1);
  frame.special = at(3);
  const std::size_t data = bytes.size() > kFrameHead ? std::min<std::size_t>(bytes.size() - kFrameHead, at(2)) : 0;
  frame.data.assign(bytes.data() + std::min<std::size_t>(kFrameHead, bytes.size()), static_cast<int>(data));
  return frame;
}

bool xor_right(const bus::Bytes& bytes) { return xor_of(bytes.data(), static_cast<int>(bytes.size())) == 0; }

}  // namespace

PinFrames::PinFrames(const Config& chip, unsigned spi_mode)
    : SpiFrameReader(spi_mode),
      config_(chip),
      timing_(uart_timing(chip.rate)),
      from_host_(timing_),
      from_module_(timing_) {
  command_.open.answer = false;
  answer_.open.answer = true;
  set_rate(chip.rate);
}

tb::PinMask PinFrames::mask() {
  tb::PinMask all = tb::mask_of(kit::kReset);
  for (const tb::PinNumber pin : {kHostRxd, kHostTxd, kNss, kSck, kMosi, kMiso}) all |= tb::mask_of(pin);
  return all;
}

void PinFrames::set_rate(std::uint32_t rate) {
  timing_ = uart_timing(rate);
  from_host_ = user_cpu::UartReceiver(timing_);
  from_module_ = user_cpu::UartReceiver(timing_);
  from_host_.begin(0, 1, kForever);
  from_module_.begin(0, 1, kForever);
  rate_at_ = bus::kNever;
  rate_changed();
}

void PinFrames::reset(Tick at, bool low) {
  serves_from_ = low ? bus::kNever : at + ticks(config_.power_up);
  if (!low) return;
  command_.open.bytes.clear();
  answer_.open.bytes.clear();
  awaits_ = false;
  set_rate(config_.rate);
  forget_frame();
  module_reset();
}

// --- bytes -----------------------------------------------------------------------------------------------------------

void PinFrames::pin(Tick at, tb::PinNumber pin, tb::Level level) {
  run(at - 1);
  if (pin == kit::kReset) return reset(at, level == 0);
  if (!by_spi()) {
    if (pin == kHostRxd) from_host_.txd_changed(at, level != 0);
    if (pin == kHostTxd) from_module_.txd_changed(at, level != 0);
    return;
  }
  switch (pin) {
    case kNss: return read(at, tb::SpiWire::kXss, level);
    case kSck: return read(at, tb::SpiWire::kSck, level);
    case kMosi: return read(at, tb::SpiWire::kMosi, level);
    case kMiso: return read(at, tb::SpiWire::kMiso, level);
    default: return;
  }
}

void PinFrames::byte(Tick at, std::uint8_t mosi, std::uint8_t miso) {
  if (awaits_)
    module_byte(byte_start(), at, miso);
  else
    host_byte(byte_start(), at, mosi);
}

Tick PinFrames::next_of(const user_cpu::UartReceiver& from) const {
  const Tick next = from.next();
  return next >= kForever ? bus::kNever : next;
}

Tick PinFrames::next() const {
  if (by_spi()) return std::min(gap_end(), frame_end());
  return std::min({gap_end(), rate_at_, next_of(from_host_), next_of(from_module_)});
}

void PinFrames::run(Tick now) {
  for (Tick at = next(); at <= now; at = next()) {
    pass(at);
    if (!by_spi()) {
      if (at >= rate_at_) set_rate(new_rate_);
      take_uart(from_module_, at, true);
      take_uart(from_host_, at, false);
    }
    if (at >= gap_end()) end_command(fmt::format("cut after {} bytes", command_.size()));
  }
}

/// A byte is known in the middle of its stop bit.
void PinFrames::take_uart(user_cpu::UartReceiver& from, Tick now, bool answer) {
  from.run(now);
  if (!from.done() || from.received().empty()) return;
  const std::uint8_t byte = from.received().front();
  from.begin(now, 1, kForever);
  const Tick start = now - half(19), end = now + half(1);
  answer ? module_byte(start, end, byte) : host_byte(start, end, byte);
}

// --- frames ----------------------------------------------------------------------------------------------------------

void PinFrames::add(Side& side, Tick start, Tick end, std::uint8_t byte) {
  if (!side.begun()) side.open.start = start;
  side.open.end = end;
  side.open.bytes.push_back(byte);
}

Tick PinFrames::longest_gap() const { return std::max(ticks(config_.frame_gap), by_spi() ? 0 : half(20 * kGapBytes)); }

/// X4, also after bytes without a frame.
Tick PinFrames::gap_end() const { return command_.begun() ? command_.open.end + longest_gap() : bus::kNever; }

void PinFrames::host_byte(Tick start, Tick end, std::uint8_t byte) {
  if (command_.begun() && command_.open.bytes[0] != kFrameStart && byte == kFrameStart) end_command("no frame");
  if (!command_.begun()) {
    command_.open.heard = !awaits_ && start >= serves_from_;
    deaf_ = awaits_ ? "not heard: the last command has no answer yet" : "not heard: the firmware has not started";
  }
  if (command_.begun() && command_.open.heard && command_.open.bytes[0] == kFrameStart)
    byte_of_frame(end, command_.open.end);
  add(command_, start, end, byte);
  const bus::Bytes& bytes = command_.open.bytes;
  if (bytes[0] != kFrameStart || bytes.size() < kFrameHead || bytes.size() < kFrameHead + bytes[2] + 1U) return;
  end_command(xor_right(bytes) ? "" : "wrong XOR");
}

void PinFrames::end_command(const std::string& wrong) {
  HostFrame& open = command_.open;
  const bool answered = open.heard && open.bytes[0] == kFrameStart && open.bytes.size() > 1;
  open.frame = frame_of(open.bytes);
  if (answered) last_ = open.frame;
  awaits_ = awaits_ || answered;
  hand_over(command_, open.heard ? wrong : deaf_);
}

bool PinFrames::is_printed_error() const {
  const bus::Bytes& bytes = answer_.open.bytes;
  return config_.errors == ErrorForm::kPrinted && bytes.size() == kFrameHead + kErrorBytes + 1 &&
         bytes[2] == kPrintedError && bytes[kFrameHead] >= 1 && bytes[kFrameHead] <= 4 && xor_right(bytes);
}

void PinFrames::module_byte(Tick start, Tick end, std::uint8_t byte) {
  if (!answer_.begun() && byte != kFrameStart) return;  // SPI: FF before the answer
  add(answer_, start, end, byte);
  const bus::Bytes& bytes = answer_.open.bytes;
  if (is_printed_error()) return end_answer("");
  if (bytes.size() < kFrameHead || bytes.size() < kFrameHead + bytes[2] + 1U) return;
  end_answer(!xor_right(bytes) ? "wrong XOR" : awaits_ ? "" : "nobody has asked");
}

void PinFrames::end_answer(const std::string& wrong) {
  HostFrame& open = answer_.open;
  const bool printed = is_printed_error();
  open.frame = frame_of(open.bytes);
  open.asked = last_.command;
  if (printed) open.frame.special |= kErrorFlag;
  awaits_ = false;
  if (wrong.empty()) follow_rate();
  hand_over(answer_, wrong);
}

/// X13.
void PinFrames::follow_rate() {
  const HostFrame& answer = answer_.open;
  if (last_.command != kSetRate || answer.frame.command != kSetRate || (answer.frame.special & kErrorFlag) != 0) return;
  new_rate_ = static_cast<std::uint32_t>(last_.at(0) | last_.at(1) << 8 | last_.at(2) << 16);
  rate_at_ = answer.end + ticks(config_.rate_hold);
}

void PinFrames::hand_over(Side& side, const std::string& wrong) {
  side.open.wrong = wrong;
  frame(side.open);
  side.open.bytes.clear();
}

}  // namespace dsdpv1::xgate
