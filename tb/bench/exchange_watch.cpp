#include "tb/bench/exchange_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace dsdpv1::tb {
namespace {

using scenario::Action;
using scenario::ActionKind;
using scenario::Expectation;

std::string microseconds(Tick tick) {
  return fmt::format("{:.3f} us", static_cast<double>(tick) / static_cast<double>(bus::kTicksPerUs));
}

/// An expectation of the scenario that the slave is out of data exchange at some time.
bool says_otherwise(const Expectation& expectation) {
  static constexpr std::array<std::string_view, 2> kEnds = {"WD_EXPIRED", "BAUD_LOST"};
  return (expectation.dp_state && *expectation.dp_state != profibus::DpState::kDataExch) ||
         (expectation.baud && !*expectation.baud) || expectation.data_exchanges_at_most ||
         std::find(kEnds.begin(), kEnds.end(), expectation.event.text) != kEnds.end();
}

enum class Effect : std::uint8_t {
  kNone,
  kDisturbs,   ///< the slave may leave data exchange, and comes back by itself
  kKeepsAway,  ///< until another action ends that
  kEnds,       ///< that an earlier action keeps it away
};

Effect effect_of(const Action& action) {
  switch (action.what) {
    case ActionKind::kUnplug:
    case ActionKind::kStopMaster:
    case ActionKind::kSetSlaveAddress: return Effect::kKeepsAway;
    case ActionKind::kPlug:
    case ActionKind::kStartMaster: return Effect::kEnds;
    case ActionKind::kVerdict: return action.refuse ? Effect::kKeepsAway : Effect::kEnds;
    case ActionKind::kReinitialise:
      return action.new_address || action.cfg ? Effect::kKeepsAway : Effect::kDisturbs;
    case ActionKind::kResetChip:
    case ActionKind::kOfChip:
    case ActionKind::kWrongLength:
    case ActionKind::kPauseUser:
    case ActionKind::kChangeBaud:
    case ActionKind::kTelegram:
    case ActionKind::kGlitch: return Effect::kDisturbs;
    default: return Effect::kNone;
  }
}

/// In whose list a master's action is: of the first one without a name.
bool concerns(const Action& action, const std::string& first_master, const std::string& master,
              const std::string& slave) {
  if (!action.slave.empty()) return action.slave.text == slave;
  const bool everybody = action.what == ActionKind::kTelegram || action.what == ActionKind::kGlitch ||
                         action.what == ActionKind::kChangeBaud;
  return everybody || master == (action.master.empty() ? first_master : action.master.text);
}

/// The step to data exchange that an event of this code is about; absent: none.
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

ExchangeWatch::ExchangeWatch(const scenario::Scenario& scenario, const Stations& stations)
    : scenario_(scenario), stations_(stations), steps_(scenario.slaves.size()) {
  if (!scenario.expects_exchange) return;
  for (const scenario::Master& master : scenario.masters) {
    for (const scenario::MasterSlave& slave : master.slaves) {
      if (slave.slave.empty()) continue;
      Entry entry{master.name.text, slave.slave.text, slave.line};
      entry.expected = std::none_of(
          scenario.expect.begin(), scenario.expect.end(),
          [&slave](const Expectation& each) { return each.slave.text == slave.slave.text && says_otherwise(each); });
      entries_.push_back(std::move(entry));
    }
  }
}

void ExchangeWatch::event(std::size_t slave, const profibus::Event& event) {
  const char* const code = profibus::code(event.reason);
  const std::optional<std::size_t> step = step_of(code);
  if (!step) return;
  std::optional<profibus::Event>& stands = steps_[slave][*step];
  if (is_done(code))
    stands.reset();
  else if (!stands || stands->reason != event.reason)  // else it stands since the first time
    stands = event;
}

void ExchangeWatch::master_state(Tick now, const std::string& master, const std::string& member,
                                 const std::string& state) {
  const auto entry = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& each) {
    return each.master == master && each.slave == member;
  });
  if (entry == entries_.end()) return;
  const bool in = state == bus::name(bus::SlaveState::kDataExchange);
  if (in) {
    entry->since = now;
    entry->disturbed = false;
  } else if (entry->in && !entry->disturbed && !entry->kept_away && entry->left++ == 0) {
    entry->first_left = now;
    entry->why = stations_.master(master).slave(*stations_.listed_address(member)).step_reason;
  }
  entry->in = in;
}

void ExchangeWatch::acts(const Action& action) {
  const Effect effect = effect_of(action);
  if (effect == Effect::kNone) return;
  for (Entry& entry : entries_) {
    if (!concerns(action, scenario_.masters.front().name.text, entry.master, entry.slave)) continue;
    entry.disturbed = true;
    if (effect != Effect::kDisturbs) entry.kept_away = effect == Effect::kKeepsAway;
  }
}

ExpectationResult ExchangeWatch::judged(const Entry& entry, const SlaveResult* slave) const {
  ExpectationResult result;
  result.text = fmt::format("{}: data exchange with {}, from then on to the end", entry.slave, entry.master);
  result.line = entry.line;
  result.implied = true;
  const bool there = entry.in && (slave == nullptr || slave->status.dp_state == profibus::DpState::kDataExch);
  result.passed = entry.left == 0 && (there || entry.kept_away);
  const std::string state = slave == nullptr ? "not there" : name(slave->status.dp_state);
  if (entry.left != 0)
    result.seen = fmt::format("left {} time{} without the script, first at {}{}; {} at the end", entry.left,
                              entry.left == 1 ? "" : "s", microseconds(entry.first_left),
                              entry.why.empty() ? "" : ", " + entry.why, there ? "back" : state);
  else if (entry.since)
    result.seen = fmt::format("since {}{}", microseconds(*entry.since), there ? "" : ", but at the end " + state);
  else
    result.seen = "never, " + state + " at the end";
  if (result.passed || slave == nullptr || there) return result;
  if (!slave->master_reason.empty()) result.seen += fmt::format("; {}: {}", entry.master, slave->master_reason);
  if (!slave->waits_for.empty()) result.seen += "; " + slave->waits_for;
  return result;
}

std::vector<ExpectationResult> ExchangeWatch::finish(const std::vector<SlaveResult>& slaves) const {
  std::vector<ExpectationResult> results;
  for (const Entry& entry : entries_) {
    if (!entry.expected) continue;
    const auto slave = std::find_if(slaves.begin(), slaves.end(),
                                    [&entry](const SlaveResult& each) { return each.name == entry.slave; });
    results.push_back(judged(entry, slave == slaves.end() ? nullptr : &*slave));
  }
  return results;
}

std::string ExchangeWatch::waits_for(const SlaveResult& slave) const {
  if (slave.status.dp_state == profibus::DpState::kDataExch) return "";
  const auto of_name = [&slave](const scenario::Slave& each) { return each.name.text == slave.name; };
  const auto found = std::find_if(scenario_.slaves.begin(), scenario_.slaves.end(), of_name);
  const Steps& steps = steps_[static_cast<std::size_t>(found - scenario_.slaves.begin())];
  const auto stands = std::find_if(steps.begin(), steps.end(), [](const auto& each) { return each.has_value(); });
  if (stands == steps.end())
    return slave.status.dp_state == profibus::DpState::kOffline ? "its user CPU has not initialised it" : "";
  const std::string code = profibus::code((*stands)->reason);
  return fmt::format("{} since {}: {}. {}", code, microseconds((*stands)->at), scenario_.kind->describe(**stands),
                     advice_of(*scenario_.kind, code));
}

}  // namespace dsdpv1::tb
