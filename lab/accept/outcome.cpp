#include "lab/accept/outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "io/input/units.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::tb::accept {
namespace {

using Need = Met::Need;

/// Of a section, in the run's time.
struct Window {
  Tick from = 0, to = 0;
};

Window window_of(const Section& section, const Facts& facts) {
  constexpr Tick kFirstExchange = 1;  // which belongs to the start
  const Tick begun = facts.begun().value_or(bus::kNever / 2);
  if (section.stimulus->apply == nullptr) return {0, begun + kFirstExchange};
  return {begun + std::max(section.from, kFirstExchange), begun + section.to};
}

std::uint64_t times(const Met& met, const Window& window, const Facts& facts) {
  return std::accumulate(
      met.facts.begin(), met.facts.end(), std::uint64_t{0},
      [&](std::uint64_t sum, const char* fact) { return sum + facts.count(fact, window.from, window.to); });
}

bool is_failed(const Met& met, std::uint64_t times) {
  return met.need == Need::kAlways ? times < met.least : met.need == Need::kNever && times != 0;
}

/// "3 OUTPUTS_FETCHED, 1 INTR0_SERVICE", empty without any.
std::string violations_in(const Window& window, const Facts& facts) {
  std::map<std::string, int> counts;
  for (const Violated& each : facts.violations())
    if (each.at >= window.from && each.at < window.to) ++counts[each.code];
  std::string text;
  for (const auto& [code, count] : counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, code);
  return text;
}

bool can_be(const Met& met, const std::string& mode) {
  if (met.ports == Met::Ports::kOwned) return mode != "uart";
  return met.ports == Met::Ports::kAll || (mode != "uart" && mode != "spi");
}

std::string verdict_on(const Met& met, std::uint64_t count) {
  if (is_failed(met, count)) return met.need == Need::kNever ? "FAILED" : fmt::format("FAILED, expected {}", met.least);
  return met.need == Need::kCounted && count == 0 ? "not met" : "";
}

void add_rows(TextTable& table, const Section& section, const Facts& facts, const std::string& mode) {
  if (section.left_out == kNotAskedFor) return;
  if (!section.left_out.empty()) return table.add({section.stimulus->name, "left out: " + section.left_out, "", ""});
  const Window window = window_of(section, facts);
  const std::string violations = violations_in(window, facts);
  std::string name = section.stimulus->name;
  for (const Met& met : section.stimulus->met) {
    if (!can_be(met, mode)) continue;
    const std::uint64_t count = times(met, window, facts);
    std::string verdict = verdict_on(met, count);
    if (!name.empty() && !violations.empty()) verdict += (verdict.empty() ? "" : "; ") + ("VIOLATED: " + violations);
    if (!name.empty() && verdict.empty()) verdict = "ok";
    table.add({std::exchange(name, ""), met.words, std::to_string(count), verdict});
  }
}

}  // namespace

void judge(RunResult& result, const Plan& plan, const Facts& facts) {
  for (const Section& section : plan.sections) {
    if (!section.left_out.empty()) continue;
    for (const Met& met : section.stimulus->met) {
      if (met.need == Need::kCounted) continue;
      const std::uint64_t count = times(met, window_of(section, facts), facts);
      ExpectationResult expectation;
      expectation.text = fmt::format("{}: {} {}", section.stimulus->name, met.words,
                                     met.need == Need::kNever ? "never" : fmt::format("at least {}", met.least));
      expectation.passed = !is_failed(met, count);
      expectation.seen = fmt::format("{} times", count);
      expectation.line = section.line;
      result.expectations.push_back(std::move(expectation));
    }
  }
}

std::string table(const Plan& plan, const Facts& facts) {
  TextTable table({"stimulus", "met", "times", "verdict"});
  for (const Section& section : plan.sections) add_rows(table, section, facts, plan.mode);
  return table.text();
}

}  // namespace dsdpv1::tb::accept
