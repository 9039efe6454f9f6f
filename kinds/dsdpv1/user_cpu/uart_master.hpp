#pragma once
// A user CPU's UART on the chip's RXD and TXD: each edge at its tick.
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "kinds/user_cpu/serial_pins.hpp"
#include "kinds/user_cpu/transfer.hpp"

namespace dsdpv1::user_cpu {

/// Errors to inject into a telegram; break_at truncates it.
struct UartFault : UartFaults {
  std::optional<std::size_t> flipped_bit;  ///< of the data, from 0, least significant first; the parity is adapted
  std::optional<std::size_t> cut_after;    ///< characters
  std::optional<Tick> talk_over;           ///< sends one more character, FF, so long after the last stop bit
};

/// Sends on RXD.
class UartSender : public Transfer {
 public:
  void begin(Tick at, std::vector<std::uint8_t> bytes, const UartFault& fault = {});

 private:
  /// Complete when the last stop bit has ended.
  virtual void send(Tick at, std::vector<std::uint8_t> bytes, const UartFaults& faults) = 0;
};

class PinUartSender : public UartSender {
 public:
  PinUartSender(SerialPins& pins, const UartTiming& timing) : pins_(pins), timing_(timing) {}

  Tick next() const override { return done() ? bus::kNever : begin_ + telegram_[edge_].at; }
  void run(Tick now) override;
  bool done() const override { return edge_ >= telegram_.size(); }

 private:
  void send(Tick at, std::vector<std::uint8_t> bytes, const UartFaults& faults) override;

  SerialPins& pins_;
  UartTiming timing_;
  UartTelegram telegram_;
  std::size_t edge_ = 0;  ///< the next
  Tick begin_ = 0;
  bool level_ = true;
};

/// Receives TXD at all times; a character with a wrong parity or stop bit is dropped and counted.
class UartReceiver : public Transfer {
 public:
  explicit UartReceiver(const UartTiming& timing) : timing_(timing) {}

  /// Waits for `n` characters, or until `timeout` has passed since `at` or the last of them.
  void begin(Tick at, std::size_t n, Tick timeout);
  const std::vector<std::uint8_t>& received() const { return bytes_; }
  std::uint64_t errors() const { return errors_; }

  void txd_changed(Tick at, bool level);

  Tick next() const override;
  void run(Tick now) override;
  bool done() const override { return done_; }

 private:
  struct Edge {
    Tick at;
    bool level;
  };
  struct Character {
    Tick at;  ///< mid of its stop bit
    std::uint8_t value;
  };
  void hear(Tick now);
  void take_character();
  Tick sample_tick(int bit) const;
  bool level_at(Tick at) const;
  void take(Tick now);

  UartTiming timing_;
  std::deque<Edge> edges_;            ///< since the begin of the present character
  std::deque<Character> characters_;  ///< not fetched yet
  std::uint64_t errors_ = 0;
  std::vector<std::uint8_t> bytes_;
  std::size_t n_ = 0;
  Tick timeout_ = 0, since_ = 0;
  bool done_ = true;
};

}  // namespace dsdpv1::user_cpu
