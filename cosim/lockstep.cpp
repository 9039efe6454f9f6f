#include "cosim/lockstep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/input/units.hpp"
#include "tb/bench/ruling_place.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr int kNoRate = -1;
constexpr Tick kCycle = bus::kTicksPerCycle;
constexpr std::size_t kEvents = 3;
constexpr const char* kNextLine = "\n                  ";

/// Appends the names of "H1, T2-004" that it does not have yet.
void add_names(std::vector<std::string>& names, const std::string& list) {
  for (std::string& name : tb::names_of(list))
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
}

std::string text(const tb::PinInfo& pin, const std::optional<Level>& level) {
  return level ? level_text(pin.width, *level) : "no such change within the tolerance";
}

}  // namespace

std::string describe(const Difference& difference) {
  return fmt::format(
      "first difference  {}\n"
      "                  {}\n"
      "last telegram     {}\n"
      "last access       {}\n"
      "DPRAM             {}\n"
      "last events       {}\n"
      "see rulings       {}\n",
      tb::cycle_text(difference.at), difference.what, difference.last_telegram, difference.last_access,
      difference.dpram, difference.events.empty() ? "none" : fmt::format("{}", fmt::join(difference.events, kNextLine)),
      fmt::join(difference.rulings, ", "));
}

std::string level_text(int width, Level level) {
  if (level == tb::kLevelZ) return "Z";
  if (level == tb::kLevelX) return "X";
  return width == 1 ? fmt::format("{}", level) : fmt::format("{:02X}", level);
}

Lockstep::Lockstep(std::unique_ptr<tb::PinDevice> model, std::unique_ptr<Rtl> rtl, const tb::ChipKind& kind,
                   const tb::OwnSettings& chip, const LockstepOptions& options)
    : kind_(kind),
      model_(std::move(model)),
      rtl_(std::move(rtl), kind, chip, *model_, TickEnds::kLater),
      options_(options),
      comparator_(options.tolerances),
      history_(options.history_cycles, kind),
      watch_(kind.rtl()->watch_memory()),
      image_(static_cast<std::size_t>(kind.cells())) {
  for (PinNumber pin = 0; pin < end_of(kind.pins()); ++pin) {
    const Level level = model_->level(pin);
    history_.begin(Side::kInput, pin, level);
    history_.begin(Side::kModel, pin, level);
    history_.begin(Side::kRtl, pin, rtl_.level(pin));
    if (!kind.pins()[pin].input) comparator_.begin(pin, level, rtl_.level(pin));
  }
  model_->watch({[](void* self, Tick at, PinNumber pin, Level level) {
                   static_cast<Lockstep*>(self)->model_changed(at, pin, level);
                 },
                 this},
                tb::outputs_of(kind.pins()));
  rtl_.watch({[](void* self, Tick at, PinNumber pin, Level level) {
                static_cast<Lockstep*>(self)->rtl_changed(at, pin, level);
              },
              this},
             tb::outputs_of(kind.pins()));
  model_->on_event(
      {[](void* self, const profibus::Event& event) { static_cast<Lockstep*>(self)->happened(event); }, this});
}

void Lockstep::happened(const profibus::Event& event) {
  events_.push_back(event);
  if (events_.size() > kEvents) events_.pop_front();
  if (event_sink_.call != nullptr) event_sink_.call(event_sink_.self, event);
}

void Lockstep::watch(const tb::PinSink& sink, tb::PinMask pins) {
  sink_ = sink;
  watched_ = pins;
}

void Lockstep::set(Tick at, PinNumber pin, Level level) {
  advance(at);
  if (model_->level(pin) == level) return;
  note(at, Side::kInput, pin, level);
  if (options_.keeps_inputs && !difference_) keep_input(at, pin, level);
  watch_change(at, pin, level);
  model_->set(at, pin, level);
  rtl_.set(at, pin, level);
}

void Lockstep::note(Tick at, Side side, PinNumber pin, Level level) {
  history_.add(at, side, pin, level);
  if (on_pin_) on_pin_(at, side, pin, level);
}

void Lockstep::keep_input(Tick at, PinNumber pin, Level level) {
  constexpr std::size_t kMost = 1'000'000;  // as in a stimulus file
  const tb::BoardPins& places = kind_.board_pins();
  if (pin == places.rxd) {
    if (model_->level(places.rts) != 0 || (level != 0 && !others_low_)) return;
    others_low_ = level == 0;
  }
  inputs_.push_back({at, pin, level});
  if (inputs_.size() < kMost) return;
  inputs_.clear();
  options_.keeps_inputs = false;
}

void Lockstep::watch_change(Tick at, PinNumber pin, Level level) {
  watch_->change(at, pin, level);
  if (const std::optional<Tick> end = watch_->take_end()) ended_ = end;
}

/// The model stops at the end of each of its accesses, because the RTL's memory can only be read at its present time.
void Lockstep::advance(Tick to) {
  if (ends_later()) look_at_memory(to);
  for (Tick next = model_->next_event(); next <= to && !difference_; next = model_->next_event()) {
    model_->advance(next);
    if (!ended_) continue;
    if (ends_later())
      look_at_memory(to);
    else
      access_ended(*std::exchange(ended_, std::nullopt));
  }
  model_->advance(to);
  rtl_.advance(to);
  settle(to);
}

/// For RTL that evaluates a tick after its end.
void Lockstep::look_at_memory(Tick to) {
  if (ended_ && *ended_ < to && !difference_) access_ended(*std::exchange(ended_, std::nullopt));
}

void Lockstep::model_changed(Tick at, PinNumber pin, Level level) {
  note(at, Side::kModel, pin, level);
  if (!difference_) comparator_.model_changed(at, pin, level);
  watch_change(at, pin, level);
  if (sink_.call != nullptr && (watched_ & tb::mask_of(pin)) != 0) sink_.call(sink_.self, at, pin, level);
}

void Lockstep::rtl_changed(Tick at, PinNumber pin, Level level) {
  note(at, Side::kRtl, pin, level);
  if (!difference_) comparator_.rtl_changed(at, pin, level);
}

void Lockstep::access_ended(Tick at) {
  if (!watch_->worth_a_look(at) || !options_.compare_dpram) return;
  rtl_.advance(ends_later() ? at + 1 : at);
  settle(at);
  if (!difference_) compare_memory(at);
}

void Lockstep::compare_memory(Tick at) {
  if (!rtl_.rtl().memory(image_.data())) return;
  watch_->compared(at);
  ++counts_.dpram_images;
  for (std::size_t i = 0; i < image_.size(); ++i) {
    const auto address = static_cast<std::uint16_t>(i);
    const std::uint8_t model = model_->peek(address);
    if (model == image_[i]) continue;
    return found(at, fmt::format("DPRAM B{:03X}: model {:02X}, RTL {:02X}", address, model, image_[i]));
  }
}

void Lockstep::settle(Tick horizon) {
  if (difference_) return;
  const std::optional<PinDifference> pin = comparator_.settle(horizon);
  compared_to_ = horizon;
  if (!pin) return;
  compared_to_ = pin->at;
  const tb::PinInfo& info = kind_.pins()[pin->pin];
  found(pin->at, fmt::format("pin {}: model {}, RTL {}", info.name, text(info, pin->model), text(info, pin->rtl)),
        info.rulings);
}

void Lockstep::found(Tick at, std::string what, const std::string& rulings) {
  const LineTelegram telegram = history_.last_telegram(model_->status().baud.value_or(kNoRate));
  Difference difference{
      at,
      std::move(what),
      telegram.text.empty() ? "none" : fmt::format("{}, began at {}", telegram.text, tb::cycle_text(telegram.start)),
      watch_->last_of_user(),
      watch_->last_of_chip(),
      {},
      {}};
  add_names(difference.rulings, rulings);
  for (const profibus::Event& event : events_) {
    difference.events.push_back(
        fmt::format("{} at {}: {}", profibus::code(event.reason), tb::cycle_text(event.at), kind_.describe(event)));
    add_names(difference.rulings, event.reason.row().source);
  }
  difference_ = std::move(difference);
}

const MatchCounts& Lockstep::counts() const {
  counts_.cycles = static_cast<std::uint64_t>(compared_to_ / kCycle);
  counts_.pin_changes = comparator_.matched();
  return counts_;
}

void Lockstep::write_wave(const std::string& path) {
  constexpr Tick kAfterwards = 200 * kCycle;
  const Tick end = std::max(model_->now(), rtl_.now()) + kAfterwards;
  sink_ = {};
  on_pin_ = {};
  model_->on_event({});
  model_->advance(end);
  rtl_.advance(end);
  history_.write_wave(path, end);
}

}  // namespace dsdpv1::cosim
