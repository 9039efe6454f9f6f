#pragma once
// Replays a capture on a segment, without one slave's telegrams.
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "lab/replay/recording.hpp"

namespace dsdpv1::tb::replay {

/// A telegram of the others for the line; times of the capture. It begins at its recorded time, or, if the recorded
/// times are too coarse, at the end of the one before.
struct PlacedTelegram {
  std::size_t telegram;  ///< position in Recording::telegrams
  Tick start, end;
  bool found = false;  ///< RecordedRequest::found
};

/// In order of time.
std::vector<PlacedTelegram> place(const Recording& recording);

/// Plays once `begin` was called.
class ReplayedLine : public bus::Agent {
 public:
  /// The next start bit of the capture, at `first` there, falls at `at`.
  void begin(Tick first, Tick at) {
    shift_ = at - first;
    begun_ = true;
    announce();
  }
  Tick next() const override { return begun_ && has_next() ? next_recorded() + shift_ : bus::kNever; }

  /// Called before a telegram at another rate than the one before.
  std::function<void(int baud)> on_baud;
  /// Called before a telegram whose rate the recorded slave has found. False: the line stops until the next `begin`,
  /// with this telegram (position in the placed ones) as the next.
  std::function<bool(std::size_t placed)> may_go_on;

 protected:
  void stop() { begun_ = false; }
  virtual bool has_next() const = 0;
  virtual Tick next_recorded() const = 0;
  Tick shift() const { return shift_; }

 private:
  Tick shift_ = 0;
  bool begun_ = false;
};

/// Plays the levels of the capture if it has them, else its telegrams in nominal bit times. All arguments must outlive
/// the line.
std::unique_ptr<ReplayedLine> make_line(bus::Segment& segment, const Recording& recording,
                                        const std::vector<PlacedTelegram>& placed);

}  // namespace dsdpv1::tb::replay
