#pragma once
// Writes a run's wave file: the pins of every chip, the line, and decoded states as words.
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/timeline.hpp"
#include "bus/wire/character_run.hpp"
#include "bus/wire/segment.hpp"
#include "io/waves/deferred_wave.hpp"
#include "io/waves/wave_selection.hpp"
#include "io/waves/wave_writer.hpp"
#include "tb/bench/observer.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/chip/chip_view.hpp"

namespace dsdpv1::tb {

/// In WaveOptions::on, besides codes: any violation.
inline constexpr const char* kAnyViolation = "violation";

/// `--wave` and its options.
struct WaveOptions {
  std::string path;  ///< empty: none
  WaveSelection selection;
  /// Codes that open a window, "violation" for any violation; empty: `selection` has one window.
  std::vector<std::string> on;
  bool inside = false;  ///< also internal signals of the chips
  std::string date;     ///< date in the file; empty: none
  /// pins are not followed, and there is no file, until `WaveRecorder::wake`; `triggered` then reports `on`
  bool asleep = false;
};

/// A run of characters: its changes are not reported one by one, so they are generated when a later event is written.
class LineRun {
 public:
  /// Begins with its changes and drops those left of the previous run.
  void begin(const bus::CharacterRun& run) {
    end();
    bus::for_each_change(run, [this](bus::Tick at, bool /*level*/) { edges_.push_back(at); });
  }
  /// Drops the remaining changes.
  void end() { edges_.clear(), next_ = 0; }
  bool is_under_way() const { return next_ < edges_.size(); }
  /// Time of the next change during the run.
  bus::Tick at() const { return edges_[next_]; }
  bool level() const { return next_ % 2 != 0; }
  void go_on() { ++next_; }

 private:
  std::vector<bus::Tick> edges_;  ///< falling and rising alternately
  std::size_t next_ = 0;
};

class WaveRecorder : public Observer, private bus::Listener {
 public:
  /// Attaches to the line as a separate station. `timeline` must outlive it.
  WaveRecorder(const WaveOptions& options, bus::Segment& segment, const bus::Timeline& timeline);

  // Declarations, before `begin`.
  // Slaves are numbered in the order in which they are added.
  // `host_port`: the serial port whose telegrams are reported, null: none.
  void add_chip(const std::string& name, const ChipKind& kind, const ChipView& chip, const char* host_port);
  /// `members`: its slaves or connections, all with the state `initial`.
  void add_master(const std::string& master, const std::vector<std::string>& members, const std::string& initial);
  /// Writes the first values.
  void begin();
  /// Opens the file; throws InputError. Call it before a run, or during one, if chips report all pins from now on and
  /// `now` is at least 1 ms before `from`.
  void wake(bus::Tick now, bus::Tick from, bus::Tick to, bool line);
  bool asleep() const { return asleep_; }
  /// While asleep: time of the first event in WaveOptions::on, its code and station.
  struct Trigger {
    bus::Tick at = 0;
    std::string station, code;
  };
  const std::optional<Trigger>& triggered() const { return triggered_; }

  void pin(std::size_t chip, bus::Tick at, PinNumber pin, Level level) override;
  /// Generates the changes of runs here from now on. The wave is the same as with reported changes, which take longer.
  void take_runs() { takes_runs_ = true; }
  void follows(std::size_t slave, PinNumber pin) override;
  void event(std::size_t slave, const profibus::Event& event) override;
  void character(bus::Tick now, const bus::ReceivedCharacter& heard) override;
  void inside(std::size_t slave, bus::Tick at, std::size_t signal, Level level, const std::string& word) override;
  void action(std::size_t slave, bus::Tick at, const std::string& words) override {
    make_changes(at, Turn::kLast);
    say(at, chips_[slave].user, words);
  }
  void telegram(const HeardTelegram& heard) override;
  void host_telegram(std::size_t slave, const HostTelegram& telegram) override;
  void master_state(bus::Tick now, const std::string& master, const std::string& member,
                    const std::string& state) override;
  /// `count` is shown with the code, so that each occurrence is a change.
  void counted(bus::Tick at, const std::string& station, const std::string& code, bool violation,
               std::uint64_t count) override;
  /// No window was opened.
  bool is_empty() const { return !writer_->has_window(); }
  // See WaveWriter.
  void save(bus::Tick at) {
    if (asleep_) return;
    make_changes(at, Turn::kLast);
    writer_->save(at);
  }
  bool failed() const { return writer_->failed(); }
  void check() const { writer_->check(); }
  void finish(bus::Tick end) {
    make_changes(end, Turn::kLast);
    writer_->finish(end);
  }

 private:
  using Signal = WaveWriter::Signal;
  /// The two directions of a bus are one signal.
  struct PinSignal {
    Signal signal = 0;
    const PinInfo* pin = nullptr;
    PinNumber other = 0;  ///< for a bus: the pin of the other direction
    Level level = kLevelZ;
    bool follows = false;       ///< the present run
    bool has_followed = false;  ///< a run, so that a change may be reported that was already made
  };
  struct ChipSignals {
    const ChipKind* kind = nullptr;
    const ChipView* chip = nullptr;
    std::vector<PinSignal> pins;
    std::vector<Signal> inside;
    Signal dp_state = 0, service = 0, user = 0;
    std::optional<Signal> request, reply;  ///< of the serial host port, if any
    std::array<Signal, profibus::kC2Channels> rm_entries{};
  };
  // At equal times chips have their turns first, in order, then the monitor, masters, and all others (bus::Timeline).
  struct Turn {
    static constexpr std::size_t kMonitor = SIZE_MAX - 2, kMaster = SIZE_MAX - 1, kLast = SIZE_MAX;
  };
  /// A signal changed by a run: a pin, or the line.
  struct Follower {
    std::size_t chip;
    PinNumber pin;
    bool is_line, is_input;
  };
  void line_changed(bus::Tick at, bool level) override {
    if (asleep_) return;
    make_changes(at, Turn::kLast);
    set(at, line_, level ? 1 : 0);
  }
  bool run_begins(const bus::CharacterRun& run) override;
  void run_cut(bus::Tick at, bool level) override;
  /// Writes the run's changes that come before an event written at `at`, or found now, in this turn.
  void make_changes(bus::Tick at, std::size_t turn) {
    if (run_.is_under_way()) make_changes_before(std::max(at, timeline_.now()), turn);
  }
  void make_changes_before(bus::Tick at, std::size_t turn);
  void make_change(const Follower& follower);
  std::size_t turn_of(const Follower& follower) const;
  void end_run();
  void show(bus::Tick at, std::size_t chip, PinNumber pin, Level level);
  std::size_t turn_of(const PinInfo& pin, std::size_t chip) const;
  void set(bus::Tick at, Signal signal, int level) {
    writer_->set(at, signal, level);
    last_ = at;
  }
  /// Events found late are shown at the wave's present time.
  void say(bus::Tick at, Signal signal, const std::string& word) {
    last_ = std::max(at, last_);
    writer_->say(last_, signal, word);
  }
  std::unique_ptr<WaveWriter> file(const WaveOptions& options);
  std::vector<Signal> add_inside(const ChipKind& kind);
  bool opens_window(const std::string& code, bool violation) const;

  const bus::Timeline& timeline_;
  const std::vector<std::string> on_;
  const bool inside_;
  bool asleep_;
  std::optional<Trigger> triggered_;
  DeferredWave* deferred_ = nullptr;  ///< of writer_
  std::unique_ptr<SelectedWave> writer_;
  bus::Tick last_ = 0;  ///< of the last change
  Signal line_ = 0, telegram_ = 0, character_ = 0;
  std::map<std::string, Signal> event_signals_;  ///< by station
  std::vector<ChipSignals> chips_;
  struct MasterState {
    Signal signal = 0;
    std::string initial;
  };
  std::map<std::string, MasterState> master_states_;  // by "master.member"
  LineRun run_;
  std::size_t sender_ = Turn::kMaster;  ///< the turn in which the run's changes are made
  std::vector<Follower> followers_;     ///< of the run, in the order in which they change
  std::size_t next_follower_ = 0;       ///< the maker of the run's next change
  bool takes_runs_ = false;
};

}  // namespace dsdpv1::tb
