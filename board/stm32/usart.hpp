#pragma once
// USART2 of the STM32F103 (RM0008, chapter USART), asynchronous: TDR and RDR before its shift registers; the next
// character is lost when one is fetched too late. Times are cycles of HCLK. Assumed, as the manual is silent (p): a
// character in TDR begins with the next cycle of PCLK, the receiver sees a fall of RX with the next cycle of PCLK.
#include <cstdint>
#include <deque>
#include <limits>

#include "board/stm32/registers.hpp"

namespace dsdpv1::arm {

/// Of USART1 as well.
constexpr RegisterList kUsartRegisters = {{0x00, "SR", 0xC0},       {0x04, "DR"},
                                          {0x08, "BRR", 0, 0xFFFF}, {0x0C, "CR1", 0, 0x3FFF},
                                          {0x10, "CR2", 0, 0x7F6F}, {0x14, "CR3", 0, 0x07FF},
                                          {0x18, "GTPR", 0, 0xFFFF}};

class Usart {
 public:
  static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();
  static constexpr std::uint32_t kSr = 0x00, kDr = 0x04, kBrr = 0x08, kCr1 = 0x0C, kCr2 = 0x10, kCr3 = 0x14;
  static const RegisterTable kRegisters;

  /// Cycles of HCLK in a cycle of PCLK: 1, 2, 4, 8 or 16.
  void set_divider(unsigned hclk_cycles) { divider_ = hclk_cycles; }

  /// read() of DR after read() of SR clears errors and IDLE; peek() clears nothing.
  std::uint32_t peek(std::uint32_t offset) const { return words_.read(offset); }
  std::uint32_t read(std::uint32_t offset);
  void write(std::uint32_t offset, std::uint32_t value, std::uint64_t now);
  /// As after a reset, except the clock, the line and lost().
  void reset();

  /// The cycle of its next action, kNever when there is none.
  std::uint64_t next() const;
  /// Acts at cycle next().
  void run();
  /// RX changed; cycle `at` is the first that sees it. In order of time, and before run() of a later cycle.
  void rx_changed(std::uint64_t at, bool level);

  /// It drives TX: the transmitter is on, or still sends.
  bool drives() const { return (words_[kCr1] & kUe) != 0 && ((words_[kCr1] & kTe) != 0 || sends()); }
  bool tx() const { return tx_; }
  /// RTS (RTSE), low while a character can be taken; `drives_rts` false: it does not drive the pin.
  bool drives_rts() const { return (words_[kCr1] & kUe) != 0 && (words_[kCr3] & kRtse) != 0; }
  bool rts() const { return (words_[kSr] & kRxne) != 0; }
  /// The last level given to rx_changed().
  bool rx() const { return rx_; }
  /// Asks for its interrupt.
  bool asks() const;
  /// Characters that came while the previous one had not been fetched.
  std::uint64_t lost() const { return lost_; }

 private:
  static constexpr std::uint32_t kPe = 1U << 0U, kFe = 1U << 1U, kNe = 1U << 2U, kOre = 1U << 3U, kIdle = 1U << 4U,
                                 kRxne = 1U << 5U, kTc = 1U << 6U, kTxe = 1U << 7U;
  static constexpr std::uint32_t kRe = 1U << 2U, kTe = 1U << 3U, kPs = 1U << 9U, kPce = 1U << 10U, kM = 1U << 12U,
                                 kUe = 1U << 13U;
  static constexpr std::uint32_t kRtse = 1U << 8U;
  struct Edge {
    std::uint64_t at;
    bool level;
  };

  /// Start, data and parity: what stands before the stop bits.
  unsigned word_end() const { return 1 + ((words_[kCr1] & kM) != 0 ? 9 : 8); }
  unsigned half_stops() const;
  std::uint64_t bit() const { return std::uint64_t{words_[kBrr]} * divider_; }
  std::uint64_t frame() const { return word_end() * bit() + half_stops() * bit() / 2; }
  std::uint64_t pclk_after(std::uint64_t cycle) const { return (cycle / divider_ + 1) * divider_; }
  unsigned data_mask() const { return (1U << (word_end() - 1 - ((words_[kCr1] & kPce) != 0 ? 1 : 0))) - 1; }
  bool parity_of(unsigned data) const;

  void write_control(std::uint32_t value, std::uint64_t now);
  bool sends() const { return cell_ > 0; }
  bool listens() const { return (words_[kCr1] & (kUe | kRe)) == (kUe | kRe); }
  void begin_soon(std::uint64_t now);
  void load();
  void send_cell();
  std::uint64_t sample_at(unsigned bit_number, unsigned sample) const;
  bool level_at(std::uint64_t cycle) const;
  bool vote(unsigned bit_number);
  void hunt();
  void check_start();
  void take_character();
  void receive(unsigned word, bool framing, bool noise);
  void forget_until(std::uint64_t cycle);

  unsigned divider_ = 1;
  RegisterWords<kRegisters, 7> words_;
  std::uint32_t seen_ = 0;  ///< flags of the last read of SR: DR may take them away
  // transmitter
  unsigned tdr_ = 0, out_ = 0, cell_ = 0;           ///< the next bit to put out; 0: idle
  std::uint64_t tx_at_ = kNever, frame_begin_ = 0;  ///< the next bit's; of the character under way
  std::uint64_t tx_free_ = 0;                       ///< the idle frame after TE is over
  bool tx_ = true;
  // receiver
  std::deque<Edge> edges_;          ///< of RX, not before the character that comes
  bool rx_ = true, before_ = true;  ///< now, and before the first of the edges
  std::uint64_t start_ = kNever;    ///< of the character that comes
  bool started_ = false;            ///< its start bit is one
  bool noise_ = false;
  std::uint64_t idle_at_ = kNever;
  std::uint64_t lost_ = 0;
};

}  // namespace dsdpv1::arm
