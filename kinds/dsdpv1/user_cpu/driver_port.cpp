#include "kinds/dsdpv1/user_cpu/driver_port.hpp"

namespace dsdpv1::user_cpu {

dsdpv1_port DriverPort::port() {
  dsdpv1_port port{};
  port.ctx = this;
  port.read = [](void* ctx, std::uint16_t address) { return static_cast<DriverPort*>(ctx)->cpu_.read(address); };
  port.write = [](void* ctx, std::uint16_t address, std::uint8_t value) {
    static_cast<DriverPort*>(ctx)->write(address, value);
  };
  port.set_r_req = [](void* ctx, bool level) { static_cast<DriverPort*>(ctx)->set_r_req(level); };
  port.set_r_sta = [](void* ctx, bool level) { static_cast<DriverPort*>(ctx)->set_r_sta(level); };
  port.get_l_req = [](void* ctx) { return static_cast<DriverPort*>(ctx)->look(&Cpu::l_req); };
  port.get_l_sta = [](void* ctx) { return static_cast<DriverPort*>(ctx)->look(&Cpu::l_sta); };
  port.pause = [](void* ctx, std::uint32_t ns) { static_cast<DriverPort*>(ctx)->pause(ns); };
  return port;
}

void DriverPort::corrupt_writes(std::uint16_t address, std::uint8_t mask, int times) {
  corruptions_[address] = {mask, times};
}

void DriverPort::write(std::uint16_t address, std::uint8_t value) {
  const auto found = corruptions_.find(address);
  if (found != corruptions_.end()) {
    value = static_cast<std::uint8_t>(value ^ found->second.mask);
    if (--found->second.times <= 0) corruptions_.erase(found);
  }
  cpu_.write(address, value);
}

void DriverPort::set_r_req(bool level) {
  handshake_.r_req(cpu_.now(), level);
  cpu_.set_r_req(level);
}

void DriverPort::set_r_sta(bool level) {
  if (level) cpu_.wait_until(handshake_.asked_at() + cpu_.timing().r_req_to_r_sta);
  handshake_.r_sta(cpu_.now(), level);
  cpu_.set_r_sta(level);
}

bool DriverPort::look(bool (Cpu::*pin)()) {
  cpu_.wait_until(handshake_.asked_at() + cpu_.timing().r_req_to_sample);
  return (cpu_.*pin)();
}

/// Short pauses are the synchroniser window, long ones come from the driver's polling.
void DriverPort::pause(std::uint32_t ns) {
  constexpr std::uint32_t kPolling = 1000;
  const Tick asked = static_cast<Tick>(ns) * bus::kTicksPerNs;
  cpu_.wait(ns < kPolling ? asked : cpu_.timing().poll_interval);
}

}  // namespace dsdpv1::user_cpu
