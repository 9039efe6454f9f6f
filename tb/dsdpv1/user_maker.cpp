#include "tb/dsdpv1/user_maker.hpp"

#include <fmt/format.h>

#include <utility>

#include "tb/dsdpv1/dsdpv1_view.hpp"
#include "tb/dsdpv1/settings.hpp"
#include "tb/dsdpv1/untold.hpp"
#include "tb/dsdpv1/user_cpu/fsmc_timing.hpp"
#include "tb/dsdpv1/user_cpu/native_user.hpp"
#include "tb/input/input_error.hpp"
#ifdef DSDPV1_HAS_ARM_BOARD
#include "tb/dsdpv1/user_cpu/arm/board.hpp"
#include "tb/dsdpv1/user_cpu/arm/gdb_server.hpp"
#endif

namespace tb {
namespace {

MakeUser native_user(const scenario::UserCpu& user, Dsdpv1View& chip) {
  const Dsdpv1User& own = tb::own(user);
  user_cpu::CpuTiming timing;
  if (own.timing) timing = static_cast<const user_cpu::CpuTiming&>(*own.timing);
  if (own.access) timing.access = static_cast<const user_cpu::AccessTiming&>(*own.access);
  if (own.fsmc) {
    const user_cpu::FsmcAccess fsmc = user_cpu::access_timing(user_cpu::with({}, *own.fsmc));
    timing.access = fsmc.read;
    timing.write_access = fsmc.write;
  }
  return [&user, &chip, timing](const user_cpu::StationConfig& station, Tick start) {
    return std::make_unique<user_cpu::NativeUser>(chip.host_bus(), timing, program_options(user, station), start);
  };
}

#ifdef DSDPV1_HAS_ARM_BOARD

/// As the scenario's check has found them right.
arm::Switches switches_of(const Dsdpv1User& user) {
  arm::Switches switches;
  for (const Name& text : user.switches) {
    const Switch one = *parse_switch(text.text);
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

void check_engine(const UserRequest& request) {
  try {
    arm::load_engine();
  } catch (const std::runtime_error& error) {
    throw InputError(request.scenario.file, request.slave.user_cpu.line, std::string("kind is arm, ") + error.what());
  }
}

MakeUser arm_user(const UserRequest& request, Dsdpv1View& chip) {
  const scenario::UserCpu& user = request.slave.user_cpu;
  const Dsdpv1User& own = tb::own(user);
  check_engine(request);
  arm::BoardOptions options;
  options.firmware = arm::load_firmware(scenario::resolve(request.scenario, own.elf));
  if (!options.firmware->mailbox) {
    Untold missing = untold(request.scenario, request.slave, options.firmware->path);
    options.notes = std::move(missing.notes);
    request.left_out.merge(missing.left_out);
  }
  check_objects(request.scenario, request.slave, *options.firmware);
  options.timing.millicycles_per_instruction = static_cast<std::uint32_t>(own.cpi * 1000);
  if (own.fsmc) options.fsmc = static_cast<const user_cpu::FsmcOverride&>(*own.fsmc);
  if (own.access) options.access = static_cast<const user_cpu::AccessTiming&>(*own.access);
  options.switches = switches_of(own);
  if (const GdbRequest* gdb = request.gdb) {
    options.make_debugger = [gdb](arm::DebugTarget& target) {
      return std::make_unique<arm::GdbServer>(target, arm::GdbOptions{gdb->port, gdb->stopped, gdb->say});
    };
  }
  return [&user, &chip, options](const user_cpu::StationConfig& station, Tick start) {
    arm::BoardOptions now = options;
    now.program = program_options(user, station);
    now.chip = [&chip](Tick at) -> const dsdpv1::Chip& {
      chip.sync(at);
      return chip.core();
    };
    const auto set_chip_reset = [&chip](Tick at, bool level) { chip.set_reset(at, level); };
    return std::make_unique<arm::Board>(chip.host_bus(), std::move(now), set_chip_reset, start);
  };
}

#endif

}  // namespace

MakeUser make_dsdpv1_user(const UserRequest& request) {
  auto& chip = static_cast<Dsdpv1View&>(request.chip);
  if (own(request.slave.user_cpu).kind != CpuKind::kArm) return native_user(request.slave.user_cpu, chip);
#ifdef DSDPV1_HAS_ARM_BOARD
  return arm_user(request, chip);
#else
  throw InputError(request.scenario.file, request.slave.user_cpu.line,
                   "kind is arm, this program was built without the ARM board (libunicorn), allowed is native");
#endif
}

}  // namespace tb
