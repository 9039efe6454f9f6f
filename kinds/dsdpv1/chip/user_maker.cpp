#include "kinds/dsdpv1/chip/user_maker.hpp"

#include <memory>

#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/dsdpv1/user_cpu/fsmc_access.hpp"
#include "kinds/dsdpv1/user_cpu/native_user.hpp"
#include "tb/bench/program_options.hpp"

namespace dsdpv1::tb {
namespace {

MakeUser native_user(const scenario::UserCpu& user, const Dsdpv1Settings& settings, user_cpu::HostBus& host) {
  const Dsdpv1User& own = tb::own(user);
  user_cpu::CpuTiming timing;
  if (own.timing) timing = static_cast<const user_cpu::CpuTiming&>(*own.timing);
  if (own.access) timing.access = static_cast<const AccessTiming&>(*own.access);
  if (own.fsmc) {
    const user_cpu::FsmcAccess fsmc = user_cpu::access_timing(user_cpu::with({}, *own.fsmc));
    timing.access = fsmc.read;
    timing.write_access = fsmc.write;
  }
  const user_cpu::HostPort port = host_port_of(own, settings);
  return [&user, &host, timing, port](const user_cpu::StationConfig& station, Tick start) {
    return std::make_unique<user_cpu::NativeUser>(host, timing, program_options(user, station), start, port);
  };
}

MakeArmUser arm_maker = nullptr;

}  // namespace

void set_arm_maker(MakeArmUser make) { arm_maker = make; }

MakeUser make_dsdpv1_user(const UserRequest& request) {
  auto& host = static_cast<user_cpu::HostBus&>(*request.chip.user_side());
  if (own(request.slave.user_cpu).kind != CpuKind::kArm)
    return native_user(request.slave.user_cpu, static_cast<const Dsdpv1Settings&>(*request.scenario.chip), host);
  if (arm_maker != nullptr) return arm_maker(request, host);
  throw InputError(request.scenario.file, request.slave.user_cpu.line,
                   "kind is arm, but this program has no ARM board, allowed without it is native");
}

}  // namespace dsdpv1::tb
