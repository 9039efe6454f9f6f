// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "driver/systemc/serial_cpu.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace dsdpv1::systemc {
namespace {

template <class Cpu>
Cpu& self(void* ctx) {
  return *static_cast<Cpu*>(ctx);
}

void aim(tlm::tlm_generic_payload& payload, tlm::tlm_command command, std::uint8_t* bytes, std::uint16_t n) {
  payload.set_command(command);
  payload.set_address(0);
  payload.set_data_ptr(bytes);
  payload.set_data_length(n);
  payload.set_streaming_width(n);
  payload.set_dmi_allowed(false);
  payload.set_gp_option(tlm::TLM_MIN_PAYLOAD);
  payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
}

/// The target waits for the local time, and until everything is sent.
template <class Socket>
bool transport(Socket& socket, tlm::tlm_generic_payload& payload, tlm_utils::tlm_quantumkeeper& keeper) {
  sc_core::sc_time local = keeper.get_local_time();
  socket->b_transport(payload, local);
  keeper.reset();
  keeper.set(local);
  return payload.is_response_ok();
}

void report_failure(const ProgramCpu& cpu, const tlm::tlm_generic_payload& payload) {
  const std::string text = std::string(cpu.name()) + ": sending " + std::to_string(payload.get_data_length()) +
                           " bytes failed: " + payload.get_response_string();
  SC_REPORT_WARNING("/dsdpv1/driver_cpu", text.c_str());
}

}  // namespace

// ----------------------------------------------------------------------------------------------------------------- SPI

SpiDriverCpu::SpiDriverCpu(const sc_core::sc_module_name& name, Program program, std::uint8_t address,
                           DriverCpuOptions options)
    : ProgramCpu(
          name, [this, program = std::move(program)] { program(*this); }, std::move(options)),
      port_() {
  port_.ctx = this;
  port_.address = address;
  port_.exchange = [](void* ctx, const std::uint8_t* out, std::uint8_t* in, std::uint16_t n) {
    return self<SpiDriverCpu>(ctx).exchange(out, in, n);
  };
  port_.pause = [](void* ctx, std::uint32_t ns) {
    self<SpiDriverCpu>(ctx).spend(sc_core::sc_time(ns, sc_core::SC_NS));
  };
  dsdpv1_open_spi(&device(), &port_, nullptr);
}

bool SpiDriverCpu::exchange(const std::uint8_t* out, std::uint8_t* in, std::uint16_t n) {
  if (out != in) std::copy(out, out + n, in);
  aim(payload_, tlm::TLM_READ_COMMAND, in, n);
  const bool done = transport(socket, payload_, keeper());
  if (!done) report_failure(*this, payload_);
  spend(options().overhead);
  return done;
}

// ---------------------------------------------------------------------------------------------------------------- UART

UartDriverCpu::UartDriverCpu(const sc_core::sc_module_name& name, Program program, std::uint8_t address,
                             std::uint32_t baud, DriverCpuOptions options)
    : ProgramCpu(
          name, [this, program = std::move(program)] { program(*this); }, std::move(options)),
      port_() {
  uart_in.bind(*this);
  port_.ctx = this;
  port_.address = address;
  port_.baud = baud;
  port_.send = [](void* ctx, const std::uint8_t* bytes, std::uint16_t n) {
    return self<UartDriverCpu>(ctx).send(bytes, n);
  };
  port_.receive = [](void* ctx, std::uint8_t* bytes, std::uint16_t n, std::uint32_t timeout_us) {
    return self<UartDriverCpu>(ctx).receive(bytes, n, sc_core::sc_time(timeout_us, sc_core::SC_US));
  };
  port_.pause = [](void* ctx, std::uint32_t ns) {
    self<UartDriverCpu>(ctx).spend(sc_core::sc_time(ns, sc_core::SC_NS));
  };
  dsdpv1_open_uart(&device(), &port_, nullptr);
}

void UartDriverCpu::write(const std::uint8_t& byte) {
  received_.push_back(byte);
  byte_.notify(sc_core::SC_ZERO_TIME);
}

bool UartDriverCpu::send(const std::uint8_t* bytes, std::uint16_t n) {
  std::vector<std::uint8_t> copy(bytes, bytes + n);  // a payload's data are not const
  aim(payload_, tlm::TLM_WRITE_COMMAND, copy.data(), n);
  const bool done = transport(socket, payload_, keeper());
  if (!done) report_failure(*this, payload_);
  spend(options().overhead);
  return done;
}

bool UartDriverCpu::wait_for_byte(const sc_core::sc_time& timeout) {
  const sc_core::sc_time end = sc_core::sc_time_stamp() + timeout;
  while (received_.empty() && sc_core::sc_time_stamp() < end) wait(end - sc_core::sc_time_stamp(), byte_);
  return !received_.empty();
}

std::uint16_t UartDriverCpu::receive(std::uint8_t* bytes, std::uint16_t n, const sc_core::sc_time& timeout) {
  sync();
  std::uint16_t got = 0;
  for (; got < n && wait_for_byte(timeout); received_.pop_front()) bytes[got++] = received_.front();
  keeper().reset();
  spend(options().overhead);
  return got;
}

}  // namespace dsdpv1::systemc
