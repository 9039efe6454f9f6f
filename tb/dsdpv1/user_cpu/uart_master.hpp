#pragma once
// A user CPU's UART on the chip's RXD and TXD: start, 8 bits LSB first, even parity, stop (UA1), each edge at its tick.
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "tb/dsdpv1/user_cpu/serial_pins.hpp"
#include "tb/dsdpv1/user_cpu/transfer.hpp"

namespace dsdpv1::user_cpu {

struct UartTiming {
  std::int64_t baud = 1'843'200;  ///< bit/s; the k-th bit of a character ends k/baud after its begin, rounded to a tick
  Tick gap = 0;                   ///< idle between two characters of a telegram
};

/// What goes wrong in a telegram.
struct UartFault {
  std::optional<std::size_t> wrong_parity;  ///< number of the character
  std::optional<std::size_t> flipped_bit;   ///< of the data, from 0, least significant first; the parity fits it
  std::optional<std::size_t> cut_after;     ///< characters
  std::optional<std::size_t> break_at;      ///< this character is low for its whole time and the last
  std::optional<std::size_t> pause_before;  ///< number of the character before which it is idle so much longer:
  Tick pause = 0;
  std::optional<Tick> talk_over;  ///< one more character, FF, so long after the last stop bit
};

/// Sends on RXD.
class UartSender : public Transfer {
 public:
  UartSender(SerialPins& pins, const UartTiming& timing) : pins_(pins), timing_(timing) {}

  void begin(Tick at, std::vector<std::uint8_t> bytes, const UartFault& fault = {});

  Tick next() const override { return done() ? bus::kNever : tick_of(cell_); }
  void run(Tick now) override;
  /// The last stop bit is over.
  bool done() const override { return cell_ > 11 * bytes_.size(); }

 private:
  Tick tick_of(std::size_t cell) const;
  bool level_of(std::size_t cell) const;

  SerialPins& pins_;
  UartTiming timing_;
  std::vector<std::uint8_t> bytes_;
  std::optional<std::size_t> wrong_parity_, break_at_;
  std::size_t pause_before_ = 0;  ///< number of the character
  Tick pause_ = 0;
  std::size_t cell_ = 1;  ///< the next bit to be put out: 11 a character; one past the last: the end
  Tick begin_ = 0;
  bool level_ = true;
};

/// Hears TXD at all times; a character whose parity or stop bit is wrong is left out and counted.
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
  std::deque<Edge> edges_;            ///< since the begin of the character that comes
  std::deque<Character> characters_;  ///< that nobody has asked for
  std::uint64_t errors_ = 0;
  std::vector<std::uint8_t> bytes_;
  std::size_t n_ = 0;
  Tick timeout_ = 0, since_ = 0;
  bool done_ = true;
};

}  // namespace dsdpv1::user_cpu
