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

/// Hears the line. Called at the tick of the change, in the order of attachment; the new level is already that of the
/// segment.
class Listener {
 public:
  virtual ~Listener() = default;
  virtual void line_changed(Tick at, bool level) = 0;
  /// A run begins now, of another station or the listener's own; its bytes are there for the call only. True: the
  /// listener does not want its changes; it is told nothing until the end of the run, or until run_cut.
  virtual bool run_begins(const CharacterRun& /*run*/) { return false; }
  /// What changed up to `at` has changed, the line is at `level` now, and what comes behind it is told.
  virtual void run_cut(Tick /*at*/, bool /*level*/) {}
  /// Since it was told something last there were so many runs for stations that its filter has kept from it, besides
  /// the last one, which is told next, by run_begins: late, and it has to be taken.
  virtual void runs_passed(std::uint64_t /*for_stations*/) {}
};

/// A time, from `from` on and before `until`, in which a listener need not hear a change at once.
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

class Segment {
 public:
  /// `listener` may be null for a station that only sends. Both must outlive the segment's use.
  StationId attach(std::string name, Listener* listener);
  /// What a station's driver does from `at` on: enabled (RTS) and the level that it drives when enabled.
  /// While two drivers fight, low wins, so that no receiver sees an undisturbed telegram.
  void drive(StationId station, Tick at, bool enabled, bool level);
  /// The station's listener is told a change within this time late: before the next one that it hears at once, or by
  /// `hear`. For receivers that know where in a character they are; replaces what was said before.
  void set_deafness(StationId station, const Deafness& deafness) { stations_[station].deafness = deafness; }
  /// The station's listener is told of a run that its filter keeps from it late: before the next thing that it is told,
  /// or by `hear`. Replaces what was said before.
  void set_filter(StationId station, const RunFilter& filter) { stations_[station].filter = filter; }
  /// From now on, run.start, `station` sends this run, its driver enabled. True: nobody needs its changes, so that
  /// nothing is driven until its end, or until the station's listener hears run_cut; the bytes have to stay until then.
  /// False: they are to be driven;
  /// listeners that have taken the run are not told.
  bool send_run(StationId station, const CharacterRun& run);
  /// Everybody hears changes again from `at` on; nothing when no run is sent.
  void cut_run(Tick at);
  /// Tells a listener what it has not heard yet, each change and run with its own tick.
  void hear(StationId station) {
    hear_runs(station);
    if (stations_[station].next_change < changes_.size()) tell_missed(station);
  }

  /// Tells it the runs only.
  void hear_runs(StationId station) {
    if (stations_[station].passes) tell_passed(stations_[station]);
  }

  /// A fault on the wire: forces the level (short circuit, glitch) until called with nullopt.
  void force(Tick at, std::optional<bool> level);
  /// A station unplugged hears an idle line and its driver does not reach the wire.
  void plug(StationId station, Tick at, bool plugged);

  bool level() const { return level_; }
  /// The level just before `at`, be it that somebody has driven at `at` already; nobody has later.
  bool level_before(Tick at) const;
  /// What this station hears: the segment's level, or idle while it is unplugged.
  bool level_at(StationId station) const;
  /// How many have been attached: the next one's StationId.
  std::size_t stations() const { return stations_.size(); }
  std::function<void(const Collision&)> on_collision;
  /// Each call of `drive`, before anybody hears of it; of a run that all take there is none but at its ends.
  std::function<void(StationId, Tick at, bool enabled, bool level)> on_drive;

 private:
  struct Station {
    std::string name;
    Listener* listener = nullptr;
    bool enabled = false, drives = true, plugged = true;
    bool heard = true;      ///< the level that the listener was told last
    std::uint64_t run = 0;  ///< the number of the run that it has taken last
    Deafness deafness = {};
    std::size_t next_change = 0;  ///< in changes_, the first that it has not heard
    RunFilter filter = {};
    bool passes = false;  ///< its filter has kept last_run_ from it
    bool last_for_station = false;
    std::uint64_t passed_for_stations = 0;  ///< before that one
  };
  struct Change {
    Tick at;
    bool level;
  };
  static bool on_wire(const Station& station) { return station.enabled && station.plugged; }
  struct Run {
    CharacterRun characters = {};
    StationId sender = 0;
    bool driven = false;  ///< somebody wants the changes
  };
  /// A run that a sender offers, and whom its reader found it to be for.
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

  // What the deaf have missed, in order; all hear it before it grows beyond this.
  static constexpr std::size_t kMostMissed = 4096;
  static constexpr std::size_t kLongestKept = 256;  ///< no telegram is longer

  std::vector<Station> stations_;
  std::vector<StationId> drivers_;  ///< that are on the wire
  std::vector<Change> changes_;
  std::optional<bool> forced_;
  std::optional<Run> run_;
  std::uint64_t run_count_ = 0;  ///< the number of the last run
  CharacterRun last_run_;
  std::array<std::uint8_t, kLongestKept> last_bytes_ = {};  ///< those of last_run_, where somebody passes it
  bool level_ = true, noted_ = true;
  Tick noted_at_ = 0;         ///< the last change ...
  bool before_noted_ = true;  ///< ... and the level before all changes at that tick
  bool telling_ = false;      ///< a listener that drives the line while it is being told must not be told out of order
};

}  // namespace dsdpv1::bus
