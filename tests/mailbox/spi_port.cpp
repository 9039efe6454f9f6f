#include "tests/mailbox/spi_port.hpp"

#include "tests/mailbox/reasons.hpp"

namespace dsdpv1::mailbox {
namespace {

constexpr unsigned kByteBits = 8;
constexpr unsigned kMostBits = 0xFFFF;  // an event's number has 16 bits; no frame comes near
constexpr Cycle kFrameDelay = 1;        // the second rising edge after XSS's rise: one after the first
constexpr int kHighestAddress = 125;    // 126 would be for Set_Slave_Address, which this chip lacks

/// The bits of a whole frame; 0: no command.
unsigned frame_size(std::uint8_t code) {
  switch (code) {
    case command::kWriteInputs:
    case command::kReadOutputs: return kDataFrame * kByteBits;
    case command::kStart: return kStartFrame * kByteBits;
    default: return 0;
  }
}

/// The start frame has the address and the ident number; all else is fixed. The user judges nothing: the parameters
/// must have no user bytes and the configuration must be kConfiguration.
profibus::SlaveConfig slave_config(std::uint8_t address, std::uint16_t ident) {
  profibus::SlaveConfig config;
  config.address = address;
  config.ident = ident;
  config.max_input = config.max_output = kDataBytes;
  config.max_cfg = static_cast<int>(kConfiguration.size());
  config.prm_mode = config.cfg_mode = profibus::Judging::kExact;
  config.cfg.assign(kConfiguration.data(), static_cast<int>(kConfiguration.size()));
  return config;
}

}  // namespace

void SpiPort::reset() {
  selected_ = unread_ = false;
  acts_at_ = profibus::kNever;
}

// --- the edges -------------------------------------------------------------------------------------------------------

void SpiPort::input(Tick at, PinNumber pin, Level level) {
  if (pin == kXss) chip_select(at, level != 0);
  if (pin == kSck && selected_) level != 0 ? shift_in() : shift_out();
  chip_.drive(at, kMiso, selected_ ? miso_ : kReleased);
}

void SpiPort::chip_select(Tick at, bool high) {
  if (!high) begin();
  if (high && selected_) end(at);
}

void SpiPort::begin() {
  selected_ = true;
  bits_ = 0;
  shift_.fill(0);
  to_send_ = 0;
  miso_ = 0;
}

// A select without any bit is not a frame.
void SpiPort::end(Tick at) {
  selected_ = false;
  if (bits_ == 0 || acts_at_ != profibus::kNever) return;
  frame_ = shift_;
  frame_bits_ = bits_;
  acts_at_ = profibus::first_edge_after(at) + kFrameDelay;
}

void SpiPort::shift_in() {
  const std::size_t byte = bits_ / kByteBits;
  if (byte < shift_.size()) shift_[byte] = static_cast<std::uint8_t>(shift_[byte] << 1 | chip_.level(kMosi));
  if (bits_ < kMostBits) ++bits_;
  if (bits_ == kByteBits && shift_[0] == command::kReadOutputs) load_outputs();
}

void SpiPort::shift_out() {
  miso_ = static_cast<Level>(to_send_ >> 63);
  to_send_ <<= 1;
}

// All 8 bytes at once: later data from the master is for the next frame and keeps INT low.
void SpiPort::load_outputs() {
  const profibus::IoBlock& outputs = chip_.user().outputs();
  for (std::size_t i = 0; i < kDataBytes; ++i) to_send_ = to_send_ << kByteBits | outputs.bytes[i];
  profibus::Due& due = chip_.user().mail().output.due;
  unread_ = unread_ || due.waiting();
  due.clear();
}

// --- the frame -------------------------------------------------------------------------------------------------------

void SpiPort::eval(Cycle now) {
  if (now != acts_at_) return;
  acts_at_ = profibus::kNever;
  const std::uint8_t code = frame_bits_ < kByteBits ? std::uint8_t{0} : frame_[0];
  const unsigned size = frame_bits_ < kByteBits ? kByteBits : frame_size(code);
  if (size == 0)
    chip_.say(now, Reason::kCommandUnknown.row(), code, frame_bits_);
  else if (frame_bits_ != size)
    chip_.say(now, Reason::kFrameLength.row(), frame_bits_, size, code);
  else
    execute(now);
}

void SpiPort::execute(Cycle now) {
  switch (frame_[0]) {
    case command::kWriteInputs: chip_.user().new_inputs(now, frame_.data() + 1, kDataBytes); return;
    case command::kReadOutputs: unread_ = false; return;
    default: return start(now);
  }
}

void SpiPort::start(Cycle now) {
  const std::uint8_t address = frame_[1], flags = frame_[4];
  if (address > kHighestAddress || flags != 0) {
    chip_.say(now, Reason::kStartRefused.row(), address, flags);
    return;
  }
  const auto ident = static_cast<std::uint16_t>(frame_[2] << 8 | frame_[3]);
  chip_.say(now, Reason::kStarted.row(), address, ident);
  // The slave forgets its mail; its outputs are still unread.
  unread_ = unread_ || outputs_wait();
  chip_.user().initialise(now, slave_config(address, ident));
}

}  // namespace dsdpv1::mailbox
