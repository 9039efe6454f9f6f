#pragma once
// The board's serial peripherals and their wiring to the chip:
//
//   card 1   SPI1: PA4 XSS, PA5 SCK, PA6 MISO, PA7 MOSI
//   card 2   SPI2: PB12 XSS, PB13 SCK, PB14 MISO, PB15 MOSI
//   both     USART2: PA2 the chip's RXD, PA3 its TXD; PA1 RTS, not connected to the chip
//
// XSS and RXD are pulled high, SCK and MOSI low (p). A pin is moved by its port's output or, if it is the alternate
// function, by the peripheral; remapped ones (AFIO_MAPR) are no longer on these pins.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "board/stm32/gpio.hpp"
#include "board/stm32/rcc.hpp"
#include "board/stm32/spi.hpp"
#include "board/stm32/usart.hpp"
#include "kinds/user_cpu/act_log.hpp"
#include "kinds/user_cpu/claim_counters.hpp"
#include "kinds/user_cpu/serial_pins.hpp"

namespace dsdpv1::arm {

using bus::Tick;

/// Interrupts of the NVIC that SerialSide::requests has a bit for: SPI1, SPI2, USART2.
constexpr std::array<unsigned, 3> kSerialIrq = {35, 36, 38};

class SerialSide {
 public:
  using Ports = std::array<Gpio, 7>;
  static constexpr std::uint64_t kNever = Spi::kNever;
  enum Block : unsigned { kSpi1, kSpi2, kUsart2 };

  /// `card`: 1 or 2; 0: a chip without serial pins. `ports` and `acts`, which learns of each byte sent, outlive it.
  SerialSide(const Ports& ports, unsigned card, user_cpu::ActLog& acts) : ports_(ports), card_(card), acts_(acts) {}

  /// A register at `offset` of a block.
  std::uint32_t peek(Block block, std::uint32_t offset) const;
  std::uint32_t read(Block block, std::uint32_t offset);
  /// `pc`: of the store.
  void write(Block block, std::uint32_t offset, std::uint32_t value, std::uint64_t now, std::uint32_t pc);
  /// Applies RCC: clocks, and peripherals in reset.
  void follow(const Rcc& rcc);
  /// AFIO_MAPR.
  void remap(std::uint32_t mapr) { mapr_ = mapr; }
  void reset();

  /// The HCLK cycle of the next action.
  std::uint64_t next() const { return next_; }
  /// Acts at cycle next(), which begins at tick `at`; updates the chip's pins.
  void run(Tick at, user_cpu::SerialPins& chip);
  /// The chip's TXD changed; `cycle` is the first that sees it.
  void txd_changed(std::uint64_t cycle, bool level);

  /// Ports or registers were written. Returns true if the chip's pins must be updated. NSS reads its pin here.
  bool moved();
  void move(Tick at, user_cpu::SerialPins& chip);
  /// Bits for kSerialIrq.
  unsigned requests() const;

  /// Levels driven from here onto pins that ports A and B do not drive. `miso` from the chip.
  struct Seen {
    std::uint16_t driven = 0, levels = 0;
  };
  Seen seen(unsigned port, bool miso) const;
  /// A pin between a block that sends and the chip that is not set up for it: "PA5 (SCK)"; empty: none.
  std::string wrong_pin(Block block) const;
  /// The port has a pin of the chip.
  bool concerns(unsigned port) const { return card_ != 0 && port < 2; }
  /// MISO is on that port, so its level must be known.
  bool has_miso(unsigned port) const { return card_ != 0 && port == card_ - 1; }

  /// Holds of the DPRAM, according to the frames on the pins.
  const user_cpu::HoldCounters& holds() const { return claims_.counters(); }
  /// Bytes that came before those before them had been fetched.
  std::uint64_t lost(Block block) const { return block == kUsart2 ? usart_.lost() : spi_.at(block).lost(); }

 private:
  /// Levels of the chip's pins XSS, SCK, MOSI, RXD.
  struct Levels {
    bool xss = true, sck = false, mosi = false, rxd = true;
    bool operator!=(const Levels& other) const {
      return xss != other.xss || sck != other.sck || mosi != other.mosi || rxd != other.rxd;
    }
  };
  /// Output of a peripheral, as passed on by the port.
  struct Alternate {
    unsigned port, pin;
    bool drives, level;
  };
  void plan();
  void note_bytes(Tick at);
  std::array<Alternate, 8> alternates() const;
  bool level(const Alternate& alternate, bool floating) const;
  Levels wanted() const;
  void follow_frame(Tick at, const Levels& before, user_cpu::SerialPins& chip);

  const Ports& ports_;
  unsigned card_;
  user_cpu::ActLog& acts_;
  std::uint32_t mapr_ = 0;
  std::array<Spi, 2> spi_;
  Usart usart_;
  std::array<std::optional<std::uint32_t>, 3> waiting_;  ///< by block: the store of the byte in its buffer
  std::uint64_t next_ = kNever;                          ///< of all three
  Levels levels_;
  std::vector<std::uint8_t> out_, in_;  ///< of the frame, both ways; the last one holds the bits of an unfinished byte
  unsigned frame_bits_ = 0;
  Tick frame_begin_ = 0;
  user_cpu::ClaimCounters claims_;
};

}  // namespace dsdpv1::arm
