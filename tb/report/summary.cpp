#include "tb/report/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bus/printable.hpp"
#include "bus/time_text.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/report/check_report.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::tb {
namespace {

/// The steps from power-on to data exchange.
bool is_step(const Occurrence& each) {
  static constexpr std::array<const char*, 9> kSteps = {"READY_FLAG", "INITIALISED", "BAUD_SEARCH",
                                                        "BAUD_FOUND", "BAUD_LOST",   "DP_STATE",
                                                        "WD_ON",      "WD_EXPIRED",  "ADDRESS"};
  return std::any_of(kSteps.begin(), kSteps.end(), [&each](const char* code) { return each.code == code; });
}

/// A station's steps of one time in one row.
std::vector<Occurrence> joined_steps(const RunResult& result) {
  std::vector<Occurrence> rows;
  for (const Occurrence& each : result.occurrences) {
    if (!is_step(each)) continue;
    if (!rows.empty() && rows.back().at == each.at && rows.back().station == each.station)
      rows.back().text += "; " + each.text;
    else
      rows.push_back(each);
  }
  return rows;
}

std::string steps(const RunResult& result) {
  constexpr std::size_t kMost = 40;
  const std::vector<Occurrence> rows = joined_steps(result);
  if (rows.empty()) return "";
  TextTable table({"time", "station", "what"});
  for (std::size_t i = 0; i < std::min(rows.size(), kMost); ++i)
    table.add({bus::moment_text(rows[i].at), rows[i].station, rows[i].text});
  const std::string more =
      rows.size() > kMost ? fmt::format("  ... and {} more, see --log and --result\n", rows.size() - kMost) : "";
  return table.text() + more + "\n";
}

/// All of a station and code, at whatever places.
struct Group {
  const Repeated* first = nullptr;
  std::size_t places = 0;
  std::uint64_t count = 0, allowed = 0;
  Tick last = 0;
};

/// By the first time.
std::vector<Group> grouped(const std::vector<Repeated>& all) {
  std::vector<Group> groups;
  for (const Repeated& each : all) {
    const auto is_same = [&each](const Group& group) {
      return group.first->station == each.station && group.first->code == each.code;
    };
    auto group = std::find_if(groups.begin(), groups.end(), is_same);
    if (group == groups.end()) group = groups.insert(group, Group{&each, 0, 0, 0, 0});
    ++group->places;
    group->count += each.count;
    group->allowed += each.allowed ? each.count : 0;
    group->last = std::max(group->last, each.last);
  }
  return groups;
}

std::string place_of(const Group& group) {
  if (group.places > 1) return fmt::format(" ({} places)", group.places);
  return group.first->place.empty() ? "" : " (" + group.first->place + ")";
}

std::string times_of(const Group& group) {
  if (group.allowed == 0) return fmt::format("{}", group.count);
  if (group.allowed == group.count) return fmt::format("{} allowed", group.count);
  return fmt::format("{}, {} allowed", group.count, group.allowed);
}

/// A row for each station and code, so that the log is not needed for it.
std::string repeated(const char* head, const std::vector<Repeated>& all) {
  if (all.empty()) return "";
  TextTable table({head, "reason", "times", "first", "last", "what, the first time"});
  for (const Group& group : grouped(all))
    table.add({group.first->station, group.first->code + place_of(group), times_of(group),
               bus::moment_text(group.first->first), bus::moment_text(group.last),
               with_place(group.first->text, group.first->where)});
  return table.text() + "  dsdpv1-sim reasons REASON says what to do\n\n";
}

std::string tsdr(const SlaveResult& slave) {
  return slave.tsdr.answers == 0 ? "-" : fmt::format("{:.2f} .. {:.2f}", slave.tsdr.min_bits, slave.tsdr.max_bits);
}

using Cells = std::vector<std::string>;

Cells joined(Cells row, const Cells& more) {
  row.insert(row.end(), more.begin(), more.end());
  return row;
}

Cells state_of(const SlaveResult& slave) {
  return {slave.name,
          fmt::format("{}", slave.status.address),
          name(slave.status.dp_state),
          baud_text(slave.status.baud),
          fmt::format("{}", slave.status.data_exchanges),
          fmt::format("{}", slave.status.outputs_missed),
          tsdr(slave)};
}

Cells times_of(const SlaveResult& slave) {
  return {bus::short_time(slave.status.longest_wait), bus::short_time(slave.user.port.longest_wait),
          bus::short_time(slave.user.port.longest_hold)};
}

/// One table, or one of states and one of times where it is too wide. A passing run has the times only with the
/// details.
std::string slaves(const RunResult& result, bool with_times) {
  const Cells state = {"slave", "address", "DP state", "baud", "exchanges", "overwritten", "TSDR / bit times"},
              times = {"chip waited", "user waited", "longest hold"};
  TextTable whole(joined(state, times)), states(state), others(joined({"slave"}, times));
  for (const SlaveResult& slave : result.slaves) {
    whole.add(joined(state_of(slave), times_of(slave)));
    states.add(state_of(slave));
    others.add(joined({slave.name}, times_of(slave)));
  }
  if (!with_times) return states.text() + "\n";
  return (whole.fits() ? whole.text() : states.text() + others.text()) + "\n";
}

std::string interval_from(const MasterResult& master) {
  const bool has_none = master.min_slave_interval_us == 0;
  if (master.interval_given) return has_none ? "min_slave_interval: 0" : "min_slave_interval of the scenario";
  return has_none ? "no Min_Slave_Intervall" : "Min_Slave_Intervall of its slaves";
}

std::string masters(const RunResult& result) {
  std::string text;
  for (const MasterResult& master : result.masters) {
    const std::string interval = master.min_slave_interval_us == 0
                                     ? "without pauses"
                                     : fmt::format("{} us or more each", master.min_slave_interval_us);
    text += named_line(
        "master", fmt::format("{}: {} cycles, {} ({})", master.name, master.cycles, interval, interval_from(master)));
  }
  return text;
}

std::string expectations(const RunResult& result) {
  std::string text;
  std::size_t all = 0, met = 0, left_out = 0, implied = 0, kept = 0, kept_away = 0;
  for (const ExpectationResult& each : result.expectations) {
    ++(each.implied ? implied : all);
    if (each.passed) {
      ++(each.implied ? kept : met);
    } else if (each.left_out) {
      ++(each.implied ? kept_away : left_out);
    } else {
      text +=
          named_line("NOT MET", fmt::format("{}:{}: {}; seen: {}", result.file, each.line, each.text, each.seen), 0);
    }
  }
  const auto some = [](std::size_t count, const char* words) { return count != 0 ? fmt::format(words, count) : ""; };
  std::string counts;
  if (all != 0 && met == all && implied != 0 && kept == implied)
    return named_line("expectations", fmt::format("{} of {} met; {} of {} slaves in data exchange to the end", met, all,
                                                  kept, implied));
  if (implied != 0)
    counts += named_line("data exchange", fmt::format("{} of {} slaves of masters to the end", kept, implied) +
                                              some(kept_away, ", the script keeps {} away"));
  if (all != 0)
    counts += named_line("expectations", fmt::format("{} of {} met", met, all) + some(left_out, ", {} left out"));
  return counts + text;
}

/// By an expectation that is not met.
bool is_said(const RunResult& result, const SlaveResult& slave) {
  return std::any_of(
      result.expectations.begin(), result.expectations.end(),
      [&slave](const ExpectationResult& each) {
        return each.implied && !each.passed && !each.left_out && each.text.rfind(slave.name + " ", 0) == 0;
      });
}

/// Why each other slave is not in data exchange, according to its master and its chip.
std::string waiting(const RunResult& result) {
  std::string text;
  for (const SlaveResult& slave : result.slaves) {
    if (slave.status.dp_state == profibus::DpState::kDataExch || is_said(result, slave)) continue;
    std::string line = fmt::format("{} is in {}", slave.name, name(slave.status.dp_state));
    if (!slave.master_reason.empty()) line += "; its master: " + slave.master_reason;
    if (!slave.waits_for.empty()) line += "; " + slave.waits_for;
    text += line_of(line);
  }
  return text.empty() ? "" : text + "\n";
}

std::string pacing(const HostLineStatistics& line, const PaceStatistics& pace) {
  std::string text = named_line(
      "host",
      fmt::format("{} telegrams, {} bytes from it, {} bytes to it; {} telegrams held back for T_SYN or the slot "
                  "time, {} at most",
                  line.telegrams, line.sent_bytes, line.heard_bytes, line.held_back,
                  bus::short_time(line.longest_held_back)));
  text += named_line("pacing", fmt::format("simulated behind real time by {:.2f} ms in the mean, {:.2f} ms at most",
                                           pace.error_mean_us() / 1000, pace.error_max_us / 1000));
  if (pace.losses != 0)
    text += named_line(
        "too slow", fmt::format("{} times, simulated time lost {} in total", pace.losses, bus::short_time(pace.lost)));
  return text;
}

std::string boards(const RunResult& result) {
  std::string text;
  for (const SlaveResult& slave : result.slaves) {
    if (!slave.board) continue;
    text += named_line("ARM board",
                       fmt::format("{}: {} instructions, {:.1f} million a second; HCLK {:g} MHz ({})", slave.name,
                                   slave.board->instructions,
                                   static_cast<double>(slave.board->instructions) / 1e6 / std::max(result.wall_s, 1e-9),
                                   static_cast<double>(slave.board->hclk_hz) / 1e6, slave.board->hclk_source));
    for (const std::string& note : slave.board->notes) text += named_line("", note);
  }
  return text + result.fault_registers;
}

std::string socket_text(const SocketUse& use) {
  std::string text = fmt::format("{}", use.accesses);
  if (use.ahead != 0)
    text += fmt::format(", {} ahead of simulation time, by {} at most", use.ahead, bus::short_time(use.furthest));
  if (use.failed != 0) text += fmt::format("; {} without TLM_OK_RESPONSE", use.failed);
  return text;
}

/// Accesses of SystemC platforms; their initiators that did not synchronise.
std::string sockets(const RunResult& result) {
  std::string text;
  for (const SlaveResult& slave : result.slaves) {
    if (!slave.socket) continue;
    const SocketUse& use = *slave.socket;
    text += named_line("accesses", fmt::format("{}: {}", slave.name, socket_text(use)));
    if (use.late_pins != 0)
      text += named_line(
          "not in time",
          fmt::format("{} moved at {}, but accesses up to {} had been carried out; the initiator has to "
                      "wait for its local time first ({} times)",
                      use.late_pin, bus::moment_text(use.late_at), bus::moment_text(use.late_until), use.late_pins));
  }
  return text;
}

/// ": 5.6 times slower than real time".
std::string pace_text(double factor) {
  if (factor <= 0) return "";
  const double times = std::max(factor, 1 / factor);
  return fmt::format(": {:.{}f} times {} than real time", times, times < 10 ? 1 : 0, factor < 1 ? "slower" : "faster");
}

/// Of a run that is not the usual one.
std::string execution(const RunResult& result) {
  if (result.engine == "skip" && result.view == "pins") return "";
  return fmt::format(" (engine {}, view {})", result.engine, result.view);
}

std::string measured(const RunResult& result) {
  std::string text =
      masters(result) +
      named_line("telegrams", fmt::format("{} ({} wrong)", result.telegrams, result.wrong_telegrams)) +
      named_line("simulated", fmt::format("{} in {:.2f} s{}{}", bus::moment_text(result.simulated), result.wall_s,
                                          pace_text(result.real_time_factor()), execution(result)));
  if (result.pacing) text += pacing(result.pacing->line, result.pacing->pace);
  return text + sockets(result) + boards(result);
}

std::string violations(const RunResult& result) {
  if (result.violations == 0) return "";
  const char* judged = result.checks_mode == ChecksMode::kFail
                           ? ""
                           : ", reported by the chip and the bus monitor: judged whatever the mode of the checks";
  return named_line("violations", fmt::format("{} that the scenario does not allow{}", result.violations, judged));
}

}  // namespace

std::string summary(const RunResult& result, CheckRows checks) {
  return fmt::format("\n{}\n\n", bus::printable(result.scenario)) + steps(result) +
         repeated("violated by", result.violated) + repeated("refused by", result.refused) +
         slaves(result, checks == CheckRows::kAll || verdict(result) != Verdict::kPassed) + waiting(result) +
         measured(result) + violations(result) + expectations(result) + check_report(result, checks) +
         fmt::format("\n{}\n", words(result));
}

std::string whole_summary(const RunResult& result) {
  const TableWidth as_wide_as_they_need(TableWidth::kUnlimited);
  return summary(result, CheckRows::kAll);
}

}  // namespace dsdpv1::tb
