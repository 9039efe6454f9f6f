#pragma once
// The standard user program on the native CPU.
#include "kinds/dsdpv1/user_cpu/orders.hpp"
#include "kinds/dsdpv1/user_cpu/programs.hpp"
#include "kinds/user_cpu/native_cpu.hpp"
#include "tb/chip/user_cpu/station_cpu.hpp"

namespace dsdpv1::user_cpu {

class NativeUser : public StationCpu {
 public:
  NativeUser(HostBus& bus, const CpuTiming& timing, ProgramOptions options, Tick start, const HostPort& port = {})
      : bus_(bus), program_(std::move(options), port), cpu_(bus, timing, program_.entry(), start) {
    program_.on_error = [this](const DriverError& error) {
      if (on_error) on_error(program_error(error));
    };
    cpu_.on_announce = [this] {
      announce();
      if (on_plan) on_plan();
    };
  }

  Tick next() const override { return cpu_.next(); }
  void run(Tick now) override { cpu_.run(now); }
  void set_others(Others* others) override { cpu_.others = others; }
  void interrupt_changed(Tick at, bool level) override {
    cpu_.intr0_changed(at, level);
    announce();
  }
  void command(Tick now, const Command& command) override {
    if (carry_out(command, bus_)) return;
    program_.post(driver_command(command));
    cpu_.wake(now);
    announce();
  }
  UserCounters counters() const override { return {program_.port_counters(), program_.counters(), cpu_.counters()}; }
  std::uint64_t outputs_received() const override { return program_.counters().outputs_received; }
  const std::vector<std::uint8_t>& outputs() const override { return program_.outputs(); }

 private:
  HostBus& bus_;
  UserProgram program_;
  NativeCpu cpu_;  // destroyed before the program that it runs
};

}  // namespace dsdpv1::user_cpu
