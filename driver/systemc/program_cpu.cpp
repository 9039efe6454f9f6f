// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "driver/systemc/program_cpu.hpp"

#include <cstdio>
#include <string>
#include <utility>

namespace dsdpv1::systemc {

CpuThread::CpuThread(const sc_core::sc_module_name& name, std::function<void()> program, DriverCpuOptions options)
    : sc_module(name), program_(std::move(program)), options_(std::move(options)) {
#if IEEE_1666_SYSTEMC < 202301L  // obsolete since
  SC_HAS_PROCESS(CpuThread);
#endif
  SC_THREAD(run);
}

ProgramCpu::ProgramCpu(const sc_core::sc_module_name& name, std::function<void()> program, DriverCpuOptions options)
    : CpuThread(name, std::move(program), std::move(options)), device_() {
#if IEEE_1666_SYSTEMC < 202301L  // obsolete since
  SC_HAS_PROCESS(ProgramCpu);
#endif
  SC_METHOD(intr0_changed);
  sensitive << INTR0;
}

void CpuThread::run() {
  keeper_.reset();
  program_();
}

void ProgramCpu::intr0_changed() {
  if (INTR0.size() == 0 || !INTR0->negedge()) return;  // the first call comes from the initialisation
  dsdpv1_on_intr0(&device_);
  intr0_fell_ = true;
  intr0_event_.notify();
}

void CpuThread::set_reset(bool level) {
  if (RESET.size() == 0)
    SC_REPORT_ERROR("/dsdpv1/driver_cpu", (std::string(name()) + ": set_reset needs RESET to be bound").c_str());
  else
    set_pin(*RESET[0], level);
}

void CpuThread::spend(const sc_core::sc_time& time) {
  keeper_.inc(time);
  if (keeper_.need_sync()) keeper_.sync();
}

bool ProgramCpu::wait_for_intr0(const sc_core::sc_time& at_most) {
  sync();
  if (!intr0_fell_) wait(at_most, intr0_event_);
  keeper().reset();
  return std::exchange(intr0_fell_, false);
}

void CpuThread::sync() {
  if (keeper_.get_local_time() > sc_core::SC_ZERO_TIME) keeper_.sync();
}

void CpuThread::set_pin(sc_core::sc_signal_inout_if<bool>& pin, bool level) {
  sync();
  pin.write(level);
  spend(options_.pin_write);
}

// -------------------------------------------------------------------------------------------------------------
// accesses

ByteAccesses::ByteAccesses(CpuThread& cpu) : cpu_(cpu) {
  payload_.set_data_length(1);
  payload_.set_streaming_width(1);
}

std::uint8_t ByteAccesses::access(tlm::tlm_fw_transport_if<>& target, tlm::tlm_command command, std::uint16_t address,
                                  std::uint8_t value) {
  const std::uint64_t before = sc_core::sc_time_stamp().value();
  sc_core::sc_time local = cpu_.keeper().get_local_time();
  payload_.set_command(command);
  payload_.set_address(address);
  payload_.set_data_ptr(&value);
  payload_.set_dmi_allowed(false);
  payload_.set_gp_option(tlm::TLM_MIN_PAYLOAD);
  payload_.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
  target.b_transport(payload_, local);
  ++count_;
  if (sc_core::sc_time_stamp().value() == before)
    ++ahead_;
  else
    cpu_.keeper().reset();  // the target has waited for the local time
  if (payload_.is_response_error()) report_failure();
  cpu_.keeper().set(local);
  cpu_.spend(cpu_.options().overhead);
  return payload_.is_response_error() ? std::uint8_t{0xFF} : value;
}

void ByteAccesses::report_failure() const {
  char what[40];
  std::snprintf(what, sizeof what, ": %s 0x%03X failed: ", payload_.is_read() ? "reading" : "writing",
                static_cast<unsigned>(payload_.get_address()));
  SC_REPORT_WARNING("/dsdpv1/driver_cpu", (cpu_.name() + std::string(what) + payload_.get_response_string()).c_str());
}

}  // namespace dsdpv1::systemc
