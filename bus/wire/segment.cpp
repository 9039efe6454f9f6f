#include "bus/wire/segment.hpp"

#include <algorithm>
#include <utility>

namespace bus {

StationId Segment::attach(std::string name, Listener* listener) {
  Station station;
  station.name = std::move(name);
  station.listener = listener;
  station.heard = level_;
  station.next_change = changes_.size();
  stations_.push_back(std::move(station));
  return stations_.size() - 1;
}

void Segment::drive(StationId station, Tick at, bool enabled, bool level) {
  Station& driver = stations_.at(station);
  if (run_ && !(run_->driven && run_->sender == station && enabled)) cut_run(at);
  const bool was_on_wire = on_wire(driver);
  driver.enabled = enabled;
  driver.drives = level;
  if (!was_on_wire && on_wire(driver)) report_collision(at, station);
  settle(at);
}

void Segment::force(Tick at, std::optional<bool> level) {
  cut_run(at);
  forced_ = level;
  settle(at);
}

void Segment::plug(StationId station, Tick at, bool plugged) {
  Station& changed = stations_.at(station);
  cut_run(at);
  hear(station);
  const bool was_on_wire = on_wire(changed);
  changed.plugged = plugged;
  changed.next_change = changes_.size();
  changed.deafness = {};
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
  do note_change(at);
  while (tell_changes(at));
  telling_ = false;
}

void Segment::note_change(Tick at) {
  if (level_ == noted_) return;
  noted_ = level_;
  if (changes_.size() == kMostMissed) forget_changes();
  changes_.push_back({at, level_});
}

void Segment::forget_changes() {
  for (StationId i = 0; i < stations_.size(); ++i) hear(i);
  for (Station& station : stations_) station.next_change = 0;
  changes_.clear();
}

bool Segment::tell_changes(Tick at) {
  bool told = false;
  for (Station& station : stations_) {
    if (station.in_run) continue;
    if (station.plugged && station.deafness.at(at)) continue;
    if (station.plugged) tell_missed(station, at);
    station.next_change = changes_.size();
    told |= tell(station, at, !station.plugged || level_);
  }
  return told;
}

void Segment::tell_missed(StationId station) {
  if (stations_[station].plugged && !stations_[station].in_run) tell_missed(stations_[station], kNever);
}

void Segment::tell_missed(Station& station, Tick before) {
  while (station.next_change < changes_.size() && changes_[station.next_change].at < before) {
    const Change change = changes_[station.next_change++];
    tell(station, change.at, change.level);
  }
}

bool Segment::tell(Station& station, Tick at, bool level) {
  if (station.heard == level) return false;
  station.heard = level;
  if (station.listener != nullptr) station.listener->line_changed(at, level);
  return true;
}

// --- runs ------------------------------------------------------------------------------------------------------------

// An idle line that nobody else touches, and somebody who hears of the cut.
bool Segment::may_send_run(const Station& sender) const {
  const auto disturbs = [&sender](const Station& other) { return &other != &sender && on_wire(other); };
  return on_wire(sender) && sender.listener != nullptr && level_ && !forced_ && !telling_ && !run_ &&
         std::none_of(stations_.begin(), stations_.end(), disturbs);
}

bool Segment::send_run(StationId station, const CharacterRun& run) {
  if (run_ && run.start >= run_->characters.end()) end_run();
  if (!may_send_run(stations_.at(station))) return false;
  run_ = Run{run, station, false};
  for (StationId i = 0; i < stations_.size(); ++i) {
    Station& other = stations_[i];
    if (!other.plugged) continue;
    hear(i);
    other.in_run = other.listener == nullptr || other.listener->run_begins(run);
    run_->driven |= !other.in_run;
  }
  return !run_->driven;
}

void Segment::end_run() {
  for (Station& station : stations_)
    if (std::exchange(station.in_run, false)) station.next_change = changes_.size();
  run_.reset();
}

void Segment::cut_run(Tick at) {
  if (!run_) return;
  const Run run = *run_;
  const bool over = at >= run.characters.end(), level = over || run.characters.level(at);
  std::vector<Listener*> cut;
  for (Station& station : stations_) {
    if (!station.in_run || over) continue;
    station.heard = level;
    if (station.listener != nullptr) cut.push_back(station.listener);
  }
  if (!run.driven) {
    stations_[run.sender].drives = level;
    level_ = noted_ = level;
  }
  end_run();
  for (Listener* listener : cut) listener->run_cut(at, level);
}

// ---------------------------------------------------------------------------------------------------------------------

void Segment::report_collision(Tick at, StationId newcomer) {
  if (!on_collision) return;
  for (StationId i = 0; i < stations_.size(); ++i)
    if (i != newcomer && on_wire(stations_[i])) on_collision({at, stations_[i].name, stations_[newcomer].name});
}

}  // namespace bus
