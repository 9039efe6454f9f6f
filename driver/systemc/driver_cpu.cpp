// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "driver/systemc/driver_cpu.hpp"

#include <utility>

namespace dsdpv1::systemc {
namespace {

DriverCpu& self(void* ctx) { return *static_cast<DriverCpu*>(ctx); }

}  // namespace

DriverCpu::DriverCpu(const sc_core::sc_module_name& name, Program program, DriverCpuOptions options)
    : ProgramCpu(
          name, [this, program = std::move(program)] { program(*this); }, std::move(options)),
      port_(make_port()) {
  dsdpv1_open(&device(), &port_, nullptr);
}

dsdpv1_port DriverCpu::make_port() {
  dsdpv1_port port{};
  port.ctx = this;
  port.read = [](void* ctx, std::uint16_t address) { return self(ctx).accesses_.read(self(ctx).socket, address); };
  port.write = [](void* ctx, std::uint16_t address, std::uint8_t value) {
    self(ctx).accesses_.write(self(ctx).socket, address, value);
  };
  port.set_r_req = [](void* ctx, bool level) { self(ctx).set_pin(*self(ctx).R_REQ.operator->(), level); };
  port.set_r_sta = [](void* ctx, bool level) { self(ctx).set_pin(*self(ctx).R_STA.operator->(), level); };
  port.get_l_req = [](void* ctx) { return self(ctx).get_pin(self(ctx).L_REQ); };
  port.get_l_sta = [](void* ctx) { return self(ctx).get_pin(self(ctx).L_STA); };
  port.pause = [](void* ctx, std::uint32_t ns) { self(ctx).spend(sc_core::sc_time(ns, sc_core::SC_NS)); };
  return port;
}

bool DriverCpu::get_pin(const sc_core::sc_in<bool>& pin) {
  sync();
  const bool level = pin.read();
  spend(options().pin_read);
  return level;
}

}  // namespace dsdpv1::systemc
