#pragma once
// The last edges of a line, and the telegram derived from them.
#include <deque>
#include <string>

#include "bus/time.hpp"

namespace dsdpv1::cosim {

using bus::Tick;

/// The last telegram of a station of the segment, as far as the edges of the line show it.
struct LineTelegram {
  Tick start = 0;
  std::string text;  ///< as text; empty if there was none
};

class LineHistory {
 public:
  void add(Tick at, bool level);
  /// The last telegram; `rate` 0..9 is that of the chip, otherwise the shortest pulse determines it. `until`: ignores
  /// characters that end later; by default the line is assumed to keep its level.
  LineTelegram last_telegram(int rate, Tick until = bus::kNever) const;

 private:
  struct Edge {
    Tick at;
    bool level;
  };
  int likely_rate() const;

  std::deque<Edge> edges_;
};

}  // namespace dsdpv1::cosim
