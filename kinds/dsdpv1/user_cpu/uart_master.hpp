#pragma once
// A user CPU's UART on the chip's RXD and TXD: each edge at its tick.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kinds/user_cpu/serial_pins.hpp"
#include "kinds/user_cpu/uart_receiver.hpp"

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

}  // namespace dsdpv1::user_cpu
