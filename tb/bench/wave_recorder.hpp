#pragma once
// What a run puts into its wave file: the pins of every chip, the line, and decoded states as words.
#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bus/wire/segment.hpp"
#include "tb/bench/chip_view.hpp"
#include "tb/waves/wave_writer.hpp"

namespace tb {

class WaveRecorder : private bus::Listener {
 public:
  /// Listens to the line as a station of its own.
  WaveRecorder(const std::string& path, bus::Segment& segment);

  // Declarations, before `begin`.
  /// Returns the chip's number for `pin` and `dp_state`.
  std::size_t add_chip(const std::string& name, const PinTable& pins, const ChipView& chip);
  /// `members`: its slaves or connections, all in the state `initial`.
  void add_master(const std::string& master, const std::vector<std::string>& members, const std::string& initial);
  /// Writes the first values.
  void begin();

  void pin(std::size_t chip, bus::Tick at, PinNumber pin, Level level);
  void dp_state(std::size_t chip, bus::Tick at, const std::string& word);
  /// A row of the RM registry (table 30) has changed; `channel` 0 or 1.
  void rm_entry(std::size_t chip, bus::Tick at, int channel, const std::string& words);
  void master_state(const std::string& master, const std::string& member, bus::Tick at, const std::string& word);
  /// The telegram that has just ended, in words.
  void telegram(bus::Tick at, const std::string& words);
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
    Signal dp_state = 0;
    std::array<Signal, profibus::kC2Channels> rm_entries{};
  };
  void line_changed(bus::Tick at, bool level) override { writer_->set(at, line_, level ? 1 : 0); }

  std::unique_ptr<WaveWriter> writer_;
  Signal line_ = 0, telegram_ = 0;
  std::vector<ChipSignals> chips_;
  struct MasterState {
    Signal signal = 0;
    std::string initial;
  };
  std::map<std::string, MasterState> master_states_;  // by "master.member"
};

}  // namespace tb
