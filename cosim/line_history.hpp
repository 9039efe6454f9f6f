#pragma once
// The last edges of a line, and the telegram that they were.
#include <deque>
#include <string>

#include "bus/time.hpp"

namespace dsdpv1::cosim {

using bus::Tick;

/// What a station of the segment sent last, as far as it can be read from the edges of the line.
struct LineTelegram {
  Tick start = 0;
  std::string text;  ///< in words; empty when there was none
};

class LineHistory {
 public:
  void add(Tick at, bool level);
  /// The last telegram; `rate` 0..9 is that of the chip, anything else: as the shortest pulse says.
  /// `until`: characters that end later are left out; left out itself: the line is taken to stay as it is.
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
