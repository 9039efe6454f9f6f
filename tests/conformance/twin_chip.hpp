#pragma once
// The chip under test, three times with the same pins: one evaluated in every cycle (step), one sleeping between its
// actions (skip), and one that dozes. The third has no observer of L_REQ and L_STA, or one that may hear of them late,
// in turns, so it also sleeps through quiet accesses. It takes whole runs of characters, except those for others, or
// else hears the line as late as it may. Every difference of pins or events fails the test, so each conformance test
// also proves that they agree. From time to time one of them continues from its saved state (Chip::save), which proves
// that the state is complete. If the environment requests it, the reference RTL is a fourth (rtl_twin.hpp).
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "model/dsdpv1/chip.hpp"
#include "model/dsdpv1/reasons.hpp"
#include "tests/conformance/rtl_twin.hpp"

namespace dsdpv1::conformance {

using bus::Tick;

struct PinChange {
  Tick at;
  Pin pin;
  Level level;
  bool operator==(const PinChange& other) const { return at == other.at && pin == other.pin && level == other.level; }
};

/// The twins of a bench continue from their saved states, one after the other: one of them after so many comparisons,
/// `usual` or DSDPV1_RESTORED_EVERY of the environment.
class Restorer {
 public:
  explicit Restorer(unsigned usual);
  void compared(std::initializer_list<dsdpv1::Chip*> twins);

 private:
  unsigned every_, comparisons_ = 0;
};

/// The engines of the chip under test. Alone, in skip, it keeps no trace either: for long campaigns.
enum class Engines : std::uint8_t { kStepAndSkip, kSkipAlone };

class TwinChip : public bus::Agent, public bus::Listener {
 public:
  explicit TwinChip(bus::Segment& segment, dsdpv1::Config config = {}, Engines engines = Engines::kStepAndSkip);
  ~TwinChip() override;
  TwinChip(const TwinChip&) = delete;
  TwinChip& operator=(const TwinChip&) = delete;

  void set(Tick at, Pin pin, Level level);
  Level level(Pin pin) const { return skip_.level(pin); }
  Level sample(Tick at);
  dsdpv1::Status status() const { return skip_.status(); }
  std::uint8_t peek(std::uint16_t address) const { return skip_.peek(address); }
  dsdpv1::Inside inside() const { return step_.inside(); }
  std::uint8_t peek_step(std::uint16_t address) const { return step_.peek(address); }

  Tick next() const override { return skip_.next_event(); }
  void run(Tick now) override;
  void line_changed(Tick at, bool level) override;

  /// Everything that left the chip so far, in order.
  const std::vector<PinChange>& trace() const { return trace_; }
  const std::vector<profibus::Event>& events() const { return events_; }
  /// Compares step with skip up to `at`; called by the bench after every operation.
  void compare(Tick at);

 private:
  static void on_skip_pin(void* self, Tick at, Pin pin, Level level);
  static void on_step_pin(void* self, Tick at, Pin pin, Level level);
  static void on_skip_event(void* self, const profibus::Event& event);
  static void on_step_event(void* self, const profibus::Event& event);
  static void on_doze_pin(void* self, Tick at, Pin pin, Level level);
  static void on_doze_event(void* self, const profibus::Event& event);
  dsdpv1::Chip& doze();
  void filter_for_doze();
  void leave_run_with_doze(Tick at);
  void compare_state() const;
  void watch_doze(bool late);
  void compare_late();

  /// Hears for doze_.
  class Ear : public bus::Listener {
   public:
    explicit Ear(TwinChip& twin) : twin_(twin) {}
    void line_changed(Tick at, bool level) override;
    bool run_begins(const bus::CharacterRun& run) override;
    void run_cut(Tick at, bool /*level*/) override { twin_.doze().leave_run(at); }
    void runs_passed(std::uint64_t for_stations) override { twin_.doze_.pass(for_stations); }

   private:
    TwinChip& twin_;
  };

  struct Unheard {
    Tick at;
    bool level;
  };
  bus::Segment& segment_;
  bus::StationId station_, doze_station_ = 0;
  const bool twin_;
  const std::uint32_t outputs_;
  Ear ear_{*this};
  dsdpv1::Chip skip_, step_, doze_;
  const std::unique_ptr<RtlTwin> rtl_;
  std::vector<Unheard> unheard_;  // changes of the line that doze_ has not been told yet
  std::vector<PinChange> trace_, step_trace_, unwatched_trace_, doze_trace_;  // unwatched: trace_ without L_REQ, L_STA
  std::vector<PinChange> late_trace_;                                         // of doze_: L_REQ, L_STA
  bool late_ = false;
  Tick late_since_ = 0, doze_told_ = 0;
  unsigned comparisons_ = 0;
  std::size_t compared_late_ = 0, late_place_ = 0;
  std::vector<profibus::Event> events_, step_events_, doze_events_;
  Restorer restorer_{100};
  std::size_t compared_pins_ = 0, compared_events_ = 0, compared_doze_pins_ = 0, compared_doze_events_ = 0;
};

}  // namespace dsdpv1::conformance
