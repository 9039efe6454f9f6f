// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "driver/systemc/driver_cpu.hpp"

#include <cstdio>
#include <string>
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
  payload_.set_data_length(1);
  payload_.set_streaming_width(1);
}

dsdpv1_port DriverCpu::make_port() {
  dsdpv1_port port{};
  port.ctx = this;
  port.read = [](void* ctx, std::uint16_t address) { return self(ctx).access(tlm::TLM_READ_COMMAND, address, 0xFF); };
  port.write = [](void* ctx, std::uint16_t address, std::uint8_t value) {
    self(ctx).access(tlm::TLM_WRITE_COMMAND, address, value);
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

std::uint8_t DriverCpu::access(tlm::tlm_command command, std::uint16_t address, std::uint8_t value) {
  const std::uint64_t before = sc_core::sc_time_stamp().value();
  sc_core::sc_time local = keeper().get_local_time();
  payload_.set_command(command);
  payload_.set_address(address);
  payload_.set_data_ptr(&value);
  payload_.set_dmi_allowed(false);
  payload_.set_gp_option(tlm::TLM_MIN_PAYLOAD);
  payload_.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
  socket->b_transport(payload_, local);
  ++accesses_;
  if (sc_core::sc_time_stamp().value() == before)
    ++accesses_ahead_;
  else
    keeper().reset();  // the target has waited for the local time
  if (payload_.is_response_error()) report_failed_access();
  keeper().set(local);
  spend(options().overhead);
  return payload_.is_response_error() ? std::uint8_t{0xFF} : value;
}

void DriverCpu::report_failed_access() const {
  char what[40];
  std::snprintf(what, sizeof what, ": %s 0x%03X failed: ", payload_.is_read() ? "reading" : "writing",
                static_cast<unsigned>(payload_.get_address()));
  SC_REPORT_WARNING("/dsdpv1/driver_cpu", (name() + std::string(what) + payload_.get_response_string()).c_str());
}

}  // namespace dsdpv1::systemc
