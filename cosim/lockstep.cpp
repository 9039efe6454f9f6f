#include "cosim/lockstep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/input/units.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr int kNoRate = -1;
constexpr Tick kCycle = profibus::kTicksPerCycle;
constexpr Tick kShortAccess = 7 * kCycle;  // 9.1: nothing was due, B006 := 01 is all
constexpr Tick kSettles = 4 * kCycle;      // P8: longer than a user's write is on its way
constexpr unsigned kImageEvery = 256;      // ... the DPRAM is compared all the same from time to time
constexpr Tick kStartsUp = 3500 * kCycle;  // H6: the start-up access has written every cell
constexpr Tick kImageGap = 1000 * kCycle;  // with a serial port no pin shows an access: as often as this

std::string text(Pin pin, const std::optional<Level>& level) {
  return level ? level_text(pin, *level) : "no such change within the tolerance";
}

}  // namespace

std::string describe(const Difference& difference) {
  return fmt::format(
      "first difference  {}\n"
      "                  {}\n"
      "last telegram     {}\n"
      "last access       {}\n"
      "DPRAM             {}\n",
      tb::cycle_text(difference.at), difference.what, difference.last_telegram, difference.last_access,
      difference.dpram_accesses);
}

Lockstep::Lockstep(std::unique_ptr<tb::PinDevice> model, const dsdpv1::Config& config, std::unique_ptr<RtlTop> top,
                   const LockstepOptions& options)
    : model_(std::move(model)),
      part_(config.part),
      rtl_(std::move(top), config, dsdpv1::has_serial_ports(config.part) ? TickEnds::kLater : TickEnds::kAtOnce),
      options_(options),
      comparator_(options.tolerances),
      history_(options.history_cycles, dsdpv1::pin_count(config.part)) {
  for (int i = 0; i < dsdpv1::pin_count(part_); ++i) {
    const Pin pin = static_cast<Pin>(i);
    const Level level = model_->level(number(pin));
    history_.begin(Side::kInput, pin, level);
    history_.begin(Side::kModel, pin, level);
    history_.begin(Side::kRtl, pin, rtl_.level(pin));
    if (!dsdpv1::is_input(pin)) comparator_.begin(pin, level, rtl_.level(pin));
  }
  model_->watch({[](void* self, Tick at, tb::PinNumber pin, Level level) {
                   static_cast<Lockstep*>(self)->model_changed(at, static_cast<Pin>(pin), level);
                 },
                 this},
                dsdpv1::outputs_of(part_));
  rtl_.watch(
      {[](void* self, Tick at, Pin pin, Level level) { static_cast<Lockstep*>(self)->rtl_changed(at, pin, level); },
       this},
      dsdpv1::outputs_of(part_));
}

void Lockstep::watch(const tb::PinSink& sink, tb::PinMask pins) {
  sink_ = sink;
  watched_ = pins;
}

void Lockstep::set(Tick at, tb::PinNumber changed, Level level) {
  advance(at);
  if (model_->level(changed) == level) return;
  const Pin pin = static_cast<Pin>(changed);
  note(at, Side::kInput, pin, level);
  note_input(at, pin, level);
  model_->set(at, changed, level);
  rtl_.set(at, pin, level);
}

void Lockstep::note(Tick at, Side side, Pin pin, Level level) {
  history_.add(at, side, pin, level);
  if (on_pin_) on_pin_(at, side, pin, level);
}

void Lockstep::note_input(Tick at, Pin pin, Level level) {
  watch_.change(at, pin, level);
  if (dsdpv1::has_serial_ports(part_)) note_serial(at, pin);
  if (pin != Pin::kWr || level == 0) return;
  user_wrote_ = true;
  last_write_ = at;
}

/// With a serial port the DPRAM is the same in every cycle, so it may be compared at any.
void Lockstep::note_serial(Tick at, Pin pin) {
  if (pin == Pin::kReset) {
    image_at_ = at + kStartsUp;
    const auto mode = static_cast<HostMode>(model_->level(number(Pin::kMode)));  // R11: at the end of the reset
    serial_ = mode == HostMode::kSpi || mode == HostMode::kUart;
  }
  const bool moves = pin == Pin::kXss || pin == Pin::kRxd || pin == Pin::kTxd || pin == Pin::kPbrts;
  if (!moves || model_->level(number(Pin::kReset)) == 0 || !serial_ || at < image_at_ + kImageGap) return;
  ended_ = image_at_ = at;
}

/// The model is stopped wherever one of its accesses ends, because the RTL's DPRAM can be seen at its present time
/// only.
void Lockstep::advance(Tick to) {
  if (dsdpv1::has_serial_ports(part_)) look_at_dpram(to);
  for (Tick next = model_->next_event(); next <= to && !difference_; next = model_->next_event()) {
    model_->advance(next);
    if (!ended_) continue;
    if (dsdpv1::has_serial_ports(part_))
      look_at_dpram(to);
    else
      access_ended(*std::exchange(ended_, std::nullopt));
  }
  model_->advance(to);
  rtl_.advance(to);
  settle(to);
}

/// Of the DSDPV1-RSU, whose ticks are evaluated when they are over.
void Lockstep::look_at_dpram(Tick to) {
  if (ended_ && *ended_ < to && !difference_) access_ended(*std::exchange(ended_, std::nullopt));
}

void Lockstep::model_changed(Tick at, Pin pin, Level level) {
  note(at, Side::kModel, pin, level);
  if (!difference_) comparator_.model_changed(at, pin, level);
  watch_.change(at, pin, level);
  if (pin == Pin::kLReq && level == 0 && model_->level(number(Pin::kReset)) != 0) ended_ = at;
  if (dsdpv1::has_serial_ports(part_)) note_serial(at, pin);
  if (sink_.call != nullptr && (watched_ & dsdpv1::mask(pin)) != 0) sink_.call(sink_.self, at, number(pin), level);
}

void Lockstep::rtl_changed(Tick at, Pin pin, Level level) {
  note(at, Side::kRtl, pin, level);
  if (!difference_) comparator_.rtl_changed(at, pin, level);
}

void Lockstep::access_ended(Tick at) {
  if (!dpram_may_have_changed(at)) return;
  rtl_.advance(dsdpv1::has_serial_ports(part_) ? at + 1 : at);
  settle(at);
  if (!difference_) compare_dpram(at);
}

bool Lockstep::dpram_may_have_changed(Tick at) {
  const bool chip_wrote = at - watch_.chip_access_start() > kShortAccess;
  return (chip_wrote || user_wrote_ || ++accesses_ % kImageEvery == 0) && options_.compare_dpram;
}

void Lockstep::compare_dpram(Tick at) {
  DpramImage image;
  if (!rtl_.top().dpram(image)) return;
  user_wrote_ = last_write_ > at - kSettles;
  ++counts_.dpram_images;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const auto address = static_cast<std::uint16_t>(i);
    const std::uint8_t model = model_->peek(address);
    if (model == image[i]) continue;
    return found(at, fmt::format("DPRAM B{:03X}: model {:02X}, RTL {:02X}", address, model, image[i]));
  }
}

void Lockstep::settle(Tick horizon) {
  if (difference_) return;
  const std::optional<PinDifference> pin = comparator_.settle(horizon);
  compared_to_ = horizon;
  if (!pin) return;
  compared_to_ = pin->at;
  found(pin->at, fmt::format("pin {}: model {}, RTL {}", dsdpv1::name(pin->pin), text(pin->pin, pin->model),
                             text(pin->pin, pin->rtl)));
}

void Lockstep::found(Tick at, std::string what) {
  const LineTelegram telegram = history_.last_telegram(model_->status().baud.value_or(kNoRate));
  difference_ = Difference{
      at, std::move(what),
      telegram.text.empty() ? "none" : fmt::format("{}, began at {}", telegram.text, tb::cycle_text(telegram.start)),
      watch_.user_text(), watch_.chip_text()};
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
