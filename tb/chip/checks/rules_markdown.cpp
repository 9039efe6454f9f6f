#include "tb/chip/checks/rules_markdown.hpp"

#include <fmt/format.h>

#include <regex>

namespace dsdpv1::checks {
namespace {

std::string limit_text(const Rule& rule) {
  if (rule.bound == Bound::kRule) return "-";
  const char* const word = rule.bound == Bound::kMin ? "at least" : "at most";
  if (rule.limit == kNoLimit) return fmt::format("{}: none", word);
  if (rule.bound == Bound::kMost) return fmt::format("{} {}", word, rule.limit);
  const Tick thousandths = rule.limit * 1000 / bus::kTicksPerNs;
  std::string number = fmt::format("{}.{:03}", thousandths / 1000, thousandths % 1000);
  number.erase(number.find_last_not_of('0') + 1);
  if (number.back() == '.') number.pop_back();
  return fmt::format("{} {} ns", word, number);
}

/// A clause with the rulings in it as links to their places.
std::string linked(const std::string& clause, RulingPlace place) {
  static const std::regex ruling("\\b(?:R|SP|UA|[APHDSUVX])[0-9]+\\b");
  std::string text;
  auto rest = clause.begin();
  for (std::sregex_iterator each(clause.begin(), clause.end(), ruling), end; each != end; ++each) {
    text += each->prefix().str() + fmt::format("[{}]({})", each->str(), place(each->str()));
    rest = (*each)[0].second;
  }
  return text + std::string(rest, clause.end());
}

std::string section(const Rule& rule) {
  std::string text = fmt::format("\n### {}\n\n{} ({}).\n\n", rule.id, rule.rule, rule.clause);
  if (rule.bound != Bound::kRule)
    text += fmt::format("- measured: {}\n- default limit: {} ({})\n", rule.formula, limit_text(rule), rule.source);
  return text + fmt::format("- what to do: {}\n", rule.advice);
}

}  // namespace

std::string rules_markdown(const RuleTable& rules, RulingPlace place) {
  std::string text = "\n| check | clause | default limit |\n|---|---|---|\n";
  for (const Rule& each : rules)
    text += fmt::format("| `{}` | {} | {} |\n", each.id, linked(each.clause, place), limit_text(each));
  for (const Rule& each : rules) text += section(each);
  return text;
}

}  // namespace dsdpv1::checks
