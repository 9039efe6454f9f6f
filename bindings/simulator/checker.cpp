// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// The checks of docs/checks.md on packed pins. With a rate, an additional bus receives the telegrams on PBRXD and
// PBTXD.
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

class Checker final : public Object {
 public:
  Checker(const ChipOptions& options, int32_t baud);
  ~Checker() override;
  Checker(const Checker&) = delete;
  Checker& operator=(const Checker&) = delete;

  void step(uint64_t tick, uint64_t inputs, uint64_t outputs);
  void finish();
  int32_t violations() const { return violations_; }
  uint64_t applied() const;

 private:
  void make_bus(int32_t baud);
  void hear(uint64_t inputs, uint64_t outputs);
  void feed_telegrams(uint64_t until);
  /// Feeds changed pins of one direction, if their levels are known: RTL before its reset has unknown ones.
  void feed(const PackedPins& pins, uint64_t before, uint64_t now);
  static void violated(void* self, const dpsim_violation* violation);
  static void heard(void* self, const dpsim_heard* telegram);

  /// A telegram is decoded in its last stop bit, before its end: it waits for pin changes until then.
  struct Waiting {
    dpsim_heard heard;
    std::vector<uint8_t> bytes;
  };

  dpsim_checker* checker_ = nullptr;
  dpsim_bus* bus_ = nullptr;
  std::deque<Waiting> telegrams_;
  uint16_t others_ = 0, chip_ = 0;
  uint64_t now_ = 0;
  const KindPins& pins_;
  const uint64_t line_, txd_, rts_;
  uint64_t inputs_, outputs_;
  int32_t violations_ = 0;
  bool finished_ = false;
};

Checker::Checker(const ChipOptions& options, int32_t baud)
    : pins_(pins_of_kind(options.kind)),
      line_(pins_.inputs.mask("PBRXD")),
      txd_(pins_.outputs.mask("PBTXD")),
      rts_(pins_.outputs.mask("PBRTS")),
      inputs_(pins_.inputs.at_reset()),
      outputs_(pins_.outputs.at_reset()) {
  std::vector<dpsim_limit> limits;
  limits.reserve(options.parameters.size());
  for (const Option& each : options.parameters) {
    const bool off = each.value == "off";
    limits.push_back({each.name.c_str(), off ? 0 : number_of(each, 0, INT64_MAX), off ? 1 : 0, 0});
  }
  dpsim_checker_options chosen{};
  chosen.size = sizeof chosen;
  chosen.kind = pins_.kind.c_str();
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
  check(dpsim_rule_get(checker->pins_.kind.c_str(), violation->rule, &rule));
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

void Checker::hear(uint64_t inputs, uint64_t outputs) {
  if (bus_ == nullptr) return;
  check(dpsim_bus_drive(bus_, now_, others_, (inputs & line_) == 0, 0));
  check(dpsim_bus_drive(bus_, now_, chip_, (outputs & rts_) != 0, (outputs & txd_) != 0));
}

void Checker::feed(const PackedPins& pins, uint64_t before, uint64_t now) {
  for_each_change(
      pins, before, now,
      [this](const PinPlace& place, dpsim_level level) {
        if (level != DPSIM_X || place.released != 0) check(dpsim_checker_pin(checker_, now_, place.pin, level));
      });
}

void Checker::step(uint64_t tick, uint64_t inputs, uint64_t outputs) {
  now_ = std::max(now_, tick);
  hear(inputs, outputs);
  feed_telegrams(now_);
  feed(pins_.inputs, inputs_, inputs);
  feed(pins_.outputs, outputs_, outputs);
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
  for (std::size_t rule = 0; rule < dpsim_rule_count(pins_.kind.c_str()); ++rule) {
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
  return dsdpv1::simulator::created(
      [&] { return std::make_unique<Checker>(dsdpv1::simulator::chip_options(options), baud); });
}

int32_t dsdpv1_checker_step(int32_t handle, int64_t half, int64_t ps, int64_t inputs, int64_t outputs) {
  return dsdpv1::simulator::guarded([&] {
    auto& checker = dsdpv1::simulator::get<Checker>(handle);
    checker.step(dsdpv1::simulator::tick_of(half, ps), static_cast<uint64_t>(inputs), static_cast<uint64_t>(outputs));
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
