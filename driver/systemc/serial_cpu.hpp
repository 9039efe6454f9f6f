// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#pragma once
// User CPUs on the SPI and UART ports of a DSDPV1-RSU, for SystemC platforms: as DriverCpu, but the driver's port uses
// a socket of byte streams. All other calls of the driver are the same.
//
//   dsdpv1::systemc::SpiDriverCpu cpu("cpu", [](dsdpv1::systemc::SpiDriverCpu& cpu) {
//     cpu.set_reset(true);
//     if (dsdpv1_wait_ready(&cpu.device()) == DSDPV1_OK) dsdpv1_initialise(&cpu.device(), &config);
//     ...
//   });
//   cpu.socket.bind(chip.spi_socket);
//   cpu.RESET(reset), cpu.INTR0(intr0);
//
// Ports and time: docs/systemc.md.
#include <tlm.h>
#include <tlm_utils/simple_initiator_socket.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <systemc>

#include "driver/dsdpv1_spi.h"
#include "driver/dsdpv1_uart.h"
#include "driver/systemc/program_cpu.hpp"

namespace dsdpv1::systemc {

class SpiDriverCpu : public ProgramCpu {
 public:
  using Program = std::function<void(SpiDriverCpu&)>;

  /// Each transaction is a read of a whole frame: the data go out and come in (RsuTlmModule::spi_socket).
  tlm_utils::simple_initiator_socket<SpiDriverCpu> socket{"socket"};

  /// As DriverCpu's. `address` is the chip's: 1 or 2.
  SpiDriverCpu(const sc_core::sc_module_name& name, Program program, std::uint8_t address = 1,
               DriverCpuOptions options = {});

  /// For dsdpv1_open_spi; `spare` and `block_crc` may be set before.
  dsdpv1_spi& port() { return port_; }

 private:
  bool exchange(const std::uint8_t* out, std::uint8_t* in, std::uint16_t n);

  dsdpv1_spi port_;
  tlm::tlm_generic_payload payload_;
};

class UartDriverCpu : public ProgramCpu, private tlm::tlm_analysis_if<std::uint8_t> {
 public:
  using Program = std::function<void(UartDriverCpu&)>;

  /// Each transaction is a write of a whole telegram (RsuTlmModule::uart_socket).
  tlm_utils::simple_initiator_socket<UartDriverCpu> socket{"socket"};
  /// Bytes from the chip, kept until the driver asks for them (RsuTlmModule::uart_out).
  sc_core::sc_export<tlm::tlm_analysis_if<std::uint8_t>> uart_in{"uart_in"};

  /// As DriverCpu's. `address` is the chip's: 1 or 2; `baud` that of the UART, in bit/s.
  UartDriverCpu(const sc_core::sc_module_name& name, Program program, std::uint8_t address = 1,
                std::uint32_t baud = 1'843'200, DriverCpuOptions options = {});

  /// For dsdpv1_open_uart; `interval`, `tsdr` and `block_crc` may be set before.
  dsdpv1_uart& port() { return port_; }

 private:
  void write(const std::uint8_t& byte) override;  // uart_in
  bool send(const std::uint8_t* bytes, std::uint16_t n);
  bool wait_for_byte(const sc_core::sc_time& timeout);
  std::uint16_t receive(std::uint8_t* bytes, std::uint16_t n, const sc_core::sc_time& timeout);

  dsdpv1_uart port_;
  tlm::tlm_generic_payload payload_;
  std::deque<std::uint8_t> received_;
  sc_core::sc_event byte_{"byte"};
};

}  // namespace dsdpv1::systemc
