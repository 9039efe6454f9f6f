#pragma once
// What a capture has on the line, but for one slave's part, put on a segment again.
#include <cstddef>
#include <memory>
#include <vector>

#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "lab/replay/recording.hpp"

namespace dsdpv1::tb::replay {

/// A telegram of the others as it is put on the line; times of the capture. It begins where it was recorded, or, where
/// the recorded times are too coarse for that, at the end of the one before.
struct PlacedTelegram {
  std::size_t telegram;  ///< position in Recording::telegrams
  Tick start, end;
};

/// In order of time.
std::vector<PlacedTelegram> place(const Recording& recording);

/// Plays once it is told when to begin.
class ReplayedLine : public bus::Agent {
 public:
  /// The first start bit of the capture, at `first` there, falls at `at`.
  void begin(Tick first, Tick at) {
    shift_ = at - first;
    begun_ = true;
    announce();
  }
  Tick next() const override { return begun_ && has_next() ? next_recorded() + shift_ : bus::kNever; }

 protected:
  virtual bool has_next() const = 0;
  virtual Tick next_recorded() const = 0;
  Tick shift() const { return shift_; }

 private:
  Tick shift_ = 0;
  bool begun_ = false;
};

/// By the levels of the capture where it has them, else by its telegrams in nominal bit times. All that is given must
/// outlive the line.
std::unique_ptr<ReplayedLine> make_line(bus::Segment& segment, const Recording& recording,
                                        const std::vector<PlacedTelegram>& placed);

}  // namespace dsdpv1::tb::replay
