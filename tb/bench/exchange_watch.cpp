#include "tb/bench/exchange_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "bus/time_text.hpp"

namespace dsdpv1::tb {
namespace {

using scenario::Action;
using scenario::ActionKind;
using scenario::Expectation;

constexpr std::array<std::string_view, 2> kEnds = {"WD_EXPIRED", "BAUD_LOST"};  ///< events that end data exchange

bool is_end(std::string_view code) { return std::find(kEnds.begin(), kEnds.end(), code) != kEnds.end(); }

bool is_away(const Expectation& expectation) {
  return (expectation.dp_state && *expectation.dp_state != profibus::DpState::kDataExch) ||
         (expectation.baud && !*expectation.baud) || expectation.data_exchanges_at_most == 0;
}

/// Expects that the slave is not in data exchange at the end, or never enters it.
bool is_away_at_the_end(const Expectation& expectation) {
  return is_away(expectation) && !expectation.at && !expectation.by;
}

/// Expects that it is not in data exchange at some time, or an event that ends data exchange.
bool leaves(const Expectation& expectation) {
  const bool never = expectation.count_at_most == 0;
  return (is_away(expectation) && expectation.at) || (is_end(expectation.event.text) && !never);
}

enum class Effect : std::uint8_t {
  kNone,
  kDisturbs,   ///< the slave may leave data exchange and returns automatically
  kKeepsAway,  ///< until another action restores it
  kRestores,   ///< ends the effect of an earlier action that keeps it away
};

Effect effect_of(const Action& action) {
  switch (action.what) {
    case ActionKind::kUnplug:
    case ActionKind::kStopMaster:
    case ActionKind::kSetSlaveAddress: return Effect::kKeepsAway;
    case ActionKind::kPlug:
    case ActionKind::kStartMaster: return Effect::kRestores;
    case ActionKind::kVerdict: return action.refuse ? Effect::kKeepsAway : Effect::kRestores;
    case ActionKind::kReinitialise:
    case ActionKind::kResetChip:
    case ActionKind::kOfChip:
    case ActionKind::kWrongLength:
    case ActionKind::kPauseUser:
    case ActionKind::kChangeBaud:
    case ActionKind::kTelegram:
    case ActionKind::kGlitch:
    case ActionKind::kAnswerFault: return Effect::kDisturbs;
    default: return Effect::kNone;
  }
}

/// Whether an action applies to an entry in a master's list; an action without a name is the first master's.
bool concerns(const Action& action, const std::string& first_master, const std::string& master,
              const std::string& slave) {
  if (!action.slave.empty()) return action.slave.text == slave;
  const bool everybody = action.what == ActionKind::kTelegram || action.what == ActionKind::kGlitch ||
                         action.what == ActionKind::kChangeBaud;
  return everybody || master == (action.master.empty() ? first_master : action.master.text);
}

/// The step to data exchange that events of this code are about; absent: no step.
std::optional<std::size_t> step_of(std::string_view code) {
  static constexpr std::array<std::string_view, 4> kSteps = {"INIT", "BAUD_", "PRM_", "CFG_"};
  for (std::size_t i = 0; i < kSteps.size(); ++i)
    if (code.substr(0, kSteps[i].size()) == kSteps[i]) return i;
  return std::nullopt;
}

/// Codes that end a step.
bool is_done(std::string_view code) {
  static constexpr std::array<std::string_view, 4> kDone = {"INITIALISED", "BAUD_FOUND", "PRM_OK", "CFG_OK"};
  return std::find(kDone.begin(), kDone.end(), code) != kDone.end();
}

std::string advice_of(const ChipKind& kind, const std::string& code) {
  for (const CodeTable& table : kind.codes())
    for (const CodeText& each : table.codes)
      if (each.code == code) return each.advice;
  return "";
}

}  // namespace

ExchangeWatch::ExchangeWatch(const scenario::Scenario& scenario, const Stations& stations, bool host)
    : scenario_(scenario),
      stations_(stations),
      steps_(scenario.slaves.size()),
      ends_(scenario.slaves.size()),
      entered_(scenario.slaves.size()) {
  if (!scenario.expects_exchange) return;
  for (const scenario::Master& master : scenario.masters)
    for (const scenario::MasterSlave& listed : master.slaves) add(master, listed);
  if (!host) return;
  for (const scenario::Slave& slave : scenario.slaves) add_of_host(slave);
}

void ExchangeWatch::add_of_host(const scenario::Slave& slave) {
  for (const Entry& each : entries_)
    if (each.slave == slave.name.text) return;
  Entry entry{"the host", slave.name.text, slave.name.text, slave.line, false};
  entry.of_host = true;
  for (const Expectation& each : scenario_.expect) {
    if (each.slave.text != entry.slave) continue;
    if (is_away_at_the_end(each)) return;
    entry.may_leave = entry.may_leave || leaves(each);
  }
  entries_.push_back(entry);
}

/// A slave listed only by its address is the scenario's slave with that address, if any; without one nothing is added.
void ExchangeWatch::add(const scenario::Master& master, const scenario::MasterSlave& listed) {
  const auto slave = std::find_if(scenario_.slaves.begin(), scenario_.slaves.end(), [&listed](const auto& each) {
    return listed.slave.empty() ? listed.address == each.address : listed.slave.text == each.name.text;
  });
  if (slave == scenario_.slaves.end()) return;
  const std::string& name = slave->name.text;
  const auto any = [&](bool (*is)(const Expectation&)) {
    return std::any_of(scenario_.expect.begin(), scenario_.expect.end(),
                       [&](const Expectation& each) { return each.slave.text == name && is(each); });
  };
  if (any(is_away_at_the_end)) return;
  entries_.push_back({master.name.text, name, listed.slave.empty() ? fmt::format("address {}", *listed.address) : name,
                      listed.line, any(leaves)});
}

/// An action after the slave's own step, of which a master knows only later, may still show. Of a kind that does
/// not tell its steps the master's is all there is.
void ExchangeWatch::enter(Entry& entry, Tick now) const {
  entry.since = now;
  if (entry.acted < entered_[slave_number(scenario_, entry.slave)].value_or(now))
    entry.disturbed = entry.kept_away = false;
}

void ExchangeWatch::event_of_host(Entry& entry, const profibus::Event& event) {
  const std::string_view code = profibus::code(event.reason);
  const bool prm = code.substr(0, 4) == "PRM_", refusal = profibus::severity(event.reason) != profibus::Severity::kInfo;
  if (event.reason == profibus::Reason::kPrmUnlock) {
    entry.let_go = true;
  } else if (prm || code.substr(0, 4) == "CFG_") {
    entry.asked = true;
    entry.let_go = entry.let_go && !prm;
    entry.refused = refusal;
  } else if (is_end(code) && entry.asked && !entry.let_go && !entry.disturbed && !entry.kept_away && !entry.may_leave) {
    entry.ended = event;
  }
}

/// A host that continues has left its slave alone for too long.
void ExchangeWatch::telegram(const HeardTelegram& heard) {
  const bus::WireTelegram& wire = heard.telegram;
  if (!wire.right() || !wire.decoded.telegram.is_request()) return;
  for (const scenario::Master& each : scenario_.masters)
    if (each.address == wire.decoded.telegram.sa) return;
  for (const scenario::Master2& each : scenario_.masters2)
    if (each.address == wire.decoded.telegram.sa) return;
  for (Entry& entry : entries_) {
    if (!entry.ended || wire.start <= entry.ended->at) continue;
    if (entry.left++ == 0) {
      entry.first_left = entry.ended->at;
      entry.why = profibus::code(entry.ended->reason);
    }
    entry.ended.reset();
  }
}

void ExchangeWatch::host_gone() {
  for (Entry& entry : entries_) {
    entry.let_go = true;
    entry.ended.reset();
  }
}

void ExchangeWatch::event(std::size_t slave, const profibus::Event& event) {
  if (profibus::severity(event.reason) == profibus::Severity::kViolation) return;  // neither step nor end is one
  const char* const code = profibus::code(event.reason);
  if (is_end(code)) ends_[slave] = event;
  if (event.reason == profibus::Reason::kDpState && event.b == static_cast<unsigned>(profibus::DpState::kDataExch))
    entered_[slave] = event.at;
  for (Entry& entry : entries_) {
    if (!entry.of_host || entry.slave != scenario_.slaves[slave].name.text) continue;
    event_of_host(entry, event);
    if (event.reason != profibus::Reason::kDpState) continue;
    entry.in = event.b == static_cast<unsigned>(profibus::DpState::kDataExch);
    if (entry.in) enter(entry, event.at);
  }
  const std::optional<std::size_t> step = step_of(code);
  if (!step) return;
  std::optional<profibus::Event>& stands = steps_[slave][*step];
  if (is_done(code))
    stands.reset();
  else if (!stands || stands->reason != event.reason)  // else the first one is kept
    stands = event;
}

void ExchangeWatch::master_state(Tick now, const std::string& master, const std::string& member,
                                 const std::string& state) {
  const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& each) { return each.master == master && each.member == member; });
  if (entry == entries_.end()) return;
  const bool in = state == bus::name(bus::SlaveState::kDataExchange);
  if (in) {
    enter(*entry, now);
  } else if (entry->in && !entry->disturbed && !entry->kept_away && !entry->may_leave && entry->left++ == 0) {
    entry->first_left = now;
    entry->why = stations_.master(master).slave(*stations_.listed_address(member)).step_reason;
    const auto& end = ends_[slave_number(scenario_, entry->slave)];
    if (end && end->at >= *entry->since)
      entry->why += fmt::format("; {} at {}", profibus::code(end->reason), bus::moment_text(end->at));
  }
  entry->in = in;
}

void ExchangeWatch::acts(const Action& action, Tick now) {
  Effect effect = effect_of(action);
  if (effect == Effect::kNone) return;
  if (effect == Effect::kDisturbs && now + action.duration.value_or(0) >= scenario_.end) effect = Effect::kKeepsAway;
  for (Entry& entry : entries_) {
    const std::string first = scenario_.masters.empty() ? "" : scenario_.masters.front().name.text;
    if (!concerns(action, first, entry.master, entry.slave)) continue;
    entry.disturbed = true;
    entry.acted = now;
    if (effect != Effect::kDisturbs) entry.kept_away = effect == Effect::kKeepsAway;
  }
}

ExpectationResult ExchangeWatch::judged(const Entry& entry, const SlaveResult& slave) const {
  ExpectationResult result;
  result.text =
      fmt::format("{} comes to data exchange with {} and stays to the end (implied; expect: none switches it off)",
                  entry.slave, entry.master);
  result.line = entry.line;
  result.implied = true;
  const bool there = entry.in && !entry.kept_away && slave.status.dp_state == profibus::DpState::kDataExch;
  result.left_out = entry.left == 0 && !there && entry.since && entry.kept_away;
  const bool host_ended = entry.since && !entry.refused && (entry.let_go || entry.ended);
  result.passed = entry.left == 0 && (there || host_ended);
  const std::string state = there ? "in data exchange"
                            : entry.in || slave.status.dp_state != profibus::DpState::kDataExch
                                ? name(slave.status.dp_state)
                                : "no longer asked or heard by " + entry.master;
  if (!entry.since)
    result.seen = "never, " + state + " at the end";
  else if (entry.left != 0)
    result.seen = fmt::format("left {} time{} without the script, first at {}{}; {} at the end", entry.left,
                              entry.left == 1 ? "" : "s", bus::moment_text(entry.first_left),
                              entry.why.empty() ? "" : ", " + entry.why, state);
  else
    result.seen = fmt::format("since {}{}{}", bus::moment_text(*entry.since), there ? "" : ", but at the end " + state,
                              result.left_out ? ": the script keeps it away" : "");
  if (result.passed || result.left_out || there) return result;
  if (!slave.master_reason.empty()) result.seen += fmt::format("; {}: {}", entry.master, slave.master_reason);
  if (!slave.waits_for.empty()) result.seen += "; " + slave.waits_for;
  return result;
}

std::vector<ExpectationResult> ExchangeWatch::finish(const std::vector<SlaveResult>& slaves) const {
  std::vector<ExpectationResult> results;
  results.reserve(entries_.size());
  for (const Entry& entry : entries_)
    if (!entry.of_host || entry.asked) results.push_back(judged(entry, slaves[slave_number(scenario_, entry.slave)]));
  return results;
}

std::string ExchangeWatch::waits_for(const SlaveResult& slave) const {
  if (slave.status.dp_state == profibus::DpState::kDataExch) return "";
  const Steps& steps = steps_[slave_number(scenario_, slave.name)];
  const auto stands = std::find_if(steps.begin(), steps.end(), [](const auto& each) { return each.has_value(); });
  if (stands == steps.end())
    return slave.status.dp_state == profibus::DpState::kOffline ? "its user CPU has not initialised it" : "";
  const std::string code = profibus::code((*stands)->reason);
  const ChipKind& kind = *scenario_.slaves[slave_number(scenario_, slave.name)].kind;
  return fmt::format("{} since {}: {}. {}", code, bus::moment_text((*stands)->at), kind.describe(**stands),
                     advice_of(kind, code));
}

}  // namespace dsdpv1::tb
