#include "tb/report/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bus/printable.hpp"
#include "io/input/units.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/report/check_report.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::tb {
namespace {

std::string microseconds(Tick tick) {
  return fmt::format("{:.3f}", static_cast<double>(tick) / static_cast<double>(bus::kTicksPerUs));
}

/// The steps from power-on to data exchange.
bool is_step(const Occurrence& each) {
  static constexpr std::array<const char*, 9> kSteps = {"READY_FLAG", "INITIALISED", "BAUD_SEARCH",
                                                        "BAUD_FOUND", "BAUD_LOST",   "DP_STATE",
                                                        "WD_ON",      "WD_EXPIRED",  "ADDRESS"};
  return std::any_of(kSteps.begin(), kSteps.end(), [&each](const char* code) { return each.code == code; });
}

std::string steps(const RunResult& result) {
  constexpr std::size_t kMost = 40;
  TextTable table({"time / us", "station", "what"});
  std::size_t shown = 0, hidden = 0;
  for (const Occurrence& each : result.occurrences) {
    if (!is_step(each)) continue;
    if (shown == kMost) {
      ++hidden;
      continue;
    }
    ++shown;
    table.add({fmt::format("{:>13}", microseconds(each.at)), each.station, each.text});
  }
  if (shown == 0) return "";
  return table.text() + (hidden != 0 ? fmt::format("  ... and {} more, see --log and --result\n", hidden) : "") + "\n";
}

/// A row for each station, code and place: nobody should need the log to find that out.
std::string repeated(const char* head, const std::vector<Repeated>& all) {
  constexpr std::size_t kMost = 40;
  if (all.empty()) return "";
  TextTable table({head, "reason", "times", "first / us", "last / us", "what, the first time"});
  const std::size_t shown = std::min(all.size(), kMost);
  for (std::size_t i = 0; i < shown; ++i) {
    const Repeated& each = all[i];
    table.add({each.station, each.code + (each.place.empty() ? "" : " (" + each.place + ")"),
               fmt::format("{}{}", each.count, each.allowed ? " allowed" : ""), microseconds(each.first),
               microseconds(each.last), each.text});
  }
  const std::size_t hidden = all.size() - shown;
  return table.text() + (hidden != 0 ? fmt::format("  ... and {} more, see --result\n", hidden) : "") +
         "  dsdpv1-sim reasons REASON says what to do\n\n";
}

std::string tsdr(const SlaveResult& slave) {
  return slave.tsdr.answers == 0 ? "-" : fmt::format("{:.2f} .. {:.2f}", slave.tsdr.min_bits, slave.tsdr.max_bits);
}

std::string slaves(const RunResult& result) {
  TextTable table({"slave", "address", "DP state", "baud", "exchanges", "overwritten", "TSDR / bit times",
                   "chip waited / us", "user waited / us", "longest hold / us"});
  for (const SlaveResult& slave : result.slaves) {
    table.add({slave.name, fmt::format("{}", slave.status.address), name(slave.status.dp_state),
               baud_text(slave.status.baud), fmt::format("{}", slave.status.data_exchanges),
               fmt::format("{}", slave.status.outputs_missed), tsdr(slave), microseconds(slave.status.longest_wait),
               microseconds(slave.user.port.longest_wait), microseconds(slave.user.port.longest_hold)});
  }
  return table.text() + "\n";
}

std::string interval_from(const MasterResult& master) {
  if (master.interval_given) return "min_slave_interval of the scenario";
  return master.min_slave_interval_us == 0 ? "its slaves name no Min_Slave_Intervall"
                                           : "Min_Slave_Intervall of its slaves";
}

std::string masters(const RunResult& result) {
  std::string text;
  for (const MasterResult& master : result.masters) {
    const std::string interval = master.min_slave_interval_us == 0
                                     ? "as fast as the bus allows"
                                     : fmt::format("{}us or more each", master.min_slave_interval_us);
    text += fmt::format("  master         {}: {} cycles, {} ({})\n", master.name, master.cycles, interval,
                        interval_from(master));
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
      text += "  NOT MET  " +
              bus::printable(fmt::format("{}:{}: {}; seen: {}", result.file, each.line, each.text, each.seen)) + "\n";
    }
  }
  const std::string own = all == 0 ? ""
                                   : fmt::format("  expectations   {} of {} met{}\n", met, all,
                                                 left_out != 0 ? fmt::format(", {} left out", left_out) : "");
  const std::string of_masters =
      implied == 0 ? ""
                   : fmt::format("  data exchange  {} of {} slaves of masters to the end{}\n", kept, implied,
                                 kept_away != 0 ? fmt::format(", the script keeps {} away", kept_away) : "");
  return of_masters + own + text;
}

/// By an expectation that is not met.
bool is_said(const RunResult& result, const SlaveResult& slave) {
  return std::any_of(
      result.expectations.begin(), result.expectations.end(),
      [&slave](const ExpectationResult& each) {
        return each.implied && !each.passed && !each.left_out && each.text.rfind(slave.name + " ", 0) == 0;
      });
}

/// Of each other slave that is not in data exchange: why not, as its master and its chip have it.
std::string waiting(const RunResult& result) {
  std::string text;
  for (const SlaveResult& slave : result.slaves) {
    if (slave.status.dp_state == profibus::DpState::kDataExch || is_said(result, slave)) continue;
    text += fmt::format("  {} is in {}", slave.name, name(slave.status.dp_state));
    if (!slave.master_reason.empty()) text += "; its master: " + bus::printable(slave.master_reason);
    if (!slave.waits_for.empty()) text += "; " + bus::printable(slave.waits_for);
    text += "\n";
  }
  return text.empty() ? "" : text + "\n";
}

std::string pacing(const HostLineStatistics& line, const PaceStatistics& pace) {
  const auto ms = [](double us) { return us / 1000; };
  std::string text = fmt::format(
      "  host           {} telegrams, {} bytes from it, {} bytes to it; {} telegrams held back for T_SYN or the slot "
      "time, {} at most\n",
      line.telegrams, line.sent_bytes, line.heard_bytes, line.held_back,
      fmt::format("{:.2f} ms",
                  ms(static_cast<double>(line.longest_held_back) / static_cast<double>(bus::kTicksPerUs))));
  text += fmt::format("  pacing         simulated behind real time by {:.2f} ms in the mean, {:.2f} ms at most\n",
                      ms(pace.error_mean_us()), ms(pace.error_max_us));
  if (pace.losses != 0)
    text += fmt::format("  too slow       {} times, simulated time lost {} in total\n", pace.losses,
                        time_text(pace.lost / bus::kTicksPerMs * bus::kTicksPerMs));
  return text;
}

std::string boards(const RunResult& result) {
  std::string text;
  for (const SlaveResult& slave : result.slaves) {
    if (!slave.board) continue;
    text += fmt::format("  ARM board      {}: {} instructions, {:.1f} million a second; HCLK {:g} MHz ({})\n",
                        slave.name, slave.board->instructions,
                        static_cast<double>(slave.board->instructions) / 1e6 / std::max(result.wall_s, 1e-9),
                        static_cast<double>(slave.board->hclk_hz) / 1e6, slave.board->hclk_source);
    for (const std::string& note : slave.board->notes)
      text += fmt::format("                 {}\n", bus::printable(note));
  }
  return text + result.fault_registers;
}

}  // namespace

std::string summary(const RunResult& result) {
  std::string text = fmt::format("\n{}\n\n", bus::printable(result.scenario)) + steps(result) +
                     repeated("violated by", result.violated) + repeated("refused by", result.refused) +
                     slaves(result) + waiting(result);
  text += masters(result);
  text += fmt::format("  telegrams      {} ({} wrong)\n", result.telegrams, result.wrong_telegrams);
  text +=
      fmt::format("  simulated      {} in {:.2f} s: {:.2f} times real time (engine {}, view {})\n",
                  time_text(result.simulated), result.wall_s, result.real_time_factor(), result.engine, result.view);
  if (result.pacing) text += pacing(result.pacing->line, result.pacing->pace);
  text += boards(result);
  if (result.violations != 0)
    text += fmt::format("  violations     {} that the scenario does not allow{}\n", result.violations,
                        result.checks_mode == ChecksMode::kFail
                            ? ""
                            : ", reported by the chip and the bus monitor: judged whatever the mode of the checks");
  text += expectations(result) + check_report(result);
  return text + fmt::format("\n{}\n", words(result));
}

}  // namespace dsdpv1::tb
