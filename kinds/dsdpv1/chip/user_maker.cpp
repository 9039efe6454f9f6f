#include "kinds/dsdpv1/chip/user_maker.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <memory>

#include "io/input/input_error.hpp"
#include "kinds/board/untold.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/dsdpv1/user_cpu/native_user.hpp"
#include "kinds/dsdpv1/user_cpu/orders.hpp"
#include "kinds/dsdpv1/user_cpu/process_user.hpp"
#include "kinds/user_cpu/fsmc_access.hpp"
#include "tb/bench/program_options.hpp"

namespace dsdpv1::tb {
namespace {

MakeArmUser arm_maker = nullptr;
ReadLines line_reader = nullptr;

user_cpu::CpuTiming timing_of(const Dsdpv1User& own) {
  user_cpu::CpuTiming timing;
  if (own.timing) timing = static_cast<const user_cpu::CpuTiming&>(*own.timing);
  if (own.access) timing.access = static_cast<const AccessTiming&>(*own.access);
  if (own.fsmc) {
    const user_cpu::FsmcAccess fsmc = user_cpu::access_timing(user_cpu::with({}, *own.fsmc));
    timing.access = fsmc.read;
    timing.write_access = fsmc.write;
  }
  return timing;
}

MakeUser native_user(const scenario::UserCpu& user, const Dsdpv1Settings& settings, user_cpu::HostBus& host) {
  const user_cpu::CpuTiming timing = timing_of(own(user));
  const user_cpu::HostPort port = host_port_of(own(user), settings);
  return [&user, &host, timing, port](const user_cpu::StationConfig& station, Tick start) {
    return std::make_unique<user_cpu::NativeUser>(host, timing, program_options(user, station), start, port);
  };
}

void check_program(const std::string& path, const scenario::Scenario& scenario, int line) {
  if (std::filesystem::is_regular_file(path) && ::access(path.c_str(), X_OK) == 0) return;
  const char* what = std::filesystem::exists(path) ? "which is no program (chmod +x?)" : "which is not there";
  throw InputError(scenario.file, line, fmt::format("program is {}, {}", path, what));
}

MakeUser process_user(const UserRequest& request, user_cpu::HostBus& host) {
  const Dsdpv1User& own = tb::own(request.slave.user_cpu);
  user_cpu::ProcessOptions options;
  options.arguments = {scenario::resolve(request.scenario, own.program)};
  check_program(options.arguments[0], request.scenario, own.program.line);
  for (const Name& each : own.arguments) options.arguments.push_back(each.text);
  options.patience_ms = static_cast<int>((own.patience + bus::kTicksPerMs - 1) / bus::kTicksPerMs);
  if (line_reader != nullptr) options.lines_of = line_reader;
  (void)untold(request.scenario, request.slave,
               {options.arguments[0], "is a process of this computer", {}, kDriverErrors, user_cpu::kSpoilReads});
  const user_cpu::HostPort port = host_port_of(own, static_cast<const Dsdpv1Settings&>(*request.slave.chip));
  return [&host, timing = timing_of(own), options, port](const user_cpu::StationConfig&, Tick start) {
    return std::make_unique<user_cpu::ProcessUser>(host, timing, options, start, port);
  };
}

}  // namespace

void set_arm_maker(MakeArmUser make) { arm_maker = make; }

void set_line_reader(ReadLines read) { line_reader = read; }

MakeUser make_dsdpv1_user(const UserRequest& request) {
  auto& host = static_cast<user_cpu::HostBus&>(*request.chip.user_side());
  if (own(request.slave.user_cpu).kind == CpuKind::kProcess) return process_user(request, host);
  if (own(request.slave.user_cpu).kind != CpuKind::kArm)
    return native_user(request.slave.user_cpu, static_cast<const Dsdpv1Settings&>(*request.slave.chip), host);
  if (arm_maker != nullptr) return arm_maker(request, host);
  throw InputError(request.scenario.file, request.slave.user_cpu.line,
                   "kind is arm, but this program has no ARM board, allowed without it are native and process");
}

}  // namespace dsdpv1::tb
