#pragma once
// The RS-485 segment: one pair of wires, any number of stations. Idle level is high (EN 50170: binary 1); two drivers
// enabled at once are a collision, also while they drive the same level.
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bus/time.hpp"
#include "bus/wire/character_run.hpp"

namespace dsdpv1::bus {

/// Receives the line. Called at the tick of the change, in the order of attachment; the segment already has the new
/// level.
class Listener {
 public:
  virtual ~Listener() = default;
  virtual void line_changed(Tick at, bool level) = 0;
  /// A run begins now, of another station or the listener's own; its bytes are valid during the call only. Return true
  /// to skip its changes: the listener is not called until the end of the run, or until run_cut.
  virtual bool run_begins(const CharacterRun& /*run*/) { return false; }
  /// Changes up to `at` have happened, the line is now at `level`, and later changes are reported.
  virtual void run_cut(Tick /*at*/, bool /*level*/) {}
  /// Since its last call the listener's filter has skipped so many runs for stations, not counting the last run, which
  /// is passed next by run_begins: late, and it must be taken.
  virtual void runs_passed(std::uint64_t /*for_stations*/) {}
};

/// A time, from `from` on and before `until`, in which a listener may receive changes late.
struct Deafness {
  Tick from = kNever, until = kNever;

  bool at(Tick tick) const { return tick >= from && tick < until; }
};

using StationId = std::size_t;

/// Two drivers on the line at once, from the tick on which the second was enabled.
struct Collision {
  Tick at;
  std::string first, second;
};

/// Gets what a station drives, instead of the line.
class Diversion {
 public:
  virtual ~Diversion() = default;
  /// As Segment::drive.
  virtual void driven(Tick at, bool enabled, bool level) = 0;
};

class Segment {
 public:
  /// `listener` may be null for a station that only sends. Both must outlive the segment's use.
  StationId attach(std::string name, Listener* listener);
  /// Sets a station's driver from `at` on: enabled (RTS) and its level when enabled. While two drivers conflict, low
  /// wins, so that no receiver sees an undisturbed telegram.
  void drive(StationId station, Tick at, bool enabled, bool level);
  /// All changes of the station go to `diversion` from `at` on, and to the line what `deliver` gets. Returns
  /// whether its driver is enabled. Replaces an earlier diversion.
  bool divert(StationId station, Tick at, Diversion& diversion);
  void end_diversion(StationId station) { stations_[station].diversion = nullptr; }
  /// As `drive`, past the diversion.
  void deliver(StationId station, Tick at, bool enabled, bool level);
  /// The station's listener receives changes within this time late: before the next one reported at once, or by `hear`.
  /// For receivers that know their position in a character; replaces an earlier setting.
  void set_deafness(StationId station, const Deafness& deafness) { stations_[station].deafness = deafness; }
  /// The station's listener receives runs skipped by its filter late: before its next call, or by `hear`. Replaces an
  /// earlier setting.
  void set_filter(StationId station, const RunFilter& filter) { stations_[station].filter = filter; }
  /// Sends this run from now on, run.start, with the driver of `station` enabled. True: no listener needs its changes,
  /// so nothing is driven until its end, or until the station's listener gets run_cut; the bytes must stay valid until
  /// then. False: drive the changes; listeners that have taken the run are not called.
  bool send_run(StationId station, const CharacterRun& run);
  /// All listeners receive changes again from `at` on; does nothing without a run.
  void cut_run(Tick at);
  /// Reports everything pending to a listener, each change and run with its own tick.
  void hear(StationId station) {
    hear_runs(station);
    if (stations_[station].next_change < changes_.size()) tell_missed(station);
  }

  /// Reports the runs only.
  void hear_runs(StationId station) {
    if (stations_[station].passes) tell_passed(stations_[station]);
  }

  /// A fault on the wire: forces the level (short circuit, glitch) until called with nullopt.
  void force(Tick at, std::optional<bool> level);
  /// An unplugged station receives an idle line and does not drive the wire.
  void plug(StationId station, Tick at, bool plugged);

  bool level() const { return level_; }
  /// The level just before `at`, even if a station has already driven at `at`; no station may have driven later.
  bool level_before(Tick at) const;
  /// The level that this station receives: the segment's, or idle while it is unplugged.
  bool level_at(StationId station) const;
  /// Number of attached stations: the next one's StationId.
  std::size_t stations() const { return stations_.size(); }
  std::function<void(const Collision&)> on_collision;
  /// Called for each call of `drive`, before the listeners; a run that all take has calls only at its ends.
  std::function<void(StationId, Tick at, bool enabled, bool level)> on_drive;

 private:
  struct Station {
    std::string name;
    Listener* listener = nullptr;
    Diversion* diversion = nullptr;
    bool enabled = false, drives = true, plugged = true;
    bool heard = true;      ///< the level last reported to the listener
    std::uint64_t run = 0;  ///< the number of the last run that it took
    Deafness deafness = {};
    std::size_t next_change = 0;  ///< in changes_, the first not reported yet
    RunFilter filter = {};
    bool passes = false;  ///< its filter has skipped last_run_
    bool last_for_station = false;
    std::uint64_t passed_for_stations = 0;  ///< before last_run_
  };
  struct Change {
    Tick at;
    bool level;
  };
  static bool on_wire(const Station& station) { return station.enabled && station.plugged; }
  struct Run {
    CharacterRun characters = {};
    StationId sender = 0;
    bool driven = false;  ///< a listener needs the changes
  };
  /// A run offered by a sender, and its addressee according to the reader.
  struct Offer {
    const CharacterRun& run;
    bool after_gap = false;
    RunReader reader = nullptr;
    int addressee = kNoTelegram;
  };
  bool in_run(const Station& station) const { return run_ && station.run == run_count_; }
  bool may_send_run(StationId station) const;
  bool offer(StationId station, Offer& offer);
  static bool passes(const Station& station, Offer& offer);
  void keep(const CharacterRun& run);
  void tell_passed(Station& station);
  void end_run();
  void update_drivers(StationId station, Tick at, bool was_on_wire);
  bool driven_level() const;
  void settle(Tick at);
  void tell_all(Tick at);
  bool tell_changes(Tick at);
  void note_change(Tick at);
  static bool tell(Station& station, Tick at, bool level);
  void tell_missed(StationId station);
  void tell_missed(Station& station, Tick before);
  void forget_changes();
  void report_collision(Tick at, StationId newcomer);

  // Changes not yet reported to deaf listeners, in order; reported before there are more than this.
  static constexpr std::size_t kMostMissed = 4096;
  static constexpr std::size_t kLongestKept = 256;  ///< no telegram is longer

  std::vector<Station> stations_;
  std::vector<StationId> drivers_;  ///< on the wire
  std::vector<Change> changes_;
  std::optional<bool> forced_;
  std::optional<Run> run_;
  std::uint64_t run_count_ = 0;  ///< the number of the last run
  CharacterRun last_run_;
  std::array<std::uint8_t, kLongestKept> last_bytes_ = {};  ///< bytes of last_run_, if a listener skips it
  bool level_ = true, noted_ = true;
  Tick noted_at_ = 0;         ///< the last change ...
  bool before_noted_ = true;  ///< ... and the level before all changes at that tick
  bool telling_ = false;  ///< a listener that drives the line while being called must not cause reports out of order
};

}  // namespace dsdpv1::bus
