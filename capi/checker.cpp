// The rules of a chip's user side on any pins.
#include "capi/names.hpp"
#include "dsdpv1/checks.h"

#include <memory>

#include "bus/telegram/telegram.hpp"
#include "capi/changes.hpp"
#include "capi/clock.hpp"
#include "capi/kind.hpp"
#include "capi/sized.hpp"

using capi::fail;
using capi::guarded;
using capi::need;
using capi::Tick;

struct dpsim_checker {
  explicit dpsim_checker(const capi::Kind& its_kind, const checks::Limits& limits)
      : kind(its_kind), checks(its_kind.chip.make_checks(limits, nullptr)) {
    checks->on_violation([this](const checks::Violation& violation) { tell(violation); });
  }
  void tell(const checks::Violation& violation);
  /// Advances the present tick.
  Tick at(std::uint64_t tick) {
    if (finished) fail(DPSIM_ERR_STATE, "the checker is finished");
    return clock.now = capi::tick_from(tick, clock.now);
  }

  const capi::Kind& kind;
  std::unique_ptr<checks::ChipChecks> checks;
  capi::Clock clock;
  bool finished = false;
  dpsim_violation_fn fn = nullptr;
  void* user = nullptr;
};

void dpsim_checker::tell(const checks::Violation& violation) {
  if (fn == nullptr) return;
  const checks::Rule& rule = kind.chip.rules()[violation.check.index];
  const std::string pins = checks::history_text(violation);
  dpsim_violation told{};
  told.tick = static_cast<std::uint64_t>(violation.at);
  told.found = static_cast<std::uint64_t>(violation.found);
  told.margin = violation.margin.value_or(0);
  told.rule = static_cast<std::uint32_t>(violation.check.index);
  told.has_margin = violation.margin ? 1 : 0;
  told.name = rule.id;
  told.text = violation.text.c_str();
  told.pins = pins.c_str();
  const capi::Callback inside(clock);
  fn(user, &told);
}

namespace {

const checks::RuleTable& rules_of(const char* kind) { return capi::kind_of(kind).chip.rules(); }

const checks::Rule& rule_at(const checks::RuleTable& rules, std::size_t number) {
  if (number >= rules.size())
    fail(DPSIM_ERR_NOT_FOUND,
         "rule is " + std::to_string(number) + ", expected 0 to " + std::to_string(rules.size() - 1));
  return rules[number];
}

std::size_t find_rule(const checks::RuleTable& rules, const char* name) {
  need(name, "name of a rule");
  for (std::size_t i = 0; i < rules.size(); ++i)
    if (std::string(rules[i].id) == name) return i;
  fail(DPSIM_ERR_NOT_FOUND, "there is no rule \"" + std::string(name) + "\"");
}

checks::Limits limits_of(const dpsim_checker_options& options, const checks::RuleTable& rules) {
  capi::need_buffer(options.limits, options.limit_count, "limits");
  checks::Limits limits(rules);
  for (std::uint32_t i = 0; i < options.limit_count; ++i) {
    const dpsim_limit& own = options.limits[i];
    const checks::CheckId check(find_rule(rules, own.rule));
    limits[check].on = own.off == 0;
    if (rules[check.index].bound != checks::Bound::kRule) limits[check].value = own.value;
  }
  return limits;
}

void feed(dpsim_checker& checker, std::uint64_t tick, std::uint16_t pin, dpsim_level level) {
  const tb::PinTable& pins = checker.kind.chip.pins();
  if (pin >= pins.size())
    fail(DPSIM_ERR_NOT_FOUND, "pin is " + std::to_string(pin) + ", expected 0 to " + std::to_string(pins.size() - 1));
  capi::need_range(pins[pin].name, level, DPSIM_X, (1 << pins[pin].width) - 1);
  checker.checks->pin(checker.at(tick), static_cast<tb::PinNumber>(pin), level);
}

bus::WireTelegram telegram_of(const dpsim_heard& heard) {
  capi::need_buffer(heard.bytes, heard.count, "bytes of heard");
  capi::need_range("baud", heard.baud, 0, bus::kBaudCount - 1);
  bus::WireTelegram telegram;
  telegram.start = capi::tick_in(heard.start);
  telegram.end = capi::tick_in(heard.end);
  telegram.baud = heard.baud;
  if (heard.count != 0) telegram.decoded = bus::decode(bus::Bytes(heard.bytes, heard.bytes + heard.count));
  telegram.character_errors = heard.character_errors != 0;
  if (heard.tsdr != DPSIM_NEVER) telegram.tsdr = capi::tick_in(heard.tsdr);
  telegram.station = heard.station;
  return telegram;
}

dpsim_rule_info info_of(const checks::Rule& rule) {
  dpsim_rule_info info{};
  info.bound = static_cast<dpsim_bound>(rule.bound);
  info.name = rule.id;
  info.rule = rule.rule;
  info.clause = rule.clause;
  info.advice = rule.advice;
  info.limit = rule.limit;
  return info;
}

dpsim_check_result result_of(const checks::Record& record) {
  dpsim_check_result result{};
  result.has_margin = record.worst_margin ? 1 : 0;
  result.has_value = record.worst_value ? 1 : 0;
  result.count = record.count;
  result.violations = record.violations;
  result.worst_margin = record.worst_margin.value_or(0);
  result.worst_value = record.worst_value.value_or(0);
  result.at = record.at ? static_cast<std::uint64_t>(*record.at) : DPSIM_NEVER;
  return result;
}

}  // namespace

size_t dpsim_rule_count(const char* kind) {
  const capi::Kind* found = capi::find_kind(kind);
  return found == nullptr ? 0 : found->chip.rules().size();
}

dpsim_status dpsim_rule_get(const char* kind, size_t rule, dpsim_rule_info* info) {
  return guarded(
      __func__, [&] { capi::give(info_of(rule_at(rules_of(kind), rule)), info, "info"); });
}

dpsim_status dpsim_rule_find(const char* kind, const char* name, size_t* rule) {
  return guarded(
      __func__,
      [&] {
        need(rule, "rule");
        *rule = find_rule(rules_of(kind), name);
      });
}

dpsim_status dpsim_checker_create(const dpsim_checker_options* options, dpsim_checker** checker) {
  return guarded(
      __func__,
      [&] {
        need(checker, "checker");
        const dpsim_checker_options given = capi::options_of(options, "options");
        const capi::Kind& kind = capi::kind_of(given.kind);
        if (kind.chip.rules().size() == 0)
          fail(DPSIM_ERR_UNSUPPORTED, "there are no checks of the user of a chip of this kind");
        *checker = std::make_unique<dpsim_checker>(kind, limits_of(given, kind.chip.rules())).release();
      });
}

void dpsim_checker_destroy(dpsim_checker* checker) { delete checker; }

dpsim_status dpsim_checker_wants(const dpsim_checker* checker, uint64_t* pins) {
  return guarded(
      __func__,
      [&] {
        need(checker, "checker");
        need(pins, "pins");
        *pins = checker->kind.chip.checked_pins();
      });
}

dpsim_status dpsim_checker_pin(dpsim_checker* checker, uint64_t tick, uint16_t pin, dpsim_level level) {
  return guarded(
      __func__,
      [&] {
        need(checker, "checker");
        capi::need_outside(checker->clock);
        feed(*checker, tick, pin, level);
      });
}

dpsim_status dpsim_checker_pins(dpsim_checker* checker, const dpsim_change* changes, size_t count, size_t* done) {
  std::size_t number = 0;
  const dpsim_status status = guarded(__func__, [&] {
    need(checker, "checker");
    capi::need_buffer(changes, count, "changes");
    capi::need_outside(checker->clock);
    for (; number < count; ++number) feed(*checker, changes[number].tick, changes[number].pin, changes[number].level);
  });
  if (done != nullptr) *done = number;
  return status;
}

dpsim_status dpsim_checker_sample(dpsim_checker* checker, uint64_t sample) {
  return guarded(
      __func__,
      [&] {
        need(checker, "checker");
        capi::need_outside(checker->clock);
        if (checker->finished) fail(DPSIM_ERR_STATE, "the checker is finished");
        checker->checks->read(capi::tick_from(sample, checker->clock.now));
      });
}

dpsim_status dpsim_checker_telegram(dpsim_checker* checker, const dpsim_heard* heard) {
  return guarded(
      __func__,
      [&] {
        need(checker, "checker");
        need(heard, "heard");
        capi::need_outside(checker->clock);
        const bus::WireTelegram telegram = telegram_of(*heard);
        checker->checks->telegram(checker->at(heard->end), telegram);
      });
}

dpsim_status dpsim_checker_finish(dpsim_checker* checker, uint64_t tick) {
  return guarded(
      __func__,
      [&] {
        need(checker, "checker");
        capi::need_outside(checker->clock);
        checker->checks->finish(checker->at(tick));
        checker->finished = true;
      });
}

dpsim_status dpsim_checker_on_violation(dpsim_checker* checker, dpsim_violation_fn fn, void* user) {
  return guarded(
      __func__,
      [&] {
        need(checker, "checker");
        capi::need_outside(checker->clock);
        checker->fn = fn;
        checker->user = user;
      });
}

dpsim_status dpsim_checker_get_result(const dpsim_checker* checker, size_t rule, dpsim_check_result* result) {
  return guarded(
      __func__,
      [&] {
        need(checker, "checker");
        rule_at(checker->kind.chip.rules(), rule);
        capi::give(result_of(checker->checks->record(checks::CheckId(rule))), result, "result");
      });
}
