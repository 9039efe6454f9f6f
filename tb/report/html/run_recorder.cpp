#include "tb/report/html/run_recorder.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "bus/baud.hpp"

namespace dsdpv1::tb::html {
namespace {

constexpr Tick kBefore = 2 * bus::kTicksPerUs, kAfter = bus::kTicksPerUs;  ///< shown round a violation
constexpr Tick kLongest = 100 * bus::kTicksPerUs;  ///< ... from where it was to where it was seen

SpanLimits limits_of(const checks::RuleTable& rules, const checks::Limits& limits, const char* check) {
  for (std::size_t i = 0; check != nullptr && i < rules.size(); ++i) {
    const checks::Limit& limit = limits[checks::CheckId(i)];
    if (std::string_view(rules[i].id) != check || !limit.on || limit.value == checks::kNoLimit) continue;
    return rules[i].bound == checks::Bound::kMin ? SpanLimits{limit.value, {}} : SpanLimits{{}, limit.value};
  }
  return {};
}

std::vector<SpanLimits> limits_of(const scenario::Scenario& scenario, const ChipKind& kind,
                                  const TimingDiagram& diagram) {
  const checks::Limits of_slave = scenario::limits_of(scenario, kind);
  std::vector<SpanLimits> limits;
  for (const DiagramSpan& span : diagram.spans) limits.push_back(limits_of(kind.rules(), of_slave, span.check));
  return limits;
}

SpanLimits tsdr_limits(int baud) {
  const Tick bit = bus::baud(baud).bit;
  return {bus::kMinTsdrBits * bit, bus::baud(baud).max_tsdr_bits * bit};
}

}  // namespace

RunRecorder::RunRecorder(const scenario::Scenario& scenario) : scenario_(scenario), telegrams_(scenario) {
  for (const scenario::Slave& each : scenario.slaves) {
    const ChipKind& kind = *each.kind;
    Slave& slave = slaves_.emplace_back(kind.pins().size());
    for (const TimingDiagram& diagram : kind.timing_diagrams())
      slave.diagrams.emplace_back(diagram, limits_of(scenario, kind, diagram), slave.memory);
    for (const BusyTime& busy : kind.busy_times()) slave.busy.push_back({{}, {busy.title, each.name.text, {}, 0, {}}});
  }
}

void RunRecorder::begins(std::size_t slave, const ChipView& chip) {
  Slave& own = slaves_[slave];
  own.chip = &chip;
  for (std::size_t pin = 0; pin < scenario_.slaves[slave].kind->pins().size(); ++pin) {
    const auto number = static_cast<PinNumber>(pin);
    own.memory.begin(number, chip.level(number));
  }
}

void RunRecorder::pin(std::size_t slave, Tick at, PinNumber pin, Level level) {
  Slave& own = slaves_[slave];
  if (!own.waiting.empty()) take_pictures(own, at);
  own.memory.add(at, pin, level);
  for (DiagramWatch& each : own.diagrams) each.pin(at, pin, level);
  busy_changed(slave, at, pin);
}

void RunRecorder::busy_changed(std::size_t number, Tick at, PinNumber changed) {
  Slave& slave = slaves_[number];
  const ChipKind& kind = *scenario_.slaves[number].kind;
  const std::vector<BusyTime>& all = kind.busy_times();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if ((all[i].pins & mask_of(changed)) == 0) continue;
    bool is_busy = false;
    for (std::size_t i_pin = 0; i_pin < kind.pins().size(); ++i_pin) {
      const auto pin = static_cast<PinNumber>(i_pin);
      is_busy = is_busy || ((all[i].pins & mask_of(pin)) != 0 && slave.memory.level(pin) == 1);
    }
    Busy& busy = slave.busy[i];
    if (is_busy && !busy.since) busy.since = at;
    if (is_busy || !busy.since) continue;
    busy.times.times.add(at - *busy.since);
    busy.since.reset();
  }
}

void RunRecorder::read(std::size_t slave, Tick sample) {
  for (DiagramWatch& each : slaves_[slave].diagrams) each.read(sample);
}

// --- the line --------------------------------------------------------------------------------------------------------

void RunRecorder::telegram(const HeardTelegram& heard) {
  telegrams_.add(heard);
  const bus::WireTelegram& wire = heard.telegram;
  if (wire.tsdr) answer(wire);
  if (!is_data_exchange(wire)) return;
  const std::uint8_t address = wire.decoded.telegram.da;
  Station& station = stations_[address];
  if (!station.cycle)
    station.cycle = TimesOf{"From Data_Exchange to Data_Exchange", telegrams_.station(address), {}, 0, {}};
  if (station.last_exchange) station.cycle->times.add(wire.start - *station.last_exchange);
  station.last_exchange = wire.start;
}

/// Times in bits of another rate are other times: the distribution begins again.
void RunRecorder::answer(const bus::WireTelegram& wire) {
  Station& station = stations_[wire.station];
  const Tick bit = bus::baud(wire.baud).bit;
  const SpanLimits limits = tsdr_limits(wire.baud);
  if (!station.tsdr || station.tsdr->unit != bit)
    station.tsdr = TimesOf{"TSDR", telegrams_.station(wire.station), {}, bit, {*limits.least, *limits.greatest}};
  station.tsdr->times.add(*wire.tsdr);
  for (Slave& slave : slaves_)
    if (slave.chip != nullptr && slave.chip->address() == wire.station)
      for (DiagramWatch& each : slave.diagrams) each.answered(wire.start - *wire.tsdr, wire.start, limits);
}

// --- violations ------------------------------------------------------------------------------------------------------

void RunRecorder::violated(const std::string& slave, const checks::Violation& violation, const char* /*kind*/) {
  const std::size_t number = slave_number(scenario_, slave);
  if (number == slaves_.size()) return;
  Slave& own = slaves_[number];
  if (own.pictures_of[violation.check.index]++ >= kMostOfARule ||
      pictures_.size() + own.waiting.size() >= kMostPictures) {
    ++not_pictured_;
    return;
  }
  ViolationPicture picture{number, violation, violation.at - kBefore, 0, {}, 0};
  picture.to = std::min(violation.found, violation.at + kLongest) + kAfter;
  own.waiting.push_back(std::move(picture));
}

void RunRecorder::take_pictures(Slave& slave, Tick now) {
  for (ViolationPicture& each : slave.waiting)
    if (each.to < now) take(slave, each);
  slave.waiting.erase(std::remove_if(slave.waiting.begin(), slave.waiting.end(),
                                     [now](const ViolationPicture& each) { return each.to < now; }),
                      slave.waiting.end());
}

void RunRecorder::take(const Slave& slave, ViolationPicture& picture) {
  const ChipKind& kind = *scenario_.slaves[picture.slave].kind;
  const PinMask of_rule = kind.rules()[picture.violation.check.index].pins;
  std::vector<PinTrace> others;
  for (std::size_t pin = 0; pin < kind.pins().size(); ++pin) {
    const auto number = static_cast<PinNumber>(pin);
    PinTrace trace = slave.memory.trace(number, picture.from, picture.to);
    const bool belongs = (of_rule & mask_of(number)) != 0;
    if (belongs || !trace.steps.empty()) (belongs ? picture.pins : others).push_back(std::move(trace));
  }
  picture.of_rule = picture.pins.size();
  std::move(others.begin(), others.end(), std::back_inserter(picture.pins));
  pictures_.push_back(std::move(picture));
}

void RunRecorder::finish() {
  for (Slave& slave : slaves_) {
    for (DiagramWatch& each : slave.diagrams) each.finish();
    take_pictures(slave, bus::kNever);
  }
}

std::vector<const TimesOf*> RunRecorder::times() const {
  std::vector<const TimesOf*> all;
  for (const auto& [address, station] : stations_)
    if (station.tsdr) all.push_back(&*station.tsdr);
  for (const auto& [address, station] : stations_)
    if (station.cycle && station.cycle->times.count() != 0) all.push_back(&*station.cycle);
  for (const Slave& slave : slaves_)
    for (const Busy& busy : slave.busy)
      if (busy.times.times.count() != 0) all.push_back(&busy.times);
  return all;
}

}  // namespace dsdpv1::tb::html
