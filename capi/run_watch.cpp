#include "capi/run_watch.hpp"

#include "capi/bus.hpp"

namespace dsdpv1::capi {

RunWatch::RunWatch(const tb::scenario::Scenario& scenario) : scenario_(scenario) {
  for (std::size_t slave = 0; slave < scenario.slaves.size(); ++slave)
    events_.emplace_back(kind_of(scenario.slaves[slave].kind->name()), static_cast<std::uint16_t>(slave), clock_);
}

void RunWatch::on_change(dpsim_change_fn fn, void* user) {
  change_fn_ = fn;
  change_user_ = user;
}

void RunWatch::on_telegram(dpsim_telegram_fn fn, void* user) {
  telegram_fn_ = fn;
  telegram_user_ = user;
}

void RunWatch::on_event(dpsim_chip_event_fn fn, void* user) {
  for (ChipEvents& each : events_) each.tell(fn, user);
}

void RunWatch::listen(bus::Segment& segment) {
  segment_ = &segment;
  segment.attach("changes", this);
}

std::uint16_t RunWatch::slave_of(const std::string& name) const {
  return static_cast<std::uint16_t>(slave_number(scenario_, name));
}

void RunWatch::begins(std::size_t slave, const tb::ChipView& chip) {
  if (segment_ == nullptr) return;
  if (slave == 0) tell(0, DPSIM_LINE, 0, segment_->level() ? 1 : 0);
  for (std::size_t i = 0; i < scenario_.slaves[slave].kind->pins().size(); ++i) {
    const auto number = static_cast<tb::PinNumber>(i);
    pin(slave, 0, number, chip.level(number));
  }
}

void RunWatch::pin(std::size_t slave, Tick at, tb::PinNumber pin, tb::Level level) {
  if (segment_ != nullptr) tell(at, static_cast<std::uint16_t>(slave), pin, level);
}

void RunWatch::tell(Tick at, std::uint16_t station, tb::PinNumber pin, tb::Level level) {
  const dpsim_change change = {static_cast<std::uint64_t>(at), station, pin, level, 0};
  if ((kept_ & DPSIM_KEEP_CHANGES) != 0) changes_.add(change);
  if (change_fn_ != nullptr) change_fn_(change_user_, &change);
}

void RunWatch::telegram(const tb::HeardTelegram& heard) {
  dpsim_heard told = heard_of(heard.telegram);
  if (telegram_fn_ != nullptr) telegram_fn_(telegram_user_, &told);
  if ((kept_ & DPSIM_KEEP_TELEGRAMS) == 0) return;
  bytes_.push_back(heard.telegram.decoded.bytes);
  told.bytes = bytes_.back().data();
  telegrams_.push_back(told);
}

}  // namespace dsdpv1::capi
