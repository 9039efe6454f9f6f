// The scenario of a replay, with one slave only.
#include <fmt/format.h>

#include <algorithm>

#include "bus/baud.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "io/input/units.hpp"
#include "lab/replay/replay.hpp"
#include "tb/bench/setup.hpp"
#include "tb/scenario/event_codes.hpp"

namespace dsdpv1::tb::replay {
namespace {

/// Longer than any capture, and far from the end of 64 bits.
constexpr Tick kOpenEnd = 20LL * 365 * 24 * 3600 * bus::kTicksPerSecond;

std::string name_of(const Recording& recording) { return fmt::format("station_{}", recording.slave); }

scenario::UserCpu user_of(const Firmware& firmware, const ChipKind& kind) {
  scenario::UserCpu user;
  user.cycle = firmware.cycle;
  user.judge_prm = user.judge_cfg = scenario::Judgement::kNever;  // the verdicts are supplied
  user.dpv1.objects = firmware.objects;
  user.own = kind.make_user_settings();
  return user;
}

/// Properties that the capture does not show were not requested in it.
scenario::InitData init_of(const Firmware& firmware, bool has_gsd, const ChipKind& kind) {
  scenario::InitData init = firmware.init;
  if (!kind.has_prm_buffer() ||
      (has_gsd && !firmware.short_prm_buffer)) {  // all blocks have their room, or the GSD has it
    init.max_diag.reset();
    init.max_cfg.reset();
    init.max_inputs.reset();
    init.max_outputs.reset();
  }
  if (has_gsd)
    init.ident.reset();
  else if (!init.ident)
    init.ident = 0;
  const bus::Bytes empty_slot = {0};
  if (!init.cfg && !has_gsd) init.cfg = empty_slot;
  return init;
}

/// Flags of the bus monitor concern the recorded line, on which the model's answers end in other bit times.
void allow_flags(scenario::Scenario& scenario) {
  for (std::size_t flag = 0; flag < bus::kFlagKinds; ++flag)
    scenario.allow.push_back({{scenario::flag_code(static_cast<bus::FlagKind>(flag)), 0}, {"bus", 0}, 0});
}

}  // namespace

const ChipKind& kind_for(const Firmware& firmware) {
  const ChipKinds& kinds = chip_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const ChipKind* kind) {
    return !firmware.short_prm_buffer || kind->has_prm_buffer();
  });
  const ChipKind* kind = found == kinds.end() ? kinds.front() : *found;
  return *kind;
}

scenario::Scenario scenario_of(const Recording& recording, const Firmware& firmware, const std::string& gsd,
                               const ChipKind& kind) {
  scenario::Scenario scenario;
  scenario.file = recording.name;
  scenario.name = "Replay of " + recording.name;
  scenario.baud = recording.baud;
  scenario.end = kOpenEnd;
  scenario.kind = &kind;
  scenario.chip = kind.make_chip_settings();
  static_cast<checks::Limits&>(scenario.checks) = checks::Limits(kind.rules());
  scenario::Slave slave;
  slave.name.text = name_of(recording);
  slave.kind = scenario.kind;
  slave.chip = scenario.chip;
  slave.address = recording.slave;
  slave.gsd.text = gsd;
  slave.init = init_of(firmware, !gsd.empty(), kind);
  slave.user_cpu = user_of(firmware, kind);
  scenario.slaves.push_back(std::move(slave));
  take_inputs_of(firmware, scenario);
  allow_flags(scenario);
  return scenario;
}

void take_inputs_of(const Firmware& firmware, scenario::Scenario& scenario) {
  scenario::UserCpu& user = scenario.slaves.front().user_cpu;
  user.behaviour = scenario::Behaviour::kConstant;
  user.constant = firmware.inputs;
}

scenario::Scenario alone(scenario::Scenario scenario, const Recording& recording) {
  auto& slaves = scenario.slaves;
  auto slave = std::find_if(slaves.begin(), slaves.end(),
                            [&](const scenario::Slave& each) { return each.address == recording.slave; });
  if (slave == slaves.end() && slaves.size() == 1) slave = slaves.begin();
  if (slave == slaves.end()) {
    std::vector<std::string> addresses;
    addresses.reserve(slaves.size());
    for (const scenario::Slave& each : slaves) addresses.push_back(std::to_string(each.address));
    throw InputError(scenario.file, 0,
                     fmt::format("no slave has address {} (--as), expected {}", recording.slave, join(addresses)));
  }
  slaves = {*slave};
  slaves.front().address = recording.slave;
  scenario.baud = recording.baud;
  scenario.end = kOpenEnd;
  scenario.masters.clear();
  scenario.masters2.clear();
  scenario.script.clear();
  scenario.expect.clear();
  allow_flags(scenario);
  return scenario;
}

std::string describe_station(const scenario::Scenario& scenario) {
  const user_cpu::StationConfig station = Setup(scenario).station(scenario.slaves.front());
  const scenario::Slave& slave = scenario.slaves.front();
  const std::string kind = slave.kind == chip_kinds().front() ? "" : fmt::format(", {}", slave.kind->title());
  return fmt::format("address {}, ident {:04X}, configuration {}{}{}", slave.address, station.ident,
                     bytes_text(station.cfg), station.dpv1 ? ", DPV1" : "", kind);
}

}  // namespace dsdpv1::tb::replay
