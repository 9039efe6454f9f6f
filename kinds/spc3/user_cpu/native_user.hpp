#pragma once
// The standard user program on the native CPU, as the user CPU of a slave.
#include <utility>

#include "kinds/spc3/user_cpu/program.hpp"
#include "kinds/user_cpu/native_cpu.hpp"
#include "tb/chip/user_cpu/station_cpu.hpp"

namespace dsdpv1::spc3_user {

class NativeUser : public user_cpu::StationCpu {
 public:
  NativeUser(user_cpu::HostBus& bus, const user_cpu::CpuTiming& timing, const FirmwareOptions& firmware,
             user_cpu::ProgramOptions options, Tick start)
      : program_(firmware, std::move(options)),
        cpu_(
            bus, timing, [this](user_cpu::Cpu& cpu) { program_.run(cpu); }, start) {
    program_.on_error = [this](const user_cpu::ProgramError& error) {
      if (on_error) on_error(error);
    };
    cpu_.on_announce = [this] { announce(); };
  }

  Tick next() const override { return cpu_.next(); }
  void run(Tick now) override { cpu_.run(now); }
  void set_others(user_cpu::Others* others) override { cpu_.others = others; }
  /// The program leaves INT_Pol 0: X/INT is low-active.
  void interrupt_changed(Tick at, bool level) override {
    cpu_.intr0_changed(at, level);
    announce();
  }
  void command(Tick now, const user_cpu::Command& command) override {
    program_.post(command);
    cpu_.wake(now);
    announce();
  }
  user_cpu::UserCounters counters() const override { return {{}, program_.counters(), cpu_.counters()}; }
  std::uint64_t outputs_received() const override { return program_.counters().outputs_received; }
  const std::vector<std::uint8_t>& outputs() const override { return program_.outputs(); }

 private:
  UserProgram program_;
  user_cpu::NativeCpu cpu_;  // destroyed before the program that it runs
};

}  // namespace dsdpv1::spc3_user
