#pragma once
// A user CPU's receiver of a chip's UART.
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "kinds/user_cpu/transfer.hpp"
#include "model/dsdpv1/serial_host.hpp"

namespace dsdpv1::user_cpu {

/// Receives at all times; a character with a wrong parity or stop bit is dropped and counted.
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
  int stop_bit() const { return static_cast<int>(timing_.bits()) - 1; }
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
