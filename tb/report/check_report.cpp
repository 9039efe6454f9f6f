#include "tb/report/check_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "tb/report/text_table.hpp"

namespace dsdpv1::tb {
namespace {

/// One check on all slaves.
struct Row {
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
  for (const CheckResult& each : result.checks) {
    if (each.rule != rule) continue;
    row.count += each.record.count;
    row.violations += each.record.violations;
    row.allowed += each.allowed;
    if (row.worst == nullptr || is_worse(each, *row.worst)) row.worst = &each;
  }
  return row;
}

std::string worst_text(const checks::Record& record) {
  if (record.worst_margin) return checks::ns_text(*record.worst_margin);
  return record.worst_value ? checks::ns_text(*record.worst_value) + " measured, no limit" : "-";
}

std::string at_text(const CheckResult& worst) {
  if (!worst.record.at) return "";
  return fmt::format("{:.3f} us at {}", static_cast<double>(*worst.record.at) / static_cast<double>(bus::kTicksPerUs),
                     worst.slave);
}

std::string violations_text(const Row& row) {
  return row.allowed == 0 ? fmt::format("{}", row.violations)
                          : fmt::format("{} ({} allowed)", row.violations, row.allowed);
}

std::string first_violation(const CheckResult& result) {
  const checks::Violation& first = result.listed.front();
  std::string text = fmt::format("  {} at {:.3f} us ({}): {}\n    {}\n    pins: {}\n", result.rule->id,
                                 static_cast<double>(first.at) / static_cast<double>(bus::kTicksPerUs), result.slave,
                                 first.text, result.rule->rule, checks::history_text(first));
  if (result.record.violations > 1)
    text += fmt::format("    ... and {} more, see --log and --result\n", result.record.violations - 1);
  return text;
}

}  // namespace

std::string check_report(const RunResult& result) {
  if (result.checks.empty()) return "";
  TextTable table({"check", "count", "violations", "worst margin", "when"});
  for (const CheckResult& first : result.checks) {
    if (first.slave != result.checks.front().slave) break;  // every slave has the same checks
    const Row row = row_of(result, first.rule);
    if (row.count == 0) continue;
    table.add({first.rule->id, fmt::format("{}", row.count), violations_text(row), worst_text(row.worst->record),
               at_text(*row.worst)});
  }
  std::string text = "\n" + table.text();
  for (const CheckResult& each : result.checks)
    if (!each.listed.empty()) text += first_violation(each);
  return text;
}

}  // namespace dsdpv1::tb
