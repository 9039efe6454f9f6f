#include "driver/systemc/driver_cpu.hpp"

#include <cstdio>
#include <string>
#include <utility>

namespace dsdpv1::systemc {
namespace {

DriverCpu& self(void* ctx) { return *static_cast<DriverCpu*>(ctx); }

}  // namespace

DriverCpu::DriverCpu(const sc_core::sc_module_name& name, Program program, DriverCpuOptions options)
    : sc_module(name), program_(std::move(program)), options_(std::move(options)), port_(make_port()), device_() {
  dsdpv1_open(&device_, &port_, nullptr);
  payload_.set_data_length(1);
  payload_.set_streaming_width(1);
  SC_HAS_PROCESS(DriverCpu);
  SC_THREAD(run);
  SC_METHOD(intr0_changed);
  sensitive << INTR0;
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

void DriverCpu::run() {
  keeper_.reset();
  program_(*this);
}

void DriverCpu::intr0_changed() {
  if (INTR0.size() == 0 || !INTR0->negedge()) return;  // the first call is that of the initialisation
  dsdpv1_on_intr0(&device_);
  intr0_fell_ = true;
  intr0_event_.notify();
}

void DriverCpu::set_reset(bool level) {
  if (RESET.size() == 0)
    SC_REPORT_ERROR("/dsdpv1/driver_cpu", (std::string(name()) + ": set_reset needs RESET to be bound").c_str());
  else
    set_pin(*RESET[0], level);
}

void DriverCpu::spend(const sc_core::sc_time& time) {
  keeper_.inc(time);
  if (keeper_.need_sync()) keeper_.sync();
}

bool DriverCpu::wait_for_intr0(const sc_core::sc_time& at_most) {
  sync();
  if (!intr0_fell_) wait(at_most, intr0_event_);
  keeper_.reset();
  return std::exchange(intr0_fell_, false);
}

void DriverCpu::sync() {
  if (keeper_.get_local_time() > sc_core::SC_ZERO_TIME) keeper_.sync();
}

void DriverCpu::set_pin(sc_core::sc_signal_inout_if<bool>& pin, bool level) {
  sync();
  pin.write(level);
  spend(options_.pin_write);
}

bool DriverCpu::get_pin(const sc_core::sc_in<bool>& pin) {
  sync();
  const bool level = pin.read();
  spend(options_.pin_read);
  return level;
}

std::uint8_t DriverCpu::access(tlm::tlm_command command, std::uint16_t address, std::uint8_t value) {
  const std::uint64_t before = sc_core::sc_time_stamp().value();
  sc_core::sc_time local = keeper_.get_local_time();
  payload_.set_command(command);
  payload_.set_address(address);
  payload_.set_data_ptr(&value);
  payload_.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
  socket->b_transport(payload_, local);
  ++accesses_;
  if (sc_core::sc_time_stamp().value() == before)
    ++accesses_ahead_;
  else
    keeper_.reset();  // the target has waited for the local time
  if (payload_.is_response_error()) report_failed_access();
  keeper_.set(local);
  spend(options_.overhead);
  return payload_.is_response_error() ? std::uint8_t{0xFF} : value;
}

void DriverCpu::report_failed_access() const {
  char what[40];
  std::snprintf(what, sizeof what, ": %s 0x%03X failed: ", payload_.is_read() ? "reading" : "writing",
                static_cast<unsigned>(payload_.get_address()));
  SC_REPORT_WARNING("/dsdpv1/driver_cpu", (name() + std::string(what) + payload_.get_response_string()).c_str());
}

}  // namespace dsdpv1::systemc
