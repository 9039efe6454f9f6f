#pragma once
// The shift register of the SPI port (SP1, SP2, SP3; docs/microarchitecture_rsu.md 5.1, 5.7): clocked by SCK, with tick
// resolution. It passes a byte and `flip`, which toggles with each byte, to the CLK domain.
#include <algorithm>
#include <array>

#include "model/dsdpv1/config.hpp"
#include "model/dsdpv1/wire.hpp"
#include "model/profibus/event_log.hpp"
#include "model/profibus/synchroniser.hpp"

namespace dsdpv1 {

class SpiShift {
 public:
  SpiShift(profibus::EventLog& log, const Config& config)
      : log_(log), strobe_(config.spi_strobe), data_(config.spi_data), delay_(config.spi_miso_delay) {}

  /// In reset and in other modes the port only follows the levels.
  void reset();
  /// In SPI mode: the edge of CLK at which the logic has seen XSS high. Until then the port does nothing.
  void listen(Cycle now);
  bool listening() const { return listening_; }

  /// A change at `at`.
  void set_xss(Tick at, bool level);
  void set_sck(Tick at, bool level);
  void set_mosi(Tick at, bool level);
  Level level(Pin pin) const;

  /// XSS and flip as seen by the logic at the edge of `now`.
  void eval(Cycle now) {
    xss_seen_.eval(now);
    flip_seen_.eval(now);
  }
  Cycle next() const { return std::min(xss_seen_.next(), flip_seen_.next()); }
  bool xss() const { return xss_seen_.level(); }
  bool flip() const { return flip_seen_.level(); }

  /// Values strictly before the edge of CLK being evaluated.
  std::uint8_t byte() const { return byte_; }
  Tick byte_at() const { return byte_at_; }  ///< its eighth rise
  Tick fell_at() const { return fell_at_; }  ///< XSS's last fall

  /// tx[slot] at the edge of `now`; both FF.
  void load(Cycle now, int slot, std::uint8_t value);
  void clear_tx(Cycle now);

  /// MISO, and the tick of its next change.
  Level miso() const { return miso_; }
  Tick drive_at() const { return pending_count_ > 0 ? pending_[0].at : profibus::kNever; }
  void drive();

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, strobe, data, delay, xss, sck, mosi, xss_seen, flip_seen, listening, listening_since, bits, bits_before,
           bits_at, shift, byte, flip, byte_at, tx, tx_before, loaded_at, miso, pending, pending_count, fell_at,
           rose_at, sck_rise, sck_fall, sck_fall_before, rise_bit, first_rise, hold_due] = *this;
    archive.given(log, strobe, data, delay);
    archive(xss, sck, mosi, xss_seen, flip_seen, listening, bits, bits_before, shift, byte, flip, tx, tx_before);
    archive(pending, rise_bit, first_rise, hold_due);
    archive.ticks(listening_since, bits_at, byte_at, loaded_at, fell_at, rose_at, sck_rise, sck_fall, sck_fall_before);
    archive.within(kLevelX, Level{1}, miso);
    archive.within(0U, kPending, pending_count);
    archive.check(are_in_order(pending.data(), pending.data() + pending_count));
  }

 private:
  static constexpr unsigned kPending = 8;  // pending changes of MISO: a period of SCK is 250 ticks or more
  struct Change {
    Tick at = 0;
    Level level = 0;

    template <class Archive>
    void store(Archive& archive) {
      auto& [when, next] = *this;
      archive.ticks(when);
      archive.within(kLevelX, Level{1}, next);
    }
  };
  static bool are_in_order(const Change* begin, const Change* end) {
    return std::is_sorted(
        begin, end, [](const Change& a, const Change& b) { return a.at < b.at; });
  }
  void begin_frame(Tick at);
  void end_frame(Tick at);
  void rise(Tick at);
  void fall(Tick at);
  void check_data(Tick at);
  void keep_tx(Cycle now);
  void report(Tick at, profibus::Reason reason, Tick seen, std::uint32_t limit, unsigned bit = 0);

  profibus::EventLog& log_;
  const std::uint32_t strobe_, data_, delay_;
  Wire xss_{true}, sck_{false}, mosi_{false};
  profibus::Synchroniser xss_seen_{true}, flip_seen_{false};
  bool listening_ = false;
  Tick listening_since_ = 0;

  unsigned bits_ = 0, bits_before_ = 0;  // c, and its value strictly before bits_at_
  Tick bits_at_ = Wire::kLongAgo;
  std::uint8_t shift_ = 0, byte_ = 0;
  bool flip_ = false;
  Tick byte_at_ = Wire::kLongAgo;
  std::array<std::uint8_t, 2> tx_{0xFF, 0xFF}, tx_before_{0xFF, 0xFF};  // before: strictly before loaded_at_
  Tick loaded_at_ = Wire::kLongAgo;
  Level miso_ = kLevelZ;
  std::array<Change, kPending> pending_{};
  unsigned pending_count_ = 0;

  // limits: ticks from which they are measured
  Tick fell_at_ = Wire::kLongAgo, rose_at_ = Wire::kLongAgo;           // XSS
  Tick sck_rise_ = Wire::kLongAgo;                                     // that counted
  Tick sck_fall_ = Wire::kLongAgo, sck_fall_before_ = Wire::kLongAgo;  // with c >= 1; the previous one, strictly before
  unsigned rise_bit_ = 0;
  bool first_rise_ = false, hold_due_ = false;
};

}  // namespace dsdpv1
