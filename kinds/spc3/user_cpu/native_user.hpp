#pragma once
// The standard user program on the native CPU, as the user CPU of a slave.
#include <utility>

#include "kinds/spc3/user_cpu/program.hpp"
#include "tb/chip/user_cpu/station_cpu.hpp"

namespace dsdpv1::spc3_user {

class NativeUser : public user_cpu::StationCpu {
 public:
  NativeUser(RegisterCall& chip, const CpuTiming& timing, const FirmwareOptions& firmware,
             user_cpu::ProgramOptions options, Tick start)
      : program_(firmware, std::move(options)),
        cpu_(
            chip, timing, [this] { program_.run(cpu_); }, start) {
    program_.on_error = [this](const user_cpu::ProgramError& error) {
      if (on_error) on_error(error);
    };
  }

  Tick next() const override { return cpu_.next(); }
  void run(Tick now) override { cpu_.run(now); }
  void set_others(user_cpu::Others* others) override { cpu_.others = others; }
  /// The program leaves INT_Pol 0: X/INT is low-active.
  void interrupt_changed(Tick at, bool level) override {
    if (!level) cpu_.interrupt(at);
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
  NativeCpu cpu_;  // destroyed before the program that it runs
};

}  // namespace dsdpv1::spc3_user
