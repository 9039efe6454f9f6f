#include "bus/wire/segment.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::bus {

namespace {

constexpr Tick kGapBits = 2;  // separates runs for any receiver, however it rounds them

}  // namespace

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
  if (Diversion* const diversion = stations_.at(station).diversion) return diversion->driven(at, enabled, level);
  deliver(station, at, enabled, level);
}

bool Segment::divert(StationId station, Tick at, Diversion& diversion) {
  cut_run(at);
  stations_.at(station).diversion = &diversion;
  return stations_[station].enabled;
}

void Segment::deliver(StationId station, Tick at, bool enabled, bool level) {
  Station& driver = stations_.at(station);
  if (run_ && !(run_->driven && run_->sender == station && enabled)) cut_run(at);
  if (on_drive) on_drive(station, at, enabled, level);
  const bool was_on_wire = on_wire(driver);
  driver.enabled = enabled;
  driver.drives = level;
  update_drivers(station, at, was_on_wire);
  settle(at);
}

void Segment::update_drivers(StationId station, Tick at, bool was_on_wire) {
  const bool is_on_wire = on_wire(stations_[station]);
  if (was_on_wire == is_on_wire) return;
  if (is_on_wire) {
    report_collision(at, station);
    drivers_.insert(std::upper_bound(drivers_.begin(), drivers_.end(), station), station);
  } else {
    drivers_.erase(std::find(drivers_.begin(), drivers_.end(), station));
  }
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
  changed.filter = {};
  update_drivers(station, at, was_on_wire);
  level_ = driven_level();
  if (!telling_) tell_all(at);
}

bool Segment::level_at(StationId station) const { return !stations_.at(station).plugged || level_; }

bool Segment::level_before(Tick at) const {
  const bool carried = run_ && !run_->driven && at > run_->characters.start;
  if (carried) return run_->characters.level(at - 1);
  return noted_at_ == at ? before_noted_ : level_;
}

bool Segment::driven_level() const {
  if (forced_) return *forced_;
  return std::all_of(drivers_.begin(), drivers_.end(), [this](StationId driver) { return stations_[driver].drives; });
}

void Segment::settle(Tick at) {
  level_ = driven_level();
  if (level_ != noted_ && !telling_)
    tell_all(at);  // else the outer call reports until all listeners have the last level
}

void Segment::tell_all(Tick at) {
  telling_ = true;
  do note_change(at);
  while (tell_changes(at));
  telling_ = false;
}

void Segment::note_change(Tick at) {
  if (level_ == noted_) return;
  if (std::exchange(noted_at_, at) != at) before_noted_ = noted_;
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
    if (in_run(station)) continue;
    if (station.plugged && station.deafness.at(at)) continue;
    if (station.passes) tell_passed(station);
    if (station.plugged) tell_missed(station, at);
    station.next_change = changes_.size();
    told |= tell(station, at, !station.plugged || level_);
  }
  return told;
}

void Segment::tell_missed(StationId station) {
  if (stations_[station].plugged && !in_run(stations_[station])) tell_missed(stations_[station], kNever);
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

// The line is idle, only this station drives it, and a listener exists for the cut.
bool Segment::may_send_run(StationId station) const {
  const bool alone = drivers_.size() == 1 && drivers_.front() == station;
  return alone && stations_[station].listener != nullptr && stations_[station].diversion == nullptr && level_ &&
         !forced_ && !telling_ && !run_;
}

bool Segment::send_run(StationId station, const CharacterRun& run) {
  if (run_ && run.start >= run_->characters.end()) end_run();
  if (!may_send_run(station)) return false;
  Offer offered{run, run.start >= last_run_.end() + kGapBits * run.bit};
  run_ = Run{run, station, false};
  ++run_count_;
  bool kept = false;
  for (StationId i = 0; i < stations_.size(); ++i)
    if (stations_[i].plugged) kept |= offer(i, offered);
  last_run_ = run;
  if (kept) keep(run);
  return !run_->driven;
}

/// Returns true if the station's filter skips the run for now.
bool Segment::offer(StationId station, Offer& offer) {
  Station& one = stations_[station];
  if (passes(one, offer)) {
    one.passed_for_stations += std::exchange(one.last_for_station, offer.addressee < kBroadcast) ? 1 : 0;
    one.run = run_count_;
    return one.passes = true;
  }
  hear(station);
  if (one.listener == nullptr || one.listener->run_begins(offer.run))
    one.run = run_count_;
  else
    run_->driven = true;
  return false;
}

bool Segment::passes(const Station& station, Offer& offer) {
  const RunFilter& filter = station.filter;
  const CharacterRun& run = offer.run;
  if (filter.reader == nullptr || !offer.after_gap || run.start < filter.from || run.bit != filter.bit) return false;
  if (offer.reader != filter.reader) {
    offer.reader = filter.reader;
    offer.addressee = run.size <= kLongestKept ? filter.reader(run.bytes, run.size) : kNoTelegram;
  }
  return offer.addressee != kNoTelegram && offer.addressee != kBroadcast && offer.addressee != filter.address;
}

void Segment::keep(const CharacterRun& run) {
  std::copy_n(run.bytes, run.size, last_bytes_.begin());
  last_run_.bytes = last_bytes_.data();
}

void Segment::tell_passed(Station& station) {
  station.passes = station.last_for_station = false;
  if (const std::uint64_t before = std::exchange(station.passed_for_stations, 0)) station.listener->runs_passed(before);
  station.listener->run_begins(last_run_);
}

// Listeners that took the run have missed no change of it.
void Segment::end_run() {
  if (run_->driven)
    for (Station& station : stations_)
      if (in_run(station)) station.next_change = changes_.size();
  run_.reset();
}

void Segment::cut_run(Tick at) {
  if (!run_) return;
  const Run run = *run_;
  if (at >= run.characters.end()) return end_run();
  const bool level = run.characters.level(at);
  std::vector<Listener*> cut;
  for (Station& station : stations_) {
    if (station.passes) tell_passed(station);
    if (!in_run(station)) continue;
    station.heard = level;
    if (station.listener != nullptr) cut.push_back(station.listener);
  }
  if (!run.driven) {
    before_noted_ = level_before(at);
    noted_at_ = at;
    stations_[run.sender].drives = level;
    level_ = noted_ = level;
  }
  end_run();
  for (Listener* listener : cut) listener->run_cut(at, level);
}

// ---------------------------------------------------------------------------------------------------------------------

void Segment::report_collision(Tick at, StationId newcomer) {
  if (!on_collision) return;
  for (const StationId driver : drivers_) on_collision({at, stations_[driver].name, stations_[newcomer].name});
}

}  // namespace dsdpv1::bus
