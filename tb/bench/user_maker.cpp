#include "tb/bench/user_maker.hpp"

#include "tb/user_cpu/fsmc_timing.hpp"
#include "tb/user_cpu/native_user.hpp"

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
  auto timing = static_cast<const user_cpu::CpuTiming&>(user.timing);
  timing.access = static_cast<const user_cpu::AccessTiming&>(user.access);
  if (user.fsmc) {
    const user_cpu::FsmcAccess fsmc = user_cpu::access_timing(user_cpu::with({}, *user.fsmc));
    timing.access = fsmc.read;
    timing.write_access = fsmc.write;
  }
  return [&user, &chip, timing](const user_cpu::StationConfig& station, Tick start) {
    return std::make_unique<user_cpu::NativeUser>(chip.host_bus(), timing, program_options(user, station), start);
  };
}

}  // namespace

MakeUser user_maker(const scenario::Scenario&, const scenario::Slave& slave, ChipView& chip) {
  return native_user(slave.user_cpu, chip);
}

}  // namespace tb
