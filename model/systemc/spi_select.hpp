#pragma once
// XSS as a line of a platform whose SPI controller transfers single bytes. Independent of SystemC and of the chip.
#include <algorithm>

#include "model/dsdpv1/serial_host.hpp"
#include "model/systemc/character_line.hpp"

namespace dsdpv1::systemc {

/// Such a controller moves XSS and transfers at one time, without the times between them that a board has. So XSS rises
/// at least `lag` after the last clock and stays high for `gap`, and the first clock is `lead` after its fall; later
/// moves of the platform keep their times. A rise within a transfer is at once.
class SpiSelect {
 public:
  explicit SpiSelect(const SpiTiming& timing) : timing_(timing) {}

  /// The platform's level from `now` on; `transfers`: clocks are running.
  void move(Tick now, bool level, bool transfers) {
    if (level == level_) return;
    level_ = level;
    const Tick least = level ? (transfers ? now : std::max(clocks_end_ + timing_.lag, moved_)) : moved_ + timing_.gap;
    moved_ = std::max(now, least);
    edges_.push({moved_, level});
  }
  /// The platform's level.
  bool level() const { return level_; }
  /// When a transfer asked for at `now` may begin, half a clock before the first rise.
  Tick begin(Tick now) const { return level_ ? now : std::max(now, moved_ + timing_.lead - timing_.low); }
  void clocks_end(Tick at) { clocks_end_ = at; }

  /// Tick of XSS's next change, kNever without one.
  Tick next() const { return edges_.next(); }
  Edge take() { return edges_.take(); }

  template <class Archive>
  void store(Archive& archive) {
    archive(level_, edges_);
    archive.ticks(moved_, clocks_end_);
  }

 private:
  SpiTiming timing_;
  bool level_ = true;
  Tick moved_ = 0;       ///< the last change
  Tick clocks_end_ = 0;  ///< the last fall of SCK
  EdgeQueue edges_;
};

}  // namespace dsdpv1::systemc
