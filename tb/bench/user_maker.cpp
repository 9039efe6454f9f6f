#include "tb/bench/user_maker.hpp"

#include <fmt/format.h>

#include <utility>

#include "tb/bench/untold.hpp"
#include "tb/input/input_error.hpp"
#include "tb/user_cpu/fsmc_timing.hpp"
#include "tb/user_cpu/native_user.hpp"
#ifdef DSDPV1_HAS_ARM_BOARD
#include "tb/user_cpu/arm/board.hpp"
#include "tb/user_cpu/arm/gdb_server.hpp"
#endif

namespace tb {
namespace {

user_cpu::AcyclicObject object_of(const scenario::Dpv1Object& object) {
  const auto bit = [](bool wanted, unsigned value) { return wanted ? value : 0U; };
  const unsigned services = bit(object.read, DSDPV1_MAY_READ) | bit(object.write, DSDPV1_MAY_WRITE) |
                            bit(object.transport, DSDPV1_MAY_TRANSPORT);
  return {static_cast<std::uint8_t>(object.slot),       static_cast<std::uint8_t>(object.index),
          static_cast<std::uint8_t>(services),          object.classes,
          static_cast<std::uint8_t>(object.min_length), object.data};
}

user_cpu::AcyclicOptions acyclic_options(const scenario::Dpv1User& user) {
  user_cpu::AcyclicOptions options;
  for (const scenario::Dpv1Object& object : user.objects) options.objects.push_back(object_of(object));
  if (user.im0) options.im0 = *user.im0;
  options.answering = user.answering;
  options.delay = user.delay;
  options.error_code_1 = static_cast<std::uint8_t>(user.error_code_1);
  options.error_code_2 = static_cast<std::uint8_t>(user.error_code_2);
  return options;
}

user_cpu::ProgramOptions program_options(const scenario::UserCpu& user, const user_cpu::StationConfig& station) {
  user_cpu::ProgramOptions options;
  options.station = station;
  options.start_delay = user.start_delay;
  options.period = user.cycle;
  options.inputs = user.behaviour;
  options.constant = user.constant;
  options.policy = user.overwrite_inputs ? DSDPV1_INPUT_NEWEST : DSDPV1_INPUT_WHEN_CONSUMED;
  options.prm = user.judge_prm;
  options.cfg = user.judge_cfg;
  options.judge_delay = user.judge_delay;
  options.judge_in_handler = user.judge_in_handler;
  options.retry_delay = user.retry_delay;
  options.acyclic = acyclic_options(user.dpv1);
  return options;
}

MakeUser native_user(const scenario::UserCpu& user, ChipView& chip) {
  user_cpu::CpuTiming timing;
  if (user.timing) timing = static_cast<const user_cpu::CpuTiming&>(*user.timing);
  if (user.access) timing.access = static_cast<const user_cpu::AccessTiming&>(*user.access);
  if (user.fsmc) {
    const user_cpu::FsmcAccess fsmc = user_cpu::access_timing(user_cpu::with({}, *user.fsmc));
    timing.access = fsmc.read;
    timing.write_access = fsmc.write;
  }
  return [&user, &chip, timing](const user_cpu::StationConfig& station, Tick start) {
    return std::make_unique<user_cpu::NativeUser>(chip.host_bus(), timing, program_options(user, station), start);
  };
}

#ifdef DSDPV1_HAS_ARM_BOARD

/// As the scenario's check has found them right.
arm::Switches switches_of(const scenario::UserCpu& user) {
  arm::Switches switches;
  for (const scenario::Name& text : user.switches) {
    const scenario::Switch one = *scenario::parse_switch(text.text);
    const auto bit = static_cast<std::uint16_t>(1U << one.pin);
    switches.held.at(one.port) |= bit;
    if (one.high) switches.levels.at(one.port) |= bit;
  }
  return switches;
}

/// The mailbox has room for so many.
void check_objects(const scenario::Scenario& scenario, const scenario::Slave& slave, const arm::Firmware& firmware) {
  const std::size_t count = slave.user_cpu.dpv1.objects.size();
  if (firmware.mailbox && count > DSDPV1_MAILBOX_OBJECTS)
    throw InputError(scenario.file, slave.user_cpu.dpv1.line,
                     fmt::format("dpv1 has {} objects, allowed on an ARM board are {}", count, DSDPV1_MAILBOX_OBJECTS));
}

MakeUser arm_user(const scenario::Scenario& scenario, const scenario::Slave& slave, ChipView& chip, const GdbRequest* gdb,
                  std::set<const void*>& left_out) {
  const scenario::UserCpu& user = slave.user_cpu;
  arm::BoardOptions options;
  options.firmware = arm::load_firmware(scenario::resolve(scenario, user.elf));
  if (!options.firmware->mailbox) {
    Untold missing = untold(scenario, slave, options.firmware->path);
    options.notes = std::move(missing.notes);
    left_out.merge(missing.left_out);
  }
  check_objects(scenario, slave, *options.firmware);
  options.timing.millicycles_per_instruction = static_cast<std::uint32_t>(user.cpi * 1000);
  if (user.fsmc) options.fsmc = static_cast<const user_cpu::FsmcOverride&>(*user.fsmc);
  if (user.access) options.access = static_cast<const user_cpu::AccessTiming&>(*user.access);
  options.switches = switches_of(user);
  if (gdb != nullptr) {
    options.make_debugger = [gdb](arm::DebugTarget& target) {
      return std::make_unique<arm::GdbServer>(target, arm::GdbOptions{gdb->port, gdb->stopped, gdb->say});
    };
  }
  return [&user, &chip, options](const user_cpu::StationConfig& station, Tick start) {
    arm::BoardOptions now = options;
    now.program = program_options(user, station);
    now.chip = &chip.chip();
    const auto set_chip_reset = [&chip](Tick at, bool level) { chip.set_reset(at, level); };
    return std::make_unique<arm::Board>(chip.host_bus(), std::move(now), set_chip_reset, start);
  };
}

#endif

}  // namespace

#ifdef DSDPV1_HAS_ARM_BOARD
MakeUser user_maker(const scenario::Scenario& scenario, const scenario::Slave& slave, ChipView& chip,
                    const GdbRequest* gdb, std::set<const void*>& left_out) {
  return slave.user_cpu.kind == scenario::CpuKind::kArm ? arm_user(scenario, slave, chip, gdb, left_out)
                                                        : native_user(slave.user_cpu, chip);
}
#else
MakeUser user_maker(const scenario::Scenario& scenario, const scenario::Slave& slave, ChipView& chip, const GdbRequest*,
                    std::set<const void*>&) {
  if (slave.user_cpu.kind == scenario::CpuKind::kArm)
    throw InputError(scenario.file, slave.user_cpu.line,
                     "kind is arm, this program was built without the ARM board (libunicorn), allowed is native");
  return native_user(slave.user_cpu, chip);
}
#endif

}  // namespace tb
