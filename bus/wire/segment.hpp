#pragma once
// The RS-485 segment: one pair of wires, any number of stations. Idle level is high (EN 50170: binary 1); two drivers
// enabled at once are a collision, also while they drive the same level.
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bus/time.hpp"

namespace bus {

/// Hears the line. Called at the tick of the change, in the order of attachment; the new level is already that of the
/// segment.
class Listener {
 public:
  virtual ~Listener() = default;
  virtual void line_changed(Tick at, bool level) = 0;
};

using StationId = std::size_t;

/// Two drivers on the line at once, from the tick on which the second was enabled.
struct Collision {
  Tick at;
  std::string first, second;
};

class Segment {
 public:
  /// `listener` may be null for a station that only sends. Both must outlive the segment's use.
  StationId attach(std::string name, Listener* listener);
  /// What a station's driver does from `at` on: enabled (RTS) and the level that it drives when enabled.
  /// While two drivers fight, low wins, so that no receiver sees an undisturbed telegram.
  void drive(StationId station, Tick at, bool enabled, bool level);
  /// A fault on the wire: forces the level (short circuit, glitch) until called with nullopt.
  void force(Tick at, std::optional<bool> level);
  /// A station unplugged hears an idle line and its driver does not reach the wire.
  void plug(StationId station, Tick at, bool plugged);

  bool level() const { return level_; }
  /// What this station hears: the segment's level, or idle while it is unplugged.
  bool level_at(StationId station) const;
  std::function<void(const Collision&)> on_collision;

 private:
  struct Station {
    std::string name;
    Listener* listener = nullptr;
    bool enabled = false, drives = true, plugged = true;
    bool heard = true;  ///< the level that the listener was told last
  };
  static bool on_wire(const Station& station) { return station.enabled && station.plugged; }
  bool driven_level() const;
  void settle(Tick at);
  bool tell_changes(Tick at);
  void report_collision(Tick at, StationId newcomer);

  std::vector<Station> stations_;
  std::optional<bool> forced_;
  bool level_ = true;
  bool telling_ = false;  ///< a listener that drives the line while it is being told must not be told out of order
};

}  // namespace bus
