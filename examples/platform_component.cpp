// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// The chip as a component of a virtual platform, in the manner of vcml: one target socket of 64 bits with an address
// map, an active-high reset, one interrupt line, and the chip's parameters as properties that the platform sets.
//
// Properties are vcml::property or cci::cci_param where CMake finds these libraries, else a stand-in.
#include <tlm.h>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <cstdint>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include "model/systemc/dsdpv1_tlm.hpp"
#include "model/systemc/host_registers.hpp"
#include "model/systemc/parameters.hpp"

#if defined(WITH_VCML)
#include <vcml.h>
#elif defined(WITH_CCI)
#include <cci_configuration>
#endif

namespace {

using dsdpv1::systemc::each_parameter;
using dsdpv1::systemc::HostRegisters;
using dsdpv1::systemc::ParameterRow;
using dsdpv1::systemc::TlmModule;
using dsdpv1::systemc::TlmOptions;

#if defined(WITH_VCML)
using Property = vcml::property<std::uint32_t>;
using Settings = vcml::broker_arg;
#else

#if defined(WITH_CCI)
using Property = cci::cci_param<std::uint32_t>;

void preset(const std::string& name, std::uint32_t value) {
  cci::cci_get_global_broker(cci::cci_originator("platform")).set_preset_cci_value(name, cci::cci_value(value));
}
#else
std::map<std::string, std::uint32_t>& presets() {
  static std::map<std::string, std::uint32_t> values;
  return values;
}
void preset(const std::string& name, std::uint32_t value) { presets()[name] = value; }

/// A value with a name below the module that is being constructed; the platform may have set it before.
class Property {
 public:
  Property(const char* name, std::uint32_t initial) : value_(initial) {
    const sc_core::sc_object* parent = sc_core::sc_get_current_object();
    const auto given = presets().find(std::string(parent->name()) + "." + name);
    if (given != presets().end()) value_ = given->second;
  }
  operator std::uint32_t() const { return value_; }  // NOLINT(google-explicit-constructor)

 private:
  std::uint32_t value_;
};
#endif

/// Settings from the command line, as vcml has them: -c name=value.
struct Settings {
  Settings(int argc, const char* const* argv) {
    for (int i = 1; i + 1 < argc; i += 2) {
      const std::string setting = argv[i + 1];
      const std::size_t equals = setting.find('=');
      preset(setting.substr(0, equals), static_cast<std::uint32_t>(std::stoul(setting.substr(equals + 1))));
    }
  }
};
#endif

/// 0x0000: the DPRAM, 0x1000: the registers of the handshake.
class ProfibusSlave : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<ProfibusSlave, 64> in{"in"};
  sc_core::sc_in<bool> rst{"rst"};  ///< high-active: holds the chip in reset, whatever the register says
  sc_core::sc_port<sc_core::sc_signal_inout_if<bool>> irq{"irq"};

  explicit ProfibusSlave(const sc_core::sc_module_name& name)
      : sc_module(name), chip_("chip", options()), registers_("registers", {kRegisters}) {
    in.register_b_transport(this, &ProfibusSlave::b_transport);
    in.register_transport_dbg(this, &ProfibusSlave::transport_dbg);
    to_chip_.bind(chip_.host_socket_64);
    to_registers_.bind(registers_.socket_64);
    chip_.R_REQ(registers_.R_REQ), chip_.R_STA(registers_.R_STA), chip_.L_REQ(registers_.L_REQ);
    chip_.L_STA(registers_.L_STA), chip_.INTR0(registers_.INTR0), chip_.RESET(reset_);
    SC_HAS_PROCESS(ProfibusSlave);
    SC_METHOD(apply_reset);
    sensitive << rst << registers_.RESET;
    SC_METHOD(interrupt);
    sensitive << registers_.IRQ;
  }

 private:
  static constexpr sc_dt::uint64 kRegisters = 0x1000;

  TlmOptions options() {
    TlmOptions options;
    options.observed = 0;
    options.ownership = dsdpv1::systemc::Ownership::kWait;
    each_parameter(options.chip, [&](const ParameterRow& row, std::uint32_t& value) {
      properties_.push_back(std::make_unique<Property>(row.name.c_str(), value));
      value = *properties_.back();
    });
    return options;
  }
  auto& target_of(const tlm::tlm_generic_payload& payload) {
    return payload.get_address() < kRegisters ? to_chip_ : to_registers_;
  }
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
    target_of(payload)->b_transport(payload, delay);
  }
  unsigned int transport_dbg(tlm::tlm_generic_payload& payload) { return target_of(payload)->transport_dbg(payload); }
  void apply_reset() { reset_.write(registers_.RESET.read() && !rst.read()); }
  void interrupt() { irq->write(registers_.IRQ.read()); }

  std::vector<std::unique_ptr<Property>> properties_;
  TlmModule chip_;
  HostRegisters registers_;
  tlm_utils::simple_initiator_socket<ProfibusSlave, 64> to_chip_{"to_chip"}, to_registers_{"to_registers"};
  sc_core::sc_signal<bool> reset_{"reset"};
};

/// A CPU with nothing but a bus and a wait.
class Cpu : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<Cpu, 64> out{"out"};

  explicit Cpu(const sc_core::sc_module_name& name) : sc_module(name) {
    SC_HAS_PROCESS(Cpu);
    SC_THREAD(run);
  }

 private:
  void run() {
    wait(1, sc_core::SC_US);
    write(0x1000 + HostRegisters::kReset, 1);
    wait(50, sc_core::SC_US);
    for (take(); read(0x004) != 0xC5; take()) let_go();
    std::cout << "ready at " << sc_core::sc_time_stamp().to_seconds() * 1e6 << " us, version";
    for (int cell = 0; cell < 4; ++cell) std::cout << " " << unsigned{read(static_cast<sc_dt::uint64>(cell))};
    std::cout << "\n";
    let_go();
    sc_core::sc_stop();
  }
  void let_go() {
    write(0x1000 + HostRegisters::kRequest, 0);
    wait(2, sc_core::SC_US);
  }
  void take() {
    constexpr std::uint8_t kChipHasIt = HostRegisters::kLReq | HostRegisters::kLSta;
    write(0x1000 + HostRegisters::kRequest, HostRegisters::kReq);
    wait(63, sc_core::SC_NS);  // the chip may still begin an access (H2)
    while ((read(0x1000 + HostRegisters::kState) & kChipHasIt) != 0) {
    }
    write(0x1000 + HostRegisters::kRequest, HostRegisters::kReq | HostRegisters::kSta);
  }
  std::uint8_t read(sc_dt::uint64 address) {
    std::uint8_t value = 0;
    transport(tlm::TLM_READ_COMMAND, address, value);
    return value;
  }
  void write(sc_dt::uint64 address, std::uint8_t value) { transport(tlm::TLM_WRITE_COMMAND, address, value); }
  void transport(tlm::tlm_command command, sc_dt::uint64 address, std::uint8_t& value) {
    tlm::tlm_generic_payload payload;
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(&value);
    payload.set_data_length(1);
    payload.set_streaming_width(1);
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    out->b_transport(payload, delay);
    wait(delay);
    if (payload.is_response_error()) SC_REPORT_ERROR("/example", payload.get_response_string().c_str());
  }
};

}  // namespace

int sc_main(int argc, char* argv[]) {
#if defined(WITH_CCI)
  cci::cci_register_broker(new cci_utils::broker("broker"));
#endif
  const Settings settings(argc, argv);
  sc_core::sc_signal<bool> rst{"rst"}, irq{"irq"};
  ProfibusSlave slave{"slave"};
  Cpu cpu{"cpu"};
  cpu.out.bind(slave.in);
  slave.rst(rst), slave.irq(irq);
  sc_core::sc_start(sc_core::sc_time(10, sc_core::SC_MS));
  return 0;
}
