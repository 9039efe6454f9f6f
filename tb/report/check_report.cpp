#include "tb/report/check_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/time_text.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::tb {
namespace {

/// One check on all slaves.
struct Row {
  const checks::Rule* rule = nullptr;
  std::uint64_t count = 0, violations = 0, allowed = 0;
  const CheckResult* worst = nullptr;
};

bool is_worse(const CheckResult& a, const CheckResult& b) {
  const checks::Record &x = a.record, &y = b.record;
  if (x.worst_margin && y.worst_margin) return *x.worst_margin < *y.worst_margin;
  if (x.worst_value && y.worst_value) return *x.worst_value > *y.worst_value;
  return x.at && (!y.at || *x.at < *y.at);
}

Row row_of(const RunResult& result, const checks::Rule* rule) {
  Row row;
  row.rule = rule;
  for (const CheckResult& each : result.checks) {
    if (each.rule != rule) continue;
    row.count += each.record.count;
    row.violations += each.record.violations;
    row.allowed += each.allowed;
    if (row.worst == nullptr || is_worse(each, *row.worst)) row.worst = &each;
  }
  return row;
}

/// A row for each check that was evaluated.
std::vector<Row> rows_of(const RunResult& result) {
  std::vector<Row> rows;
  for (const CheckResult& first : result.checks) {
    if (first.slave != result.checks.front().slave) break;  // every slave has the same checks
    if (const Row row = row_of(result, first.rule); row.count != 0) rows.push_back(row);
  }
  return rows;
}

/// " at demo"; nothing where there is one slave only.
std::string at_slave(const RunResult& result, const CheckResult& check) {
  return result.slaves.size() > 1 ? " at " + check.slave : "";
}

std::string tightest(const RunResult& result, const std::vector<Row>& rows) {
  const Row* least = nullptr;
  for (const Row& row : rows)
    if (row.worst->record.worst_margin &&
        (least == nullptr || *row.worst->record.worst_margin < *least->worst->record.worst_margin))
      least = &row;
  if (least == nullptr) return "";
  const checks::Record& record = least->worst->record;
  return fmt::format(", {} by only {} at {}{}", least->rule->id, bus::short_time(*record.worst_margin),
                     bus::moment_text(*record.at), at_slave(result, *least->worst));
}

std::string headline(const RunResult& result, const std::vector<Row>& rows) {
  const auto is_kept = [](const Row& row) { return row.violations == 0; };
  const auto kept = static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), is_kept));
  if (rows.empty()) return named_line("checks", "none was evaluated");
  if (kept == rows.size()) return named_line("checks", fmt::format("all {} kept{}", kept, tightest(result, rows)));
  return named_line("checks", fmt::format("{} of {} kept", kept, rows.size()));
}

std::string value_or_dash(const checks::Rule& rule, std::optional<Tick> value) {
  return value ? value_text(rule, *value) : "-";
}

/// With several slaves a column names the one with the worst value.
std::string table_of(const RunResult& result, const std::vector<Row>& rows) {
  if (rows.empty()) return "";
  const bool several = result.slaves.size() > 1;
  std::vector<std::string> head = {"check", "count", "violated", "allowed", "margin", "measured", "when"};
  if (several) head.emplace_back("slave");
  TextTable table(head);
  for (const Row& row : rows) {
    const checks::Record& worst = row.worst->record;
    const auto number = [](std::uint64_t count) { return fmt::format("{}", count); };
    std::vector<std::string> cells = {row.rule->id,
                                      number(row.count),
                                      number(row.violations),
                                      number(row.allowed),
                                      value_or_dash(*row.rule, worst.worst_margin),
                                      value_or_dash(*row.rule, worst.worst_value),
                                      worst.at ? bus::moment_text(*worst.at) : "-"};
    if (several) cells.push_back(row.worst->slave);
    table.add(cells);
  }
  return "\n" + table.text();
}

/// A line for each pin: its last levels, each with the time from the violation.
std::string pins_of(const checks::Violation& violation) {
  std::vector<std::pair<std::string, std::string>> lines;
  std::size_t columns = 0;
  for (const checks::PinChange& change : violation.history) {
    const std::string name = std::string("  ") + change.pin->name;
    auto line = std::find_if(lines.begin(), lines.end(), [&name](const auto& each) { return each.first == name; });
    if (line == lines.end()) line = lines.insert(line, {name, ""});
    line->second += fmt::format("{}{} {}", line->second.empty() ? "" : ", ", level_text(*change.pin, change.level),
                                bus::short_time(change.at - violation.at));
    columns = std::max(columns, name.size());
  }
  std::string text;
  for (const auto& [name, levels] : lines) text += named_line(name, levels, columns);
  return text;
}

std::string first_violation(const RunResult& result, const CheckResult& check) {
  const checks::Violation& first = check.listed.front();
  std::string text = "\n" + line_of(fmt::format("{} at {}{}: {}", check.rule->id, bus::moment_text(first.at),
                                                at_slave(result, check), with_place(first.text, first.where)));
  text += named_line("", check.rule->rule, 0) + pins_of(first);
  if (check.record.violations > 1)
    text += named_line("", fmt::format("... and {} more, see --log and --result", check.record.violations - 1), 0);
  return text;
}

}  // namespace

std::string check_report(const RunResult& result, CheckRows wanted) {
  if (result.checks.empty()) return "";
  std::vector<Row> rows = rows_of(result);
  std::string text = headline(result, rows);
  const auto is_left_out = [wanted](const Row& row) { return wanted == CheckRows::kViolated && row.violations == 0; };
  rows.erase(std::remove_if(rows.begin(), rows.end(), is_left_out), rows.end());
  text += table_of(result, rows);
  for (const CheckResult& each : result.checks)
    if (!each.listed.empty()) text += first_violation(result, each);
  return text;
}

}  // namespace dsdpv1::tb
