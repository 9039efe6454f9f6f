#pragma once
// Model and RTL with the same inputs: compares every change of every output pin, and the memory shared by chip and user
// at the end of each access that can have changed it. The driver of the chip sees the model's outputs.
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cosim/history.hpp"
#include "cosim/pin_comparator.hpp"
#include "cosim/rtl_chip.hpp"
#include "tb/bench/record.hpp"

namespace dsdpv1::cosim {

struct LockstepOptions {
  Tolerances tolerances{};
  bool compare_dpram = true;  ///< if the RTL's memory can be read
  int history_cycles = 5000;  ///< shown in the wave of a difference
  bool keeps_inputs = false;  ///< for Lockstep::inputs
};

/// A change of an input.
struct InputChange {
  Tick at;
  PinNumber pin;
  Level level;
};

using Difference = tb::LockstepDifference;

/// A level as text: "1", "3F", "Z", "X".
std::string level_text(int width, Level level);

/// Everything as text: cycle, time, difference, last telegram and access, events, rulings.
std::string describe(const Difference& difference);

struct MatchCounts {
  std::uint64_t cycles = 0;        ///< compared up to here
  std::uint64_t pin_changes = 0;   ///< made by both sides
  std::uint64_t dpram_images = 0;  ///< compared as a whole

  void add(const MatchCounts& other) {
    cycles += other.cycles;
    pin_changes += other.pin_changes;
    dpram_images += other.dpram_images;
  }
};

class Lockstep : public tb::PinDevice {
 public:
  /// `model`, fresh from ChipKind::make_device, and `rtl` with these parameters. The kind must have an RtlOf.
  Lockstep(std::unique_ptr<tb::PinDevice> model, std::unique_ptr<Rtl> rtl, const tb::ChipKind& kind,
           const tb::OwnSettings& chip, const LockstepOptions& options = {});

  // Outputs, events and internal state are the model's.
  void set(Tick at, PinNumber pin, Level level) override;
  void advance(Tick to) override;
  Tick now() const override { return model_->now(); }
  Tick next_event() const override { return model_->next_event(); }
  Level level(PinNumber pin) const override { return model_->level(pin); }
  Level sample(Tick at) override {
    advance(at);
    return model_->sample(at);
  }
  void watch(const tb::PinSink& sink, tb::PinMask pins) override;
  void on_event(const profibus::EventSink& sink) override { event_sink_ = sink; }
  tb::ChipStatus status() const override { return model_->status(); }
  std::uint8_t address() const override { return model_->address(); }
  std::uint8_t peek(std::uint16_t address) const override { return model_->peek(address); }
  void poke(std::uint16_t address, std::uint8_t value) override { model_->poke(address, value); }
  void look_inside(Tick now, std::size_t number, tb::ChipListener& listener) override {
    model_->look_inside(now, number, listener);
  }
  const char* works_on() const override { return model_->works_on(); }

  /// Called for each change at the pins of all sides: each side in order of time, one side after the other.
  using PinListener = std::function<void(Tick at, Side side, PinNumber pin, Level level)>;
  void on_pin(PinListener listener) { on_pin_ = std::move(listener); }

  /// The first difference; nothing is compared after it.
  const std::optional<Difference>& difference() const { return difference_; }
  const MatchCounts& counts() const;
  /// All of them from power-on, without the line while the chip drives it. Empty if they are not wanted, or too
  /// many.
  const std::vector<InputChange>& inputs() const { return inputs_; }
  /// Writes the last cycles of both sides; runs them some cycles further, so that the wave also shows what follows a
  /// difference. Listeners are not called for that.
  void write_wave(const std::string& path);

 private:
  void model_changed(Tick at, PinNumber pin, Level level);
  void rtl_changed(Tick at, PinNumber pin, Level level);
  void note(Tick at, Side side, PinNumber pin, Level level);
  void keep_input(Tick at, PinNumber pin, Level level);
  void watch_change(Tick at, PinNumber pin, Level level);
  bool ends_later() const { return rtl_.ends() == TickEnds::kLater; }
  void look_at_memory(Tick to);
  void access_ended(Tick at);
  void compare_memory(Tick at);
  void settle(Tick horizon);
  void happened(const profibus::Event& event);
  /// `rulings`: those of the pin.
  void found(Tick at, std::string what, const std::string& rulings = {});

  const tb::ChipKind& kind_;
  std::unique_ptr<tb::PinDevice> model_;
  RtlChip rtl_;
  LockstepOptions options_;
  PinComparator comparator_;
  History history_;
  std::unique_ptr<MemoryWatch> watch_;
  std::vector<std::uint8_t> image_;  ///< the RTL's memory
  std::vector<InputChange> inputs_;
  bool others_low_ = false;  ///< the line, by another station than the chip
  tb::PinSink sink_;
  profibus::EventSink event_sink_;
  std::deque<profibus::Event> events_;  ///< the last ones
  PinListener on_pin_;
  tb::PinMask watched_ = 0;
  std::optional<Tick> ended_;  ///< an access of the model has ended, the memory has not been compared yet
  std::optional<Difference> difference_;
  mutable MatchCounts counts_;
  Tick compared_to_ = 0;
};

}  // namespace dsdpv1::cosim
