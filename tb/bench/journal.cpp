#include "tb/bench/journal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "io/input/units.hpp"
#include "tb/scenario/event_codes.hpp"

namespace dsdpv1::tb {
namespace {

/// Of an error of a program: a refusal, unless the kind's tables of codes say violation.
profibus::Severity severity_of(const ChipKind& kind, const std::string& code) {
  for (const CodeTable& table : kind.codes())
    for (const CodeText& each : table.codes)
      if (each.code == code && each.severity == name(profibus::Severity::kViolation))
        return profibus::Severity::kViolation;
  return profibus::Severity::kRefusal;
}

}  // namespace

void Journal::log(LogEntry entry) {
  if (!log_) return;
  entry.at = std::max(entry.at, observers_.now());
  log_->add(entry);
}

std::string Journal::in_log(const bus::Bytes& bytes) const { return bytes_text(bytes, form_.most_bytes()); }

Journal::Tally Journal::tally(const std::string& station, const std::string& code, profibus::Severity severity,
                              const std::string& place, bool judged) {
  Occurrence sample{0, station, code, severity, {}, place};
  const bool violation = severity == profibus::Severity::kViolation;
  sample.allowed = violation && scenario::allows(scenario_, code, station);
  sample.judged = judged;
  Repeated* const repeated = violation                                  ? &violated_.entry(sample)
                             : severity == profibus::Severity::kRefusal ? &refusals_.entry(sample)
                                                                        : nullptr;
  return {std::move(sample), &counts_[station][code], repeated};
}

bool Journal::EventTally::is_of(std::size_t other, const profibus::Event& another) const {
  const profibus::Event& own = event;
  return slave == other && own.reason == another.reason && own.a == another.a && own.b == another.b &&
         own.c == another.c;
}

const Journal::Tally& Journal::tally(std::size_t slave, const profibus::Event& event) {
  const std::size_t row = std::hash<const void*>()(&event.reason.row()) / sizeof(profibus::ReasonRow);
  std::optional<EventTally>& kept = tallies_.at((row + event.a + slave) % tallies_.size());
  if (!kept || !kept->is_of(slave, event))
    kept = EventTally{slave, event,
                      tally(name_of(slave), profibus::code(event.reason), profibus::severity(event.reason),
                            kind_of(slave).cell_of(event))};
  return kept->tally;
}

void Journal::count(const Tally& tally, Tick at) {
  const Occurrence& sample = tally.sample;
  const bool violation = sample.severity == profibus::Severity::kViolation;
  observers_.counted(at, sample.station, sample.code, violation, ++*tally.count);
  if (violation) ++(sample.allowed ? allowed_ : sample.judged ? violations_ : unjudged_);
}

/// Neither listed nor logged, and not the first of its kind.
bool Journal::is_only_counted(const Tally& tally) const {
  return !lists() && !log_ && (tally.repeated == nullptr || tally.repeated->count != 0);
}

void Journal::count_again(const Tally& tally, Tick at) {
  count(tally, at);
  ++occurrences_dropped_;
  if (tally.repeated != nullptr) tally.repeated->add_again(at);
}

template <class Where>
void Journal::happened(const Tally& tally, Tick at, const std::string& words, const OfChip& chip, const Where& where) {
  const auto text = [&] { return chip.event != nullptr ? chip.kind->describe(*chip.event) : words; };
  const Occurrence& sample = tally.sample;
  count(tally, at);
  const std::optional<user_cpu::Place> place = where();
  if (tally.repeated != nullptr) tally.repeated->add(at, text, place);
  if (log_) {
    const char* const kind = sample.allowed ? "allowed" : sample.judged ? name(sample.severity) : "check";
    LogEntry entry{at, sample.station, kind, text(), sample.code};
    entry.where = place;
    log(entry);
  }
  if (!lists()) {
    ++occurrences_dropped_;
    return;
  }
  kept_.push_back({sample, chip.kind, chip.event != nullptr ? std::optional(*chip.event) : std::nullopt});
  kept_.back().occurrence.at = at;
  kept_.back().occurrence.text = words;
  kept_.back().occurrence.where = place;
}

void Journal::violated(const std::string& slave, const checks::Violation& violation, const char* kind) {
  const std::string id = kind_of(slave_number(scenario_, slave)).rules()[violation.check.index].id;
  observers_.counted(violation.found, slave, id, true, ++counts_[slave][id]);
  if (!log_) return;
  LogEntry entry{
      std::max(violation.found, observers_.now()), slave, kind,
      fmt::format("at {} ns: {}  [{}]", nanoseconds(violation.at), violation.text, checks::history_text(violation)),
      id};
  entry.where = violation.where;
  log_->finding(entry);
}

void Journal::event(std::size_t slave, const profibus::Event& event) {
  const Tally& kept = tally(slave, event);
  if (is_only_counted(kept)) return count_again(kept, event.at);
  const ChipKind& kind = kind_of(slave);
  happened(kept, event.at, {}, {&kind, &event}, [&]() -> std::optional<user_cpu::Place> {
    const bool done_by_user = profibus::severity(event.reason) != profibus::Severity::kInfo;
    const std::optional<user_cpu::Act> act = done_by_user ? kind.act_of(event) : std::nullopt;
    return act ? observers_.where(slave, *act) : std::nullopt;
  });
}

void Journal::telegram(const HeardTelegram& telegram) {
  if (log_) log(log_entry(telegram.telegram, telegram.words()));
}

// Masters use unanswered requests to find out that a station is absent.
void Journal::flag(const bus::Flag& flag) {
  const bool wrong = flag.kind != bus::FlagKind::kUnanswered;
  happened(
      tally("bus", scenario::flag_code(flag.kind), wrong ? profibus::Severity::kViolation : profibus::Severity::kInfo),
      flag.at, flag.text, {}, [] { return std::nullopt; });
}

void Journal::host_early(Tick at, const bus::Bytes& telegram, bool judged) {
  happened(
      tally("host", scenario::kHostEarly, profibus::Severity::kViolation, {}, judged), at,
      "before the answer to the request before has left: " + in_log(telegram), {}, [] { return std::nullopt; });
}

void Journal::error(std::size_t slave, const user_cpu::ProgramError& error) {
  happened(
      tally(name_of(slave), error.code, severity_of(kind_of(slave), error.code)), error.at, error.text, {},
      [&error] { return error.where; });
}

void Journal::outputs(std::size_t slave, Tick at, const bus::Bytes& outputs, bool changed) {
  if (changed) log({at, name_of(slave), "user", "outputs", {}, outputs});
}

void Journal::user_failed(std::size_t slave, Tick at, const std::string& why, const std::string& /*registers*/) {
  happened(
      tally(name_of(slave), scenario::kFirmwareFault, profibus::Severity::kViolation), at, why, {},
      [&] { return observers_.where(slave, user_cpu::Act::done(at)); });
}

void Journal::host_telegram(std::size_t slave, const HostTelegram& telegram) {
  const Tick at = std::max(telegram.end, telegram.known);
  LogEntry entry{at, name_of(slave), "host", telegram.words, {}, telegram.bytes};
  entry.wrong = telegram.wrong;
  if (log_) log_->finding(entry);
}

std::uint64_t Journal::count(const std::string& station, const std::string& code) const {
  const auto codes = counts_.find(station);
  if (codes == counts_.end()) return 0;
  const auto entry = codes->second.find(code);
  return entry == codes->second.end() ? 0 : entry->second;
}

void Journal::fill(RunResult& result) const {
  for (const Kept& kept : kept_) {
    result.occurrences.push_back(kept.occurrence);
    if (kept.event) result.occurrences.back().text = kept.kind->describe(*kept.event);
  }
  std::stable_sort(result.occurrences.begin(), result.occurrences.end(), [](const Occurrence& a, const Occurrence& b) {
    return std::tie(a.at, a.station) < std::tie(b.at, b.station);
  });
  result.occurrences_dropped = occurrences_dropped_;
  result.allowed = allowed_;
  result.unjudged = unjudged_;
  result.refused = refusals_.list();
  result.violated = violated_.list();
}

}  // namespace dsdpv1::tb
