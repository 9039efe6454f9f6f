// Compares the model with a DUT on the same inputs: finds the first difference of their outputs.
#include "capi/names.hpp"
#include "dsdpv1/chip.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "capi/chip.hpp"
#include "capi/sized.hpp"
#include "cosim/rtl.hpp"

using capi::Tick;
using tb::Level;
using tb::PinNumber;

namespace {

cosim::RtlTiming timing_of(const capi::Kind& kind, const capi::ChipPlan& plan) {
  return kind.chip.rtl() == nullptr ? cosim::RtlTiming{} : kind.chip.rtl()->timing(*plan.settings);
}

}  // namespace

/// Changes of both sides come in order of time. A tick ends, and its final levels are compared, when a later change
/// arrives.
struct dpsim_scoreboard {
 public:
  dpsim_scoreboard(const capi::Kind& kind, capi::ChipPlan plan, const dpsim_scoreboard_options& options)
      : timing_(timing_of(kind, plan)),
        chip_(kind, std::move(plan)),
        tolerance_(options.tolerance),
        warm_up_(options.warm_up),
        begin_(warm_up_),
        pad_(timing_.delay) {
    for (const Level level : kind.reset_levels) pins_.push_back({level, level});
    result_.tick = result_.input_tick = DPSIM_NEVER;
    chip_.device().watch({changed, this}, tb::outputs_of(kind.chip.pins()));
    chip_.events.tell(happened, this);
  }

  void pin(const dpsim_change& change) {
    const tb::PinTable& table = chip_.kind.chip.pins();
    const bool output = change.pin < table.size() && !table[change.pin].input;
    if (output)
      capi::need_range(table[change.pin].name, change.level, DPSIM_X, (1 << table[change.pin].width) - 1);
    else
      chip_.check(change.pin, change.level);
    advance(change.tick);
    if (output)
      (change.pin == timing_.delayed ? register_ : pins_[change.pin].dut) = change.level;
    else
      set_input(static_cast<PinNumber>(change.pin), change.level);
  }

  void advance(std::uint64_t tick) {
    const Tick to = capi::tick_from(tick, now_);
    if (to == now_) return;
    if (register_ != settled_ && pad_.change(now_, settled_, register_)) pins_[timing_.delayed].dut = register_;
    settled_ = register_;
    chip_.advance(to);
    reach(to);
  }

  const dpsim_scoreboard_result& result() {
    result_.next = capi::tick_out(next());
    return result_;
  }

 private:
  /// Levels of both sides. For an input they never differ.
  struct Levels {
    Level model = 0, dut = 0;
    bool moved = false;        ///< the model's level has changed since they were equal
    Tick since = bus::kNever;  ///< start of the difference
    bool differ() const { return model != dut && model != tb::kLevelX; }
  };

  static void changed(void* self, Tick at, PinNumber pin, Level level) {
    auto* own = static_cast<dpsim_scoreboard*>(self);
    own->reach(at);
    own->pins_[pin].model = level;
    own->pins_[pin].moved = at >= own->begin_;
  }

  static void happened(void* self, const dpsim_chip_event* event) {
    auto* own = static_cast<dpsim_scoreboard*>(self);
    own->reach(static_cast<Tick>(event->tick));
    if (own->found()) return;
    auto* events = own->result_.events;
    std::copy_backward(events, events + DPSIM_LAST_EVENTS - 1, events + DPSIM_LAST_EVENTS);
    events[0] = *event;
    if (own->result_.event_count < DPSIM_LAST_EVENTS) ++own->result_.event_count;
  }

  void set_input(PinNumber pin, Level level) {
    if (chip_.level(pin) == level) return;
    if (!found()) {
      result_.input = pin;
      result_.input_level = level;
      result_.input_tick = static_cast<std::uint64_t>(now_);
    }
    const bool is_reset = pin == chip_.kind.chip.board_pins().reset;
    if (is_reset && begin_ > now_) begin_ = level == 0 ? now_ + warm_up_ : bus::kNever;
    chip_.set(now_, pin, level);
  }

  bool found() const { return result_.tick != DPSIM_NEVER; }

  void reach(Tick to) {
    while (pad_.next() <= to) {
      end_tick(pad_.next());
      pins_[timing_.delayed].dut = pad_.take();
    }
    end_tick(to);
  }

  /// All levels are stable up to `next`.
  void end_tick(Tick next) {
    if (next > begin_ && next > now_ && !found()) {
      now_ = std::max(now_, begin_);
      for (std::size_t pin = 0; pin < pins_.size(); ++pin) compare(pin, next);
    }
    now_ = std::max(now_, next);
  }

  /// If several have differed for too long, the earliest counts.
  void compare(std::size_t pin, Tick next) {
    Levels& levels = pins_[pin];
    if (!levels.differ()) {
      result_.matched += std::exchange(levels.moved, false) ? 1 : 0;
      levels.since = bus::kNever;
      return;
    }
    levels.since = std::min(levels.since, now_);
    const auto since = static_cast<std::uint64_t>(levels.since);
    if (levels.since + tolerance_ >= next || since >= result_.tick) return;
    result_.tick = since;
    result_.pin = static_cast<std::uint16_t>(pin);
    result_.model = levels.model;
    result_.dut = levels.dut;
  }

  Tick next() const {
    Tick at = std::min(chip_.device().next_event(), pad_.next());
    if (register_ != settled_) at = std::min(at, now_ + 1);
    if (found() || begin_ == bus::kNever) return at;
    for (const Levels& each : pins_)
      if (each.differ()) at = std::min(at, std::min(each.since, std::max(now_, begin_)) + tolerance_ + 1);
    return at;
  }

  const cosim::RtlTiming timing_;
  dpsim_chip chip_;
  const Tick tolerance_, warm_up_;
  Tick now_ = 0;  ///< the present tick
  Tick begin_;    ///< of the comparison; kNever: RESET is high
  std::vector<Levels> pins_;
  Level register_ = tb::kLevelZ, settled_ = tb::kLevelZ;  ///< RtlTiming::delayed of the DUT: now, and before this tick
  cosim::DelayedOutput pad_;                              ///< its pin; allocates, so not in the model's callbacks
  dpsim_scoreboard_result result_{};
};

dpsim_status dpsim_scoreboard_create(const dpsim_chip_options* model, const dpsim_scoreboard_options* options,
                                     dpsim_scoreboard** scoreboard) {
  return capi::guarded(
      __func__,
      [&] {
        capi::need(scoreboard, "scoreboard");
        constexpr auto kMost = static_cast<std::int64_t>(DPSIM_LAST_TICK / 2);
        const dpsim_chip_options chip = capi::options_of(model, "model");
        const dpsim_scoreboard_options given = capi::options_of(options, "options");
        capi::need_range("tolerance", given.tolerance, 0, kMost);
        capi::need_range("warm_up", given.warm_up, 0, kMost);
        const capi::Kind& kind = capi::kind_of(chip.kind);
        *scoreboard = std::make_unique<dpsim_scoreboard>(kind, capi::plan_of(chip, kind, "model"), given).release();
      });
}

void dpsim_scoreboard_destroy(dpsim_scoreboard* scoreboard) { delete scoreboard; }

dpsim_status dpsim_scoreboard_compare(dpsim_scoreboard* scoreboard, const dpsim_change* changes, size_t count,
                                      uint64_t until, dpsim_scoreboard_result* result) {
  return capi::guarded(
      __func__,
      [&] {
        capi::need(scoreboard, "scoreboard");
        capi::need_buffer(changes, count, "changes");
        if (result != nullptr) capi::check_size(*result, "result");
        for (std::size_t i = 0; i < count; ++i) scoreboard->pin(changes[i]);
        scoreboard->advance(until);
        if (result != nullptr) capi::give(scoreboard->result(), result, "result");
      });
}
