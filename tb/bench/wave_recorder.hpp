#pragma once
// What a run puts into its wave file: the pins of every chip, the line, and decoded states as words.
#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bus/wire/segment.hpp"
#include "tb/bench/chip_view.hpp"
#include "tb/bench/observer.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/waves/wave_writer.hpp"

namespace tb {

class WaveRecorder : public Observer, private bus::Listener {
 public:
  /// Listens to the line as a station of its own. `kind` must outlive it.
  WaveRecorder(const std::string& path, bus::Segment& segment, const ChipKind& kind);

  // Declarations, before `begin`.
  /// Slaves are numbered in the order in which they are added.
  void add_chip(const std::string& name, const ChipView& chip);
  /// `members`: its slaves or connections, all in the state `initial`.
  void add_master(const std::string& master, const std::vector<std::string>& members, const std::string& initial);
  /// Writes the first values.
  void begin();

  void pin(std::size_t slave, bus::Tick at, PinNumber pin, Level level) override;
  void event(std::size_t slave, const profibus::Event& event) override;
  void telegram(const HeardTelegram& telegram) override { writer_->say(telegram.now, telegram_, telegram.words()); }
  void master_state(bus::Tick now, const std::string& master, const std::string& member,
                    const std::string& state) override;
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

  const ChipKind& kind_;
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
