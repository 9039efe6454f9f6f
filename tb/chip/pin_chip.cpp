#include "tb/chip/pin_chip.hpp"

#include <algorithm>
#include <utility>

#include "model/profibus/addressee.hpp"
#include "model/profibus/time.hpp"

namespace dsdpv1::tb {
namespace {

// So that profibus::addressee is a bus::RunReader.
static_assert(profibus::kNoTelegram == bus::kNoTelegram && profibus::kForNobody == bus::kForNobody &&
              profibus::kBroadcast == bus::kBroadcast);

}  // namespace

PinChip::PinChip(const std::string& name, std::unique_ptr<PinDevice> device, const PinTable& pins,
                 const BoardPins& places, PinMask watched, bus::Segment& segment, bool late)
    : device_(std::move(device)),
      pins_(pins),
      places_(places),
      data_(data_of(pins)),
      segment_(segment),
      station_(segment.attach(name, this)),
      line_(segment, station_),
      inputs_(pins.size()) {
  begin_watch(watched, late);
  device_->on_event({[](void* self, const profibus::Event& event) {
                       auto& chip = *static_cast<PinChip*>(self);
                       if (!chip.pauses_ && chip.acts_on_events()) chip.pause_access();
                       if (chip.listener_ != nullptr) chip.listener_->event(chip.number_, event);
                     },
                     this});
}

void PinChip::begin_watch(PinMask pins, bool late) {
  const PinMask inputs = inputs_of(pins_),
                needed = mask_of(places_.txd) | mask_of(places_.rts) | mask_of(places_.interrupt) | places_.told;
  reports_late_ = late;
  reports_host_ = (pins & inputs & ~mask_of(places_.rxd)) != 0;
  reports_rxd_ = (pins & mask_of(places_.rxd)) != 0;
  reports_txd_ = (pins & mask_of(places_.txd)) != 0;
  const PinSink sink = {
      [](void* self, Tick at, PinNumber pin, Level level) { static_cast<PinChip*>(self)->pin_changed(at, pin, level); },
      this};
  const PinMask outputs = (pins & ~inputs) | needed;
  late ? device_->watch_late(sink, outputs) : device_->watch(sink, outputs);
  for (std::size_t pin = 0; pin < inputs_.size(); ++pin) inputs_[pin] = device_->level(static_cast<PinNumber>(pin));
}

// A telegram in progress is reported by its changes from here on.
void PinChip::watch(Tick now, PinMask pins) {
  segment_.cut_run(now);
  device();
  begin_watch(pins, false);
  segment_.set_deafness(station_, {});
  segment_.set_filter(station_, {});
  update_hearing();
}

ChipStatus PinChip::status() const {
  segment_.hear_runs(station_);
  return device_->status();
}

Tick PinChip::next() const {
  if (line_.waits()) return line_.since();
  return device_->left_run() ? device_->now() : device_->next_seen();
}

void PinChip::run(Tick now) {
  PinDevice& chip = device();
  catch_up(now);
  chip.advance(now);
  if (wanted_.inside) chip.look_inside(now, number_, *listener_);
  if (chip.left_run()) {
    segment_.cut_run(now);
    chip.leave_run(now);
  }
  send_run();
  line_.pass_on();
  update_hearing();
}

// An answer begins: passes on its first start bit, or instead the whole answer.
void PinChip::send_run() {
  if ((reports_txd_ && !wanted_.runs) || !line_.only_level_waits() || !device_->begins_to_send()) return;
  const profibus::CharacterRun run = device_->hide_txd();
  own_run_ = true;
  hides_txd_ = segment_.send_run(
      station_, {run.start, run.bit * bus::kTicksPerCycle, run.bytes, static_cast<std::size_t>(run.size)});
  if (hides_txd_)
    line_.forget_level();
  else
    device_->show_txd(run.start);
}

void PinChip::pin_changed(Tick at, PinNumber pin, Level level) {
  const PinMask changed = mask_of(pin);
  if ((changed & data_) == 0) pause_access();  // data are only recorded and checked
  tell(at, pin, level);
  if ((changed & places_.told) != 0) host_pin_changed(at, pin, level);
  if (pin == places_.txd) line_.drive(at, level != 0);
  if (pin == places_.rts) {
    line_.enable(at, level != 0);
    own_run_ = hides_txd_ = false;
  }
}

void PinChip::tell(Tick at, PinNumber pin, Level level) {
  if (listener_ == nullptr) return;
  if (pin == places_.interrupt) listener_->interrupt(number_, at, level != 0);
  listener_->pin(number_, at, pin, level);
}

void PinChip::line_changed(Tick at, bool level) {
  if (catching_up_) return device_->hear(at, level);
  catch_up(at);
  device_->set(at, places_.rxd, level ? 1 : 0);
  announce(next());
  if (reports_rxd_) report_inputs(at, places_.rxd, places_.rxd);
  update_hearing();
}

bool PinChip::run_begins(const bus::CharacterRun& run) {
  if (reports_rxd_) {
    if (!wanted_.runs) return false;
    listener_->follows(number_, places_.rxd);
  }
  if (own_run_ && reports_txd_) listener_->follows(number_, places_.txd);
  if (own_run_) return true;  // the chip does not receive while it sends
  if (run.bit % bus::kTicksPerCycle != 0) return false;
  catch_up(run.start);
  const bool taken =
      device_->hear(run.start, {run.start, run.bit / bus::kTicksPerCycle, run.bytes, static_cast<int>(run.size)});
  plan_again();  // unchanged as long as the telegram is not for this station
  return taken;
}

void PinChip::runs_passed(std::uint64_t for_stations) { device_->pass(for_stations); }

void PinChip::run_cut(Tick at, bool level) {
  announce();
  catch_up(at);
  if (std::exchange(hides_txd_, false)) {
    device_->show_txd(at);
    line_.resume(level);
  }
  if (std::exchange(own_run_, false))
    device_->set(at, places_.rxd, level ? 1 : 0);
  else
    device_->leave_run(at);
  begin_input(places_.rxd, level ? 1 : 0);
  update_hearing();
}

// If the pin is watched, each change of it is needed in time.
void PinChip::update_hearing() {
  if (reports_rxd_) return;
  const profibus::Unheard unheard = device_->unheard();
  segment_.set_deafness(station_, {unheard.from, unheard.until});
  const profibus::Unconcerned unconcerned = device_->unconcerned();
  segment_.set_filter(
      station_, {&profibus::addressee, unconcerned.from, unconcerned.bit * bus::kTicksPerCycle, unconcerned.address});
}

void PinChip::set_reset(Tick at, bool level) { set_pin(at, places_.reset, level ? 1 : 0); }

void PinChip::set_pin(Tick at, PinNumber pin, Level level) {
  device().set(at, pin, level);
  update_hearing();
  report_host(at, pin, pin);
}

void PinChip::poke(Tick now, std::uint16_t address, std::uint8_t value) {
  sync(now);
  device_->poke(address, value);
}

std::uint8_t PinChip::load(Tick at, std::uint16_t address) {
  device().advance(at);
  const std::uint8_t value = device_->registers()->load(at, address);
  plan_again();
  return value;
}

void PinChip::store(Tick at, std::uint16_t address, std::uint8_t value) {
  device().advance(at);
  device_->registers()->store(at, address, value);
  plan_again();
}

void PinChip::report_edges(PinEdge* first, PinEdge* last) {
  const auto is_known = [this](const PinEdge& edge) {
    return std::exchange(inputs_[edge.pin], edge.level) == edge.level;
  };
  listener_->edges(number_, first, std::remove_if(first, last, is_known));
}

void PinChip::report_inputs(Tick at, PinNumber first, PinNumber last) {
  for (PinNumber pin = first; pin <= last; ++pin) {
    const Level level = device_->level(pin);
    if (std::exchange(inputs_[pin], level) != level) tell(at, pin, level);
  }
}

}  // namespace dsdpv1::tb
