#include "bus/wire/segment.hpp"

#include <utility>

namespace bus {

StationId Segment::attach(std::string name, Listener* listener) {
  Station station;
  station.name = std::move(name);
  station.listener = listener;
  station.heard = level_;
  stations_.push_back(std::move(station));
  return stations_.size() - 1;
}

void Segment::drive(StationId station, Tick at, bool enabled, bool level) {
  Station& driver = stations_.at(station);
  const bool was_on_wire = on_wire(driver);
  driver.enabled = enabled;
  driver.drives = level;
  if (!was_on_wire && on_wire(driver)) report_collision(at, station);
  settle(at);
}

void Segment::force(Tick at, std::optional<bool> level) {
  forced_ = level;
  settle(at);
}

void Segment::plug(StationId station, Tick at, bool plugged) {
  Station& changed = stations_.at(station);
  const bool was_on_wire = on_wire(changed);
  changed.plugged = plugged;
  if (!was_on_wire && on_wire(changed)) report_collision(at, station);
  settle(at);
}

bool Segment::level_at(StationId station) const { return !stations_.at(station).plugged || level_; }

bool Segment::driven_level() const {
  if (forced_) return *forced_;
  for (const Station& station : stations_)
    if (on_wire(station) && !station.drives) return false;
  return true;
}

void Segment::settle(Tick at) {
  level_ = driven_level();
  if (telling_) return;  // the outer call goes on telling until everybody has heard the last level
  telling_ = true;
  while (tell_changes(at)) {
  }
  telling_ = false;
}

bool Segment::tell_changes(Tick at) {
  bool told = false;
  for (StationId i = 0; i < stations_.size(); ++i) {
    const bool level = level_at(i);
    if (stations_[i].heard == level) continue;
    stations_[i].heard = level;
    if (Listener* listener = stations_[i].listener) listener->line_changed(at, level);
    told = true;
  }
  return told;
}

void Segment::report_collision(Tick at, StationId newcomer) {
  if (!on_collision) return;
  for (StationId i = 0; i < stations_.size(); ++i)
    if (i != newcomer && on_wire(stations_[i])) on_collision({at, stations_[i].name, stations_[newcomer].name});
}

}  // namespace bus
