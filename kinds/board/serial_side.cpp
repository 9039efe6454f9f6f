#include "kinds/board/serial_side.hpp"

#include <algorithm>
#include <utility>

#include "kinds/board/memory_bus.hpp"

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kSpi1Remap = 1U << 0U, kUsart2Remap = 1U << 3U;

// By block: the status register, and its flag of an empty buffer.
constexpr std::array<std::uint32_t, 3> kStatus = {Spi::kSr, Spi::kSr, Usart::kSr},
                                       kTxe = {1U << 1U, 1U << 1U, 1U << 7U};

constexpr unsigned kRtsPin = 1, kTxPin = 2, kRxPin = 3;
enum : unsigned { kNss, kSck, kMiso, kMosi };           // pins of an SPI, counted from its first one
constexpr std::array<unsigned, 2> kFirstPin = {4, 12};  // PA4, PB12

void append(std::uint8_t& byte, bool bit) {
  byte = static_cast<std::uint8_t>(static_cast<unsigned>(byte) << 1U | static_cast<unsigned>(bit));
}

bool is_on(std::uint32_t word, unsigned bit) { return (word >> bit & 1U) != 0; }

}  // namespace

// ---------------------------------------------------------------------------------------------------------- registers

std::uint32_t SerialSide::peek(Block block, std::uint32_t offset) const {
  return block == kUsart2 ? usart_.peek(offset) : spi_.at(block).peek(offset);
}

std::uint32_t SerialSide::read(Block block, std::uint32_t offset) {
  const std::uint32_t value = block == kUsart2 ? usart_.read(offset) : spi_.at(block).read(offset);
  plan();
  return value;
}

void SerialSide::write(Block block, std::uint32_t offset, std::uint32_t value, std::uint64_t now, std::uint32_t pc) {
  if (offset == (block == kUsart2 ? Usart::kDr : Spi::kDr)) waiting_.at(block) = pc;
  if (block == kUsart2)
    usart_.write(offset, value, now);
  else
    spi_.at(block).write(offset, value, now);
  plan();
}

void SerialSide::follow(const Rcc& rcc) {
  spi_[0].set_divider(rcc.apb2_divider());
  spi_[1].set_divider(rcc.apb1_divider());
  usart_.set_divider(rcc.apb1_divider());
  if (is_on(rcc.apb2_resets(), 12)) spi_[0].reset();
  if (is_on(rcc.apb1_resets(), 14)) spi_[1].reset();
  if (is_on(rcc.apb1_resets(), 17)) usart_.reset();
  plan();
}

void SerialSide::reset() {
  for (Spi& each : spi_) each.reset();
  usart_.reset();
  mapr_ = 0;
  plan();
}

// --------------------------------------------------------------------------------------------------------------- time

void SerialSide::plan() { next_ = std::min({spi_[0].next(), spi_[1].next(), usart_.next()}); }

void SerialSide::run(Tick at, user_cpu::SerialPins& chip) {
  const std::uint64_t now = next();
  for (unsigned i = 0; i < spi_.size(); ++i)
    if (spi_.at(i).next() == now) spi_.at(i).run(!has_miso(i) || chip.miso(at));
  if (usart_.next() == now) usart_.run();
  note_bytes(at);
  if (moved()) move(at, chip);
  plan();
}

/// A byte leaves its buffer (TXE): from now on the pins are those of its store.
void SerialSide::note_bytes(Tick at) {
  for (unsigned block = 0; block < waiting_.size(); ++block) {
    std::optional<std::uint32_t>& store = waiting_.at(block);
    if (!store || (peek(static_cast<Block>(block), kStatus.at(block)) & kTxe.at(block)) == 0) continue;
    acts_.pins(at, *store, false);
    store.reset();
  }
}

void SerialSide::txd_changed(std::uint64_t cycle, bool level) {
  usart_.rx_changed(cycle, level);
  plan();
}

unsigned SerialSide::requests() const {
  const auto bit = [](bool asks, unsigned number) { return static_cast<unsigned>(asks) << number; };
  return bit(spi_[0].asks(), kSpi1) | bit(spi_[1].asks(), kSpi2) | bit(usart_.asks(), kUsart2);
}

// --------------------------------------------------------------------------------------------------------------- pins

std::array<SerialSide::Alternate, 8> SerialSide::alternates() const {
  std::array<Alternate, 8> all{};
  auto* to = all.begin();
  for (unsigned i = 0; i < spi_.size(); ++i) {
    const Spi& spi = spi_.at(i);
    const bool here = i != 0 || (mapr_ & kSpi1Remap) == 0;
    const unsigned first = kFirstPin.at(i);
    *to++ = {i, first + kNss, here && spi.selects(), false};
    *to++ = {i, first + kSck, here && spi.drives(), spi.sck()};
    *to++ = {i, first + kMosi, here && spi.drives(), spi.mosi()};
  }
  const bool here = (mapr_ & kUsart2Remap) == 0;
  *to++ = {kA, kTxPin, here && usart_.drives(), usart_.tx()};
  *to++ = {kA, kRtsPin, here && usart_.drives_rts(), usart_.rts()};
  return all;
}

bool SerialSide::level(const Alternate& alternate, bool floating) const {
  const Gpio& port = ports_.at(alternate.port);
  if (port.drives(alternate.pin)) return port.level(alternate.pin, floating);
  return alternate.drives && port.is_alternate(alternate.pin) ? alternate.level : floating;
}

SerialSide::Levels SerialSide::wanted() const {
  const auto all = alternates();
  const std::size_t first = card_ == 2 ? 3 : 0;
  const Levels idle;
  return {level(all.at(first), idle.xss), level(all.at(first + 1), idle.sck), level(all.at(first + 2), idle.mosi),
          level(all.at(6), idle.rxd)};
}

bool SerialSide::moved() {
  for (unsigned i = 0; i < spi_.size(); ++i) spi_.at(i).set_nss(ports_.at(i).level(kFirstPin.at(i), true));
  plan();
  return card_ != 0 && levels_ != wanted();
}

void SerialSide::move(Tick at, user_cpu::SerialPins& chip) {
  using dsdpv1::Pin;
  const Levels before = std::exchange(levels_, wanted());
  follow_frame(at, before, chip);
  const auto set = [&](Pin pin, bool was, bool is) {
    if (was != is) chip.set_serial(at, pin, is);
  };
  set(Pin::kXss, before.xss, levels_.xss);
  set(Pin::kSck, before.sck, levels_.sck);
  set(Pin::kMosi, before.mosi, levels_.mosi);
  set(Pin::kRxd, before.rxd, levels_.rxd);
}

/// Collects the bits that the chip's shift register takes at SCK's rises.
void SerialSide::follow_frame(Tick at, const Levels& before, user_cpu::SerialPins& chip) {
  if (before.xss && !levels_.xss) {
    out_.clear();
    in_.clear();
    frame_bits_ = 0;
    frame_begin_ = at;
  } else if (!before.xss && levels_.xss) {
    claims_.frame(out_, in_, frame_begin_, at);
  } else if (!before.sck && levels_.sck && !levels_.xss) {
    if (frame_bits_++ % 8 == 0) {
      out_.push_back(0);
      in_.push_back(0);
    }
    append(out_.back(), before.mosi);
    append(in_.back(), chip.miso(at));
  }
}

/// TX idles high, as its pull-up does, so that it may be open drain.
std::string SerialSide::wrong_pin(Block block) const {
  if (block == kUsart2) {
    const bool passes = (mapr_ & kUsart2Remap) == 0 && ports_.at(kA).is_alternate(kTxPin);
    if (usart_.drives() && ports_.at(kA).is_analog(kRxPin)) return pin_name({kA, kRxPin}) + " (RX)";
    return usart_.drives() && !passes ? pin_name({kA, kTxPin}) + " (TX)" : "";
  }
  const bool here = block != kSpi1 || (mapr_ & kSpi1Remap) == 0;
  for (const auto& [pin, name] : {std::pair(kSck, " (SCK)"), std::pair(kMosi, " (MOSI)")}) {
    const unsigned at = kFirstPin.at(block) + pin;
    if (spi_.at(block).drives() && !(here && ports_.at(block).is_pushed_alternate(at)))
      return pin_name({block, at}) + name;
  }
  const unsigned miso = kFirstPin.at(block) + kMiso;
  return spi_.at(block).drives() && ports_.at(block).is_analog(miso) ? pin_name({block, miso}) + " (MISO)" : "";
}

SerialSide::Seen SerialSide::seen(unsigned port, bool miso) const {
  Seen seen;
  if (port >= spi_.size()) return seen;  // USART2 is also on port A
  const auto add = [&](unsigned pin, bool level) {
    seen.driven |= static_cast<std::uint16_t>(1U << pin);
    if (level) seen.levels |= static_cast<std::uint16_t>(1U << pin);
  };
  for (const Alternate& each : alternates())
    if (each.port == port && each.drives && ports_.at(port).is_alternate(each.pin)) add(each.pin, each.level);
  if (has_miso(port)) add(kFirstPin.at(port) + kMiso, miso);
  if (card_ != 0 && port == kA) add(kRxPin, usart_.rx());
  return seen;
}

}  // namespace dsdpv1::arm
