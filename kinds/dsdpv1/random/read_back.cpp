#include "kinds/dsdpv1/random/read_back.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "kinds/dsdpv1/random/chip_blocks.hpp"
#include "kinds/dsdpv1/random/host_verbs.hpp"
#include "model/dpram/crc16.hpp"
#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr Tick kCycle = profibus::kTicksPerCycle;
constexpr Tick kLeast = 150;            // table 15: Td
constexpr int kFlagsAndStatus = 0x014;  // B000 .. B013

struct Cells {
  int first, count;
};

std::uint8_t byte(int value) { return static_cast<std::uint8_t>(value); }

class ChipReader : public ReadBack {
 public:
  explicit ChipReader(const tb::Dsdpv1Settings& chip) : chip_(chip) {
    for (int pin = 0; pin < kRsuPinCount; ++pin) levels_.at(static_cast<std::size_t>(pin)) = kPinRows[pin].level;
  }

  void input(Tick at, PinNumber number, Level level) override {
    const Pin pin = static_cast<Pin>(number);
    levels_.at(number) = level;
    if (pin == Pin::kXss || pin == Pin::kRxd) last_edge_ = at;
    if (pin != Pin::kReset) return;
    written_ = 0;
    mode_ = has_serial_ports(chip_.part) ? static_cast<HostMode>(this->level(Pin::kMode)) : HostMode::kParallel;
    rate_ = this->level(Pin::kUbr);
    card_ = this->level(Pin::kAdr);
  }

  /// Every access has `commands` and `choice`; any other part writes flags or status.
  void works_on(const char* part) override {
    if (part == part_) return;
    part_ = part;
    const auto is = [part](const char* other) { return std::strcmp(part, other) == 0; };
    over_ = is("-");
    if (over_ || is(item_of(AccessPart::kCommands)) || is(item_of(AccessPart::kChoice))) return;
    written_ |= mask(AccessPart::kNone);
    for (const ChipBlock& block : kChipBlocks)
      if (is(item_of(block.part))) written_ |= mask(block.part);
  }

  Stimulus due(Tick now, const tb::PinDevice& model) override {
    if (written_ == 0 || !over_ || !at_rest()) return {};
    const std::vector<Cells> cells = cells_of(std::exchange(written_, 0), model);
    switch (mode_) {
      case HostMode::kSpi: return frames(cells, now);
      case HostMode::kUart: return telegrams(cells, now);
      default: return hold(cells);
    }
  }

 private:
  static unsigned mask(AccessPart part) { return 1U << static_cast<unsigned>(part); }
  Level level(Pin pin) const { return levels_.at(number(pin)); }
  bool all(std::initializer_list<Pin> pins, Level wanted) const {
    return std::all_of(
        pins.begin(), pins.end(), [&](Pin pin) { return level(pin) == wanted; });
  }

  bool at_rest() const {
    if (level(Pin::kReset) == 0) return false;
    if (mode_ == HostMode::kSpi) return all({Pin::kXss}, 1) && all({Pin::kSck}, 0) && is_card();
    if (mode_ == HostMode::kUart) return all({Pin::kRxd}, 1) && is_card() && rate_ >= kSlowest;
    return all({Pin::kRReq, Pin::kRSta}, 0) && all({Pin::kCsr, Pin::kRd, Pin::kWr}, 1);
  }
  bool is_card() const { return card_ == 1 || card_ == 2; }

  /// Flags and status, and each block with the cell after its data, which must be untouched.
  static std::vector<Cells> cells_of(unsigned written, const tb::PinDevice& model) {
    std::vector<Cells> cells = {{0, kFlagsAndStatus}};
    for (const ChipBlock& block : kChipBlocks) {
      if ((written & mask(block.part)) == 0) continue;
      cells.push_back({block.base, std::min(block.header + data_of(block, model) + 1, block.area)});
      cells.push_back({block.crc, 2});
    }
    return cells;
  }

  /// Accesses as short as table 15 and CLK allow, so that the chip is kept off briefly. The flags are cleared, as a
  /// driver does, so that each transfer shows its own.
  Stimulus hold(const std::vector<Cells>& cells) const {
    Stimulus actions;
    Action take;
    take.verb = verb::kTake;
    take.low = 4 * kCycle;
    actions.push_back(take);
    for (const Cells& each : cells)
      for (int i = 0; i < each.count; ++i) actions.push_back(access(verb::kRead, each.first + i, 50));
    for (const int flags : {regs::kChipCommand1, regs::kChipCommand2})
      actions.push_back(access(verb::kWrite, flags, kLeast));
    Action address;  // as the stimulus left it
    address.verb = Verb::kPin;
    address.pin = number(Pin::kA);
    address.value = level(Pin::kA);
    actions.push_back(address);
    Action give;
    give.verb = verb::kGive;
    actions.push_back(give);
    return actions;
  }
  /// `around`: setup and hold. A write is one of 0.
  static Action access(Verb verb, int address, Tick around) {
    Action action;
    action.verb = verb;
    action.address = address;
    action.setup = action.hold = around;
    action.low = 400;
    return action;
  }

  /// Both serial ports read with the same bytes (SP4, UA8).
  bus::Bytes request(const Cells& cells) const {
    bus::Bytes bytes = {byte(card_), byte(cells.first >> 8), byte(cells.first), byte(cells.count)};
    const int crc = dpram::crc16(bytes.data(), static_cast<int>(bytes.size()));
    bytes.push_back(byte(crc >> 8));
    bytes.push_back(byte(crc));
    return bytes;
  }

  /// With the clock of SP2, and SP9 after a write, if there was one.
  Stimulus frames(const std::vector<Cells>& cells, Tick now) const {
    constexpr std::size_t kReply = 4;
    constexpr Tick kHigh = 700;  // XSS
    const Tick gap = (static_cast<Tick>(chip_.spi_write_gap) + 2) * kCycle;
    Stimulus actions;
    for (const Cells& each : in_parts(cells)) {
      Action frame;
      frame.verb = verb::kSpi;
      frame.delay = actions.empty() ? std::max(kHigh, last_edge_ + gap - now) : kHigh;
      frame.bytes = request(each);
      frame.bytes.resize(frame.bytes.size() + static_cast<std::size_t>(each.count) + kReply + chip_.spi_reply_gap,
                         0xFF);
      actions.push_back(std::move(frame));
    }
    return actions;
  }

  Stimulus telegrams(const std::vector<Cells>& cells, Tick now) const {
    constexpr Tick kCharacter = 12;     // bit times
    constexpr Tick kReplyBegins = 600;  // ... at the latest, for the time that an access of the chip may take
    Stimulus actions;
    for (const Cells& each : in_parts(cells)) {
      Action telegram;
      telegram.verb = verb::kUart;
      telegram.rate = rate_;
      telegram.reply_bits = kReplyBegins;
      telegram.delay = actions.empty() ? std::max<Tick>(0, last_edge_ + kCharacter * uart_bit(rate_) - now) : 0;
      telegram.bytes = request(each);
      actions.push_back(std::move(telegram));
    }
    return actions;
  }

  /// As many cells as a telegram may read.
  static std::vector<Cells> in_parts(const std::vector<Cells>& cells) {
    constexpr int kMost = 245;
    std::vector<Cells> parts;
    for (Cells each : cells)
      for (; each.count > 0; each = {each.first + kMost, each.count - kMost})
        parts.push_back({each.first, std::min(each.count, kMost)});
    return parts;
  }

  static constexpr Level kSlowest = 6;  // UBR: reading at slower rates takes longer than a case

  const tb::Dsdpv1Settings& chip_;
  std::array<Level, kRsuPinCount> levels_{};
  HostMode mode_ = HostMode::kParallel;
  Level rate_ = 0, card_ = 0;
  Tick last_edge_ = 0;          ///< of XSS or RXD
  const char* part_ = nullptr;  ///< of the access
  bool over_ = false;           ///< no access is in progress
  unsigned written_ = 0;        ///< parts of accesses since the last reading
};

}  // namespace

std::unique_ptr<ReadBack> make_read_back(const tb::Dsdpv1Settings& chip) { return std::make_unique<ChipReader>(chip); }

}  // namespace dsdpv1::cosim
