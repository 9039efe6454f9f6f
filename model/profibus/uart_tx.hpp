#pragma once
// The sending half of the UART bit engine: characters without a gap, framed by PBRTS (rulings P2, S2).
#include "model/profibus/baud.hpp"
#include "model/profibus/character_run.hpp"

namespace dsdpv1::profibus {

class UartTx {
 public:
  /// Sends `size` bytes, which must stay unchanged until busy() is false. The first start bit falls at `begin`; PBRTS
  /// rises `lead` cycles before and falls `trail` cycles after the end of the last stop bit.
  void send(const std::uint8_t* bytes, int size, int bit, Cycle begin, Cycle lead, Cycle trail);
  /// Before PBRTS rises: all of it comes so many cycles later.
  void postpone(Cycle by) {
    begin_ += by;
    end_ += by;
    next_ += by;
  }
  /// Aborts at once: PBTXD high, PBRTS low.
  void abort();
  /// The edge of `now`. Returns true at the edge at which PBRTS falls.
  bool eval(Cycle now);
  /// As eval(), at next() from the first start bit to end(): sends a whole run of equal bits, so that only level
  /// changes and character ends need an evaluation.
  void next_run() {
    if (frame_bits_ == 0) load();
    txd_ = (frame_ & 1U) != 0;
    const unsigned other = txd_ ? ~frame_ : frame_;  // its lowest 1 is the next bit of the other level
    const int run = __builtin_ctz(other | 1U << frame_bits_);
    frame_ >>= run;
    frame_bits_ -= run;
    next_ += static_cast<Cycle>(run) * bit_;
  }
  Cycle next() const { return next_; }

  /// Call while the first start bit begins. Returns the characters being sent and hides PBTXD until show() is called
  /// within them, or until they end.
  CharacterRun hide();
  bool begins(Cycle now) const { return rts_ && now == begin_; }
  /// PBTXD takes its real level at `now`.
  void show(Cycle now);

  bool txd() const { return txd_; }
  bool rts() const { return rts_; }
  bool planned() const { return next_ != kNever; }  ///< from send() until PBRTS has fallen
  Cycle end() const { return end_; }                ///< end of the last stop bit
  Cycle released() const { return end_ + trail_; }  ///< PBRTS falls

  /// `from`: all bytes being sent; at most `most`.
  template <class Archive>
  void store(Archive& archive, const std::uint8_t* from, int most) {
    auto& [frames, bytes, size, bit, begin, end, trail, next, frame, frame_bits, txd, rts] = *this;
    archive.within(0, most, size);
    archive.within(0, kBitCycles[kBaudCount - 1], bit);
    archive.cycles(begin, end, next);
    archive.lengths(trail);
    archive.within(0, kBitsPerCharacter, frame_bits);
    archive(frame, txd, rts);
    archive.place(bytes, from, size);
    if constexpr (Archive::kReads) frames = from;
    archive.check(is_possible());
  }

 private:
  void load();
  bool is_possible() const;

  const std::uint8_t *frames_ = nullptr, *bytes_ = nullptr;
  int size_ = 0;
  int bit_ = 0;
  Cycle begin_ = 0, end_ = 0, trail_ = 0;
  Cycle next_ = kNever;
  unsigned frame_ = 0;  // bits still to be sent, lowest first
  int frame_bits_ = 0;
  bool txd_ = true, rts_ = false;
};

}  // namespace dsdpv1::profibus
