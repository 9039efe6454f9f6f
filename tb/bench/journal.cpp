#include "tb/bench/journal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "io/input/units.hpp"
#include "tb/scenario/event_codes.hpp"

namespace dsdpv1::tb {

void Journal::log(LogEntry entry) {
  if (!log_) return;
  entry.at = std::max(entry.at, observers_.now());
  log_->add(entry);
}

std::string Journal::in_log(const bus::Bytes& bytes) const { return bytes_text(bytes, form_.most_bytes()); }

void Journal::count_one(Tick at, const std::string& station, const std::string& code, bool violation) {
  const std::uint64_t count = ++counts_[station][code];
  observers_.tell(&Observer::counted, at, station, code, violation, count);
}

void Journal::happened(Occurrence occurrence, const profibus::Event* event) {
  const auto text = [&] { return event != nullptr ? scenario_.kind->describe(*event) : occurrence.text; };
  const bool violation = occurrence.severity == profibus::Severity::kViolation;
  count_one(occurrence.at, occurrence.station, occurrence.code, violation);
  occurrence.allowed = violation && scenario::allows(scenario_, occurrence.code, occurrence.station);
  if (violation) {
    ++(occurrence.allowed ? allowed_ : violations_);
    violated_.count(occurrence, text);
  }
  if (occurrence.severity == profibus::Severity::kRefusal) refusals_.count(occurrence, text);
  if (log_)
    log({occurrence.at, occurrence.station, occurrence.allowed ? "allowed" : name(occurrence.severity), text(),
         occurrence.code});
  if (kept_.size() < RunResult::kKept)
    kept_.push_back({std::move(occurrence), event != nullptr ? std::optional(*event) : std::nullopt});
  else
    ++occurrences_dropped_;
}

void Journal::violated(const std::string& slave, const checks::Violation& violation, const char* kind) {
  const std::string id = scenario_.kind->rules()[violation.check.index].id;
  count_one(violation.found, slave, id, true);
  if (!log_) return;
  log_->finding(
      {std::max(violation.found, observers_.now()), slave, kind,
       fmt::format("at {} ns: {}  [{}]", nanoseconds(violation.at), violation.text, checks::history_text(violation)),
       id});
}

void Journal::event(std::size_t slave, const profibus::Event& event) {
  happened({event.at,
            name_of(slave),
            profibus::code(event.reason),
            profibus::severity(event.reason),
            {},
            scenario_.kind->cell_of(event)},
           &event);
}

void Journal::telegram(const HeardTelegram& telegram) {
  if (log_) log(log_entry(telegram.telegram, telegram.words()));
}

// Masters use unanswered requests to find out that a station is absent.
void Journal::flag(const bus::Flag& flag) {
  const bool wrong = flag.kind != bus::FlagKind::kUnanswered;
  happened({flag.at, "bus", scenario::flag_code(flag.kind),
            wrong ? profibus::Severity::kViolation : profibus::Severity::kInfo, flag.text});
}

void Journal::error(std::size_t slave, const user_cpu::ProgramError& error) {
  happened({error.at, name_of(slave), error.code, profibus::Severity::kRefusal, error.text});
}

void Journal::outputs(std::size_t slave, Tick at, const bus::Bytes& outputs, bool changed) {
  if (changed) log({at, name_of(slave), "user", "outputs", {}, outputs});
}

void Journal::user_failed(std::size_t slave, Tick at, const std::string& why, const std::string& /*registers*/) {
  happened({at, name_of(slave), scenario::kFirmwareFault, profibus::Severity::kViolation, why});
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
    if (kept.event) result.occurrences.back().text = scenario_.kind->describe(*kept.event);
  }
  std::stable_sort(result.occurrences.begin(), result.occurrences.end(), [](const Occurrence& a, const Occurrence& b) {
    return std::tie(a.at, a.station) < std::tie(b.at, b.station);
  });
  result.occurrences_dropped = occurrences_dropped_;
  result.allowed = allowed_;
  result.refused = refusals_.list();
  result.violated = violated_.list();
}

}  // namespace dsdpv1::tb
