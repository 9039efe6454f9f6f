// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// The checks of docs/checks.md on packed pins. With a rate, a bus beside them hears the telegrams on PBRXD and PBTXD.
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <vector>

#include "bindings/simulator/object.hpp"
#include "bindings/simulator/options.hpp"
#include "bindings/simulator/pins.hpp"
#include "bindings/simulator/simulator.h"

namespace dsdpv1::simulator {
namespace {

constexpr uint32_t kPbrxd = 1U << 26U, kPbtxd = 1U << 3U, kPbrts = 1U << 4U;

class Checker final : public Object {
 public:
  Checker(const char* options, int32_t baud);
  ~Checker() override;
  Checker(const Checker&) = delete;
  Checker& operator=(const Checker&) = delete;

  void step(uint64_t tick, uint32_t inputs, uint32_t outputs);
  void finish();
  int32_t violations() const { return violations_; }
  uint64_t applied() const;

 private:
  void make_bus(int32_t baud);
  void hear(uint32_t inputs, uint32_t outputs);
  void feed_telegrams(uint64_t until);
  void feed(uint16_t pin, dpsim_level level) { check(dpsim_checker_pin(checker_, now_, pin, level)); }
  static void violated(void* self, const dpsim_violation* violation);
  static void heard(void* self, const dpsim_heard* telegram);

  /// A telegram is known in its last stop bit, before its end: it waits for the pins that change until then.
  struct Waiting {
    dpsim_heard heard;
    std::vector<uint8_t> bytes;
  };

  dpsim_checker* checker_ = nullptr;
  dpsim_bus* bus_ = nullptr;
  std::deque<Waiting> telegrams_;
  uint16_t others_ = 0, chip_ = 0;
  uint64_t now_ = 0;
  uint32_t inputs_ = kInputsAtReset, outputs_ = 0;
  int32_t violations_ = 0;
  bool finished_ = false;
};

uint32_t outputs_at_reset() {
  uint32_t pins = 0;
  for (const PinPlace& place : kOutputs) {
    dpsim_pin_info info{};
    info.size = sizeof info;
    check(dpsim_pin_get(nullptr, place.pin, &info));
    pins = with_output(pins, place, info.reset_level);
  }
  return pins;
}

Checker::Checker(const char* options, int32_t baud) : outputs_(outputs_at_reset()) {
  const std::vector<Option> words = options_of(options);
  std::vector<dpsim_limit> limits;
  limits.reserve(words.size());
  for (const Option& each : words) {
    const bool off = each.value == "off";
    limits.push_back({each.name.c_str(), off ? 0 : number_of(each, 0, INT64_MAX), off ? 1 : 0, 0});
  }
  dpsim_checker_options chosen{};
  chosen.size = sizeof chosen;
  chosen.limits = limits.data();
  chosen.limit_count = static_cast<uint32_t>(limits.size());
  check(dpsim_checker_create(&chosen, &checker_));
  check(dpsim_checker_on_violation(checker_, violated, this));
  if (baud >= 0) make_bus(baud);
}

Checker::~Checker() {
  dpsim_checker_destroy(checker_);
  dpsim_bus_destroy(bus_);
}

void Checker::make_bus(int32_t baud) {
  dpsim_bus_options options{};
  options.size = sizeof options;
  options.baud = baud;
  check(dpsim_bus_create(&options, &bus_));
  check(dpsim_bus_add_station(bus_, "line", &others_));
  check(dpsim_bus_add_station(bus_, "chip", &chip_));
  check(dpsim_bus_on_telegram(bus_, heard, this));
}

void Checker::violated(void* self, const dpsim_violation* violation) {
  auto* checker = static_cast<Checker*>(self);
  ++checker->violations_;
  dpsim_rule_info rule{};
  rule.size = sizeof rule;
  check(dpsim_rule_get(nullptr, violation->rule, &rule));
  checker->say(fmt::format("{} at {}: {} [{}]\n  pins        {}\n  what to do  {}", violation->name,
                           time_text(violation->tick), violation->text, rule.clause, violation->pins, rule.advice));
}

void Checker::heard(void* self, const dpsim_heard* telegram) {
  static_cast<Checker*>(self)->telegrams_.push_back({*telegram, {telegram->bytes, telegram->bytes + telegram->count}});
}

void Checker::feed_telegrams(uint64_t until) {
  for (; !telegrams_.empty() && telegrams_.front().heard.end <= until; telegrams_.pop_front()) {
    Waiting& first = telegrams_.front();
    first.heard.bytes = first.bytes.data();
    check(dpsim_checker_telegram(checker_, &first.heard));
  }
}

void Checker::hear(uint32_t inputs, uint32_t outputs) {
  if (bus_ == nullptr) return;
  check(dpsim_bus_drive(bus_, now_, others_, (inputs & kPbrxd) == 0, 0));
  check(dpsim_bus_drive(bus_, now_, chip_, (outputs & kPbrts) != 0, (outputs & kPbtxd) != 0));
}

void Checker::step(uint64_t tick, uint32_t inputs, uint32_t outputs) {
  now_ = std::max(now_, tick);
  hear(inputs, outputs);
  feed_telegrams(now_);
  for (const PinPlace& place : kInputs)
    if (((inputs ^ inputs_) & place.mask) != 0) feed(place.pin, input_level(place, inputs));
  for (const PinPlace& place : kOutputs) {
    const dpsim_level level = output_level(place, outputs);
    const bool known = level != DPSIM_X || place.pin == DPSIM_DSDPV1_D_OUT;  // RTL before its reset
    if (known && ((outputs ^ outputs_) & place.mask) != 0) feed(place.pin, level);
  }
  inputs_ = inputs;
  outputs_ = outputs;
}

void Checker::finish() {
  if (finished_) return;
  finished_ = true;
  if (bus_ != nullptr) check(dpsim_bus_run(bus_, now_));
  feed_telegrams(now_);
  check(dpsim_checker_finish(checker_, now_));
}

uint64_t Checker::applied() const {
  uint64_t count = 0;
  for (std::size_t rule = 0; rule < dpsim_rule_count(nullptr); ++rule) {
    dpsim_check_result result{};
    result.size = sizeof result;
    check(dpsim_checker_get_result(checker_, rule, &result));
    count += result.count;
  }
  return count;
}

}  // namespace
}  // namespace dsdpv1::simulator

using dsdpv1::simulator::Checker;

int32_t dsdpv1_checker_create(const char* options, int32_t baud) {
  return dsdpv1::simulator::created([&] { return std::make_unique<Checker>(options, baud); });
}

int32_t dsdpv1_checker_step(int32_t handle, int64_t half, int64_t ps, int32_t inputs, int32_t outputs) {
  return dsdpv1::simulator::guarded([&] {
    auto& checker = dsdpv1::simulator::get<Checker>(handle);
    checker.step(dsdpv1::simulator::tick_of(half, ps), static_cast<uint32_t>(inputs), static_cast<uint32_t>(outputs));
    return checker.violations();
  });
}

int32_t dsdpv1_checker_finish(int32_t handle) {
  return dsdpv1::simulator::guarded([&] {
    auto& checker = dsdpv1::simulator::get<Checker>(handle);
    checker.finish();
    return checker.violations();
  });
}

int32_t dsdpv1_checker_applied(int32_t handle) {
  return dsdpv1::simulator::guarded([&] {
    return static_cast<int32_t>(std::min<uint64_t>(dsdpv1::simulator::get<Checker>(handle).applied(), INT32_MAX));
  });
}
