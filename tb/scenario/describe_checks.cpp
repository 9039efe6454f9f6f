// Keys of the checks: one per check of the chip, with its settings.
#include "tb/scenario/describe.hpp"

namespace dsdpv1::tb::scenario {
namespace {

using checks::Bound;

/// A scenario's setting for one check.
struct CheckLimit {
  std::optional<bus::Tick> min, max;
  bool enabled = true;
  int line = 0;
};

ObjectOf<CheckLimit> limit_keys(const char* name, const char* doc) {
  ObjectOf<CheckLimit> o(name, doc);
  o.boolean("enabled", &CheckLimit::enabled, "false: the check is not made.");
  return o;
}

constexpr Range kLimits = {-kLongestTime, kLongestTime};

const ObjectOf<CheckLimit>& least_keys() {
  static const ObjectOf<CheckLimit> keys = [] {
    ObjectOf<CheckLimit> o =
        limit_keys("check with a least value", "A check whose measured value must not be less than a limit.");
    o.time("min", &CheckLimit::min, kLimits, "The limit (default: that of docs/checks.md).");
    return o;
  }();
  return keys;
}

const ObjectOf<CheckLimit>& greatest_keys() {
  static const ObjectOf<CheckLimit> keys = [] {
    ObjectOf<CheckLimit> o =
        limit_keys("check with a greatest value", "A check whose measured value must not exceed a limit.");
    o.time("max", &CheckLimit::max, kLimits, "The limit (default: that of docs/checks.md).");
    return o;
  }();
  return keys;
}

const ObjectOf<CheckLimit>& number_keys() {
  static const ObjectOf<CheckLimit> keys = [] {
    ObjectOf<CheckLimit> o =
        limit_keys("check with a greatest number", "A check whose number must not exceed a limit.");
    o.integer("max", &CheckLimit::max, {0, 1'000'000}, "", "The limit (default: that of docs/checks.md).");
    return o;
  }();
  return keys;
}

const ObjectOf<CheckLimit>& rule_keys() {
  static const ObjectOf<CheckLimit> keys =
      limit_keys("check without a value", "A check without a value: its rule is kept or not.");
  return keys;
}

const ObjectOf<CheckLimit>& keys_of(Bound bound) {
  switch (bound) {
    case Bound::kMin: return least_keys();
    case Bound::kMax: return greatest_keys();
    case Bound::kMost: return number_keys();
    case Bound::kRule: break;
  }
  return rule_keys();
}

keys::Field field_of(const checks::Rule& rule, checks::CheckId check) {
  keys::Field field;
  field.name = rule.id;
  field.type.kind = keys::Kind::kObject;
  field.type.object = &keys_of(rule.bound);
  field.doc = std::string(rule.rule) + " (" + rule.clause + ").";
  field.read = [check, &described = *field.type.object](void* owner, const YAML::Node& node,
                                                        const keys::Source& source) {
    CheckLimit said;
    keys::read_object(described, &said, node, source);
    checks::Limit& limit = (*static_cast<Checks*>(owner))[check];
    limit.on = said.enabled;
    if (said.min) limit.value = *said.min;
    if (said.max) limit.value = *said.max;
  };
  return field;
}

ObjectOf<Checks> describe_checks(const ChipKind& kind) {
  ObjectOf<Checks> o("checks",
                     "The checks on the user's side, see docs/checks.md: the effect of a violation, and a key for the "
                     "limits of each check.");
  const checks::RuleTable& rules = kind.rules();
  o.word("mode", &Checks::mode,
         std::vector<WordFor<ChecksMode>>{
             {ChecksMode::kFail, "fail", "the run fails"},
             {ChecksMode::kReport, "report", "listed; the verdict says how many were not judged"},
             {ChecksMode::kOff, "off", "nothing is checked, and the verdict says so"}},
         "Effect of a violation that `allow` does not list. The option `--checks` overrides it.");
  for (std::size_t i = 0; i < rules.size(); ++i) o.fields.push_back(field_of(rules[i], checks::CheckId(i)));
  return o;
}

}  // namespace

const ObjectOf<Checks>& check_keys(const ChipKind& kind) { return per_kind<Checks>(kind, describe_checks); }

}  // namespace dsdpv1::tb::scenario
