#pragma once
// The records of one chip in a SystemC platform, for a chip of any kind: the bench's observers, fed by what a module
// reports.
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "bus/monitor/monitor.hpp"
#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "kinds/user_cpu/handshake_counters.hpp"
#include "model/systemc/module_reports.hpp"
#include "tb/bench/capture_recorder.hpp"
#include "tb/bench/check_watch.hpp"
#include "tb/bench/host_watch.hpp"
#include "tb/bench/journal.hpp"
#include "tb/bench/observer.hpp"
#include "tb/bench/wave_recorder.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

struct RecordingOptions {
  std::string name;  ///< of the slave
  WaveOptions wave;
  std::string log, capture;
  ChecksMode checks = ChecksMode::kFail;
  std::optional<int> baud;       ///< absent: the line is read once the chip has found its rate
  bool accesses_by_pins = true;  ///< else no pin shows them: they are passed on as reported
  std::string view, engine;
};

/// The chip, for the bench's observers.
class RecordedChip : public ChipView {
 public:
  explicit RecordedChip(std::vector<Level> levels) : levels_(std::move(levels)) {}

  void set_reset(Tick /*at*/, bool /*level*/) override {}
  void reset_host(Tick /*at*/) override {}
  bus::StationId station() const override { return 0; }
  bool tells_looks() const override { return false; }
  /// As the observers have been told.
  Level level(PinNumber pin) const override { return levels_.at(pin); }
  void told(PinNumber pin, Level level) { levels_.at(pin) = level; }

  /// Reports internal signals that have changed.
  virtual void look_inside(Tick at, ChipListener& listener) = 0;

 private:
  std::vector<Level> levels_;
};

/// Makes one stream in order of time of a module's reports: an access carried out ahead of
/// simulation time waits until the chip has come there.
class Recording {
 public:
  /// `settings`: the chip's. Throws InputError.
  Recording(const RecordingOptions& options, const ChipKind& kind, std::shared_ptr<const OwnSettings> settings,
            const checks::Limits& limits, const std::vector<std::string>& allowed, std::unique_ptr<RecordedChip> chip);
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// The pins that must be reported, and whether those of the chip's accesses may be late.
  PinMask pins() const;
  bool accepts_late() const { return !waves_; }
  bool looks_inside() const { return waves_ && inside_; }

  // Reports of the module. `now`: the chip's present tick.
  void pin(Tick now, Tick at, PinNumber pin, Level level);
  void sample(Tick now, Tick at);
  void event(Tick now, const profibus::Event& event);
  void accessed(Tick now, const systemc::AccessReport& access);
  void advanced(Tick to);

  /// The end, at which all before it has been reported. Once.
  void finish(Tick end);
  const RunResult& result() const { return result_; }
  const SocketUse& socket() const { return socket_; }
  bool is_finished() const { return finished_; }

 private:
  /// Something that the module has reported ahead of the chip's time.
  struct Ahead {
    enum class What : std::uint8_t { kPin, kSample, kEvent, kAccess } what = What::kPin;
    Tick at = 0;  ///< the time at which it is passed on
    PinNumber pin = 0;
    Level level = 0;  ///< of the pin; the byte of an access
    Tick sample = 0;
    profibus::Event event{};
    std::uint16_t address = 0;
    bool write = false;
  };

  /// TSDR of the chip's answers.
  struct Answers : Observer {
    explicit Answers(const RecordedChip& chip) : own(chip) {}
    void telegram(const HeardTelegram& heard) override;
    const RecordedChip& own;
    Tsdr tsdr;
  };

  void add_observers();
  void put_ahead(const Ahead& item);
  void pass_until(Tick at);
  void pass(const Ahead& item);
  void pass_pin(Tick at, PinNumber pin, Level level);
  void pass_event(const profibus::Event& event);
  void drive_line(Tick at);
  void note_late(Tick at, PinNumber pin);
  void note_handshake(Tick at, PinNumber pin, bool level);
  void begin();
  void run_to(Tick at);
  Tick in_order(Tick at);
  void collect(Tick end);
  void close_files(Tick end);

  const ChipKind& kind_;
  const BoardPins places_;
  const PinNumber r_req_, r_sta_;  ///< kMostPins: the chip has none
  const bool inside_, by_pins_, rate_given_;
  scenario::Scenario scenario_;
  std::unique_ptr<RecordedChip> chip_;
  bus::Segment segment_;
  bus::Timeline timeline_;
  Observers observers_{timeline_};
  Answers answers_{*chip_};
  CheckWatch checks_;
  HostWatch hosts_;
  Journal journal_;
  std::optional<WaveRecorder> waves_;
  std::optional<CaptureRecorder> capture_;
  std::optional<bus::Monitor> monitor_;
  bus::StationId others_, own_;  ///< of segment_: the line as the chip receives it, and the chip's driver
  bool reads_line_;
  bool rxd_ = true, txd_ = true, rts_ = false;
  std::deque<Ahead> ahead_;  ///< in order of time
  Tick passed_ = 0;          ///< the last tick that was passed on
  Tick flushed_ = 0;         ///< the log
  SocketUse socket_;
  user_cpu::HandshakeCounters holds_;
  RunResult result_;
  bool begun_ = false, finished_ = false;
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
};

}  // namespace dsdpv1::tb
