#include "capi/line_tap.hpp"

#include <utility>

#include "dsdpv1/bus.h"

namespace dsdpv1::capi {

LineTap::LineTap(bus::Segment& segment, Changes& changes, std::function<void()> on_activity)
    : segment_(segment), changes_(changes), on_activity_(std::move(on_activity)) {
  segment.attach("line", this);
}

// A telegram in progress is reported by its changes from here on.
void LineTap::watch(bus::Tick now, std::uint32_t what) {
  segment_.cut_run(now);
  watched_ = what;
}

bool LineTap::level(bus::Tick now) const {
  return run_ && now >= run_->start && now < run_->end() ? run_->level(now) : segment_.level();
}

void LineTap::tell(bus::Tick at, std::uint16_t station, std::uint16_t pin, bool level) {
  changes_.add({static_cast<std::uint64_t>(at), station, pin, static_cast<dpsim_level>(level ? 1 : 0), 0});
}

LineTap::Driver& LineTap::driver_of(std::uint16_t station) {
  if (station >= drivers_.size()) drivers_.resize(station + std::size_t{1});
  return drivers_[station];
}

void LineTap::driven(std::uint16_t station, bus::Tick at, bool enabled, bool level) {
  Driver& driver = driver_of(station);
  const Driver before = std::exchange(driver, {enabled, level});
  if ((watched_ & DPSIM_WATCH_DRIVERS) == 0) return;
  if (before.enabled != enabled) tell(at, station, DPSIM_STATION_RTS, enabled);
  if (before.level != level) tell(at, station, DPSIM_STATION_TXD, level);
}

void LineTap::line_changed(bus::Tick at, bool level) {
  on_activity_();
  run_.reset();
  if ((watched_ & DPSIM_WATCH_LINE) != 0) tell(at, DPSIM_LINE, 0, level);
}

bool LineTap::run_begins(const bus::CharacterRun& run) {
  on_activity_();
  if (watched_ != 0) return false;
  bytes_.assign(run.bytes, run.bytes + run.size);
  run_ = run;
  run_->bytes = bytes_.data();
  return true;
}

void LineTap::run_cut(bus::Tick /*at*/, bool /*level*/) { run_.reset(); }

}  // namespace dsdpv1::capi
