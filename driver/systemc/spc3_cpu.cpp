// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "driver/systemc/spc3_cpu.hpp"

#include <utility>

namespace dsdpv1::systemc {
namespace {

Spc3DriverCpu& cpu_of(void* ctx) { return *static_cast<Spc3DriverCpu*>(ctx); }

}  // namespace

Spc3DriverCpu::Spc3DriverCpu(const sc_core::sc_module_name& name, Program program, DriverCpuOptions options)
    : CpuThread(
          name, [this, program = std::move(program)] { program(*this); }, std::move(options)) {
  port_.ctx = this;
  port_.read = [](void* ctx, std::uint16_t address) { return cpu_of(ctx).accesses_.read(cpu_of(ctx).socket, address); };
  port_.write = [](void* ctx, std::uint16_t address, std::uint8_t value) {
    cpu_of(ctx).accesses_.write(cpu_of(ctx).socket, address, value);
  };
  (void)spc3_open(&device_, &port_, nullptr);
}

bool Spc3DriverCpu::wait_for_interrupt(const sc_core::sc_time& at_most, bool active_high) {
  sync();
  const sc_core::sc_time end = sc_core::sc_time_stamp() + at_most;
  const auto is_active = [&] { return X_INT.size() > 0 && X_INT->read() == active_high; };
  while (!is_active() && sc_core::sc_time_stamp() < end) {
    const sc_core::sc_time left = end - sc_core::sc_time_stamp();
    X_INT.size() > 0 ? wait(left, X_INT->value_changed_event()) : wait(left);
  }
  keeper().reset();
  return is_active();
}

}  // namespace dsdpv1::systemc
