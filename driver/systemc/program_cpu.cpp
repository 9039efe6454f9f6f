// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "driver/systemc/program_cpu.hpp"

#include <string>
#include <utility>

namespace dsdpv1::systemc {

ProgramCpu::ProgramCpu(const sc_core::sc_module_name& name, std::function<void()> program, DriverCpuOptions options)
    : sc_module(name), program_(std::move(program)), options_(std::move(options)), device_() {
  SC_HAS_PROCESS(ProgramCpu);
  SC_THREAD(run);
  SC_METHOD(intr0_changed);
  sensitive << INTR0;
}

void ProgramCpu::run() {
  keeper_.reset();
  program_();
}

void ProgramCpu::intr0_changed() {
  if (INTR0.size() == 0 || !INTR0->negedge()) return;  // the first call comes from the initialisation
  dsdpv1_on_intr0(&device_);
  intr0_fell_ = true;
  intr0_event_.notify();
}

void ProgramCpu::set_reset(bool level) {
  if (RESET.size() == 0)
    SC_REPORT_ERROR("/dsdpv1/driver_cpu", (std::string(name()) + ": set_reset needs RESET to be bound").c_str());
  else
    set_pin(*RESET[0], level);
}

void ProgramCpu::spend(const sc_core::sc_time& time) {
  keeper_.inc(time);
  if (keeper_.need_sync()) keeper_.sync();
}

bool ProgramCpu::wait_for_intr0(const sc_core::sc_time& at_most) {
  sync();
  if (!intr0_fell_) wait(at_most, intr0_event_);
  keeper_.reset();
  return std::exchange(intr0_fell_, false);
}

void ProgramCpu::sync() {
  if (keeper_.get_local_time() > sc_core::SC_ZERO_TIME) keeper_.sync();
}

void ProgramCpu::set_pin(sc_core::sc_signal_inout_if<bool>& pin, bool level) {
  sync();
  pin.write(level);
  spend(options_.pin_write);
}

}  // namespace dsdpv1::systemc
