#pragma once
// What a run puts into its wave file: the pins of every chip, the line, and decoded states as words.
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bus/wire/segment.hpp"
#include "tb/bench/chip_view.hpp"
#include "tb/bench/observer.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/waves/wave_selection.hpp"
#include "tb/waves/wave_writer.hpp"

namespace tb {

/// Of WaveOptions::on, beside the codes: any violation.
inline constexpr const char* kAnyViolation = "violation";

/// `--wave` and what goes with it.
struct WaveOptions {
  std::string path;  ///< empty: no wave
  WaveSelection selection;
  /// Codes that open a window, "violation" for any violation; empty: `selection` has one window.
  std::vector<std::string> on;
  bool inside = false;  ///< inner signals of the chips, too
};

class WaveRecorder : public Observer, private bus::Listener {
 public:
  /// Listens to the line as a station of its own. `kind` must outlive it.
  WaveRecorder(const WaveOptions& options, bus::Segment& segment, const ChipKind& kind);

  // Declarations, before `begin`.
  /// Slaves are numbered in the order in which they are added.
  void add_chip(const std::string& name, const ChipView& chip);
  /// `members`: its slaves or connections, all in the state `initial`.
  void add_master(const std::string& master, const std::vector<std::string>& members, const std::string& initial);
  /// Writes the first values.
  void begin();

  void pin(std::size_t slave, bus::Tick at, PinNumber pin, Level level) override;
  void event(std::size_t slave, const profibus::Event& event) override;
  void character(bus::Tick now, const bus::ReceivedCharacter& heard) override;
  void inside(std::size_t slave, bus::Tick at, std::size_t signal, Level level, const std::string& word) override;
  void action(std::size_t slave, bus::Tick at, const std::string& words) override {
    say(at, chips_[slave].user, words);
  }
  void telegram(const HeardTelegram& telegram) override;
  void master_state(bus::Tick now, const std::string& master, const std::string& member,
                    const std::string& state) override;
  /// A code of the log: `station` is a chip, or "bus". `count` is shown with it, so that each is a change.
  void happened(bus::Tick at, const std::string& station, const std::string& code, bool violation, std::uint64_t count);
  /// Nothing has opened a window.
  bool is_empty() const { return !writer_->has_window(); }
  // See WaveWriter.
  void save(bus::Tick at) { writer_->save(at); }
  bool failed() const { return writer_->failed(); }
  void check() const { writer_->check(); }
  void finish(bus::Tick end) { writer_->finish(end); }

 private:
  using Signal = WaveWriter::Signal;
  /// The two directions of a bus are one signal.
  struct PinSignal {
    Signal signal = 0;
    const PinInfo* pin = nullptr;
    PinNumber other = 0;  ///< of a bus: the pin of the other direction
    Level level = kLevelZ;
  };
  struct ChipSignals {
    const ChipView* chip = nullptr;
    std::vector<PinSignal> pins;
    std::vector<Signal> inside;
    Signal dp_state = 0, service = 0, user = 0;
    std::array<Signal, profibus::kC2Channels> rm_entries{};
  };
  void line_changed(bus::Tick at, bool level) override { set(at, line_, level ? 1 : 0); }
  void set(bus::Tick at, Signal signal, int level) {
    writer_->set(at, signal, level);
    last_ = at;
  }
  /// What is found out late is shown where the wave is.
  void say(bus::Tick at, Signal signal, const std::string& word) {
    last_ = std::max(at, last_);
    writer_->say(last_, signal, word);
  }
  std::vector<Signal> add_inside();
  bool opens_window(const std::string& code, bool violation) const;

  const ChipKind& kind_;
  const std::vector<std::string> on_;
  const bool inside_;
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
};

}  // namespace tb
