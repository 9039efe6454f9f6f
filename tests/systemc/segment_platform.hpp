#pragma once
// A platform with three chips on one segment: two DSDPV1 with one address, which answer at once from when the second is
// initialised, and a VPC3+; a master of class 1, and a station that disturbs. The chips are at the segment as a whole
// (SegmentModule::attach) or by their pins (SegmentPort).
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "bus/master/master1.hpp"
#include "driver/systemc/spc3_cpu.hpp"
#include "registers/spc3_regs.h"
#include "tb/systemc/segment_module.hpp"
#include "tb/systemc/segment_port.hpp"
#include "tests/systemc/platform.hpp"

namespace dsdpv1::segment_platform {

using dsdpv1::systemc::DriverCpu;
using dsdpv1::systemc::Spc3DriverCpu;
using platform::to_time;
using systemc_bench::HeardCharacter;
using systemc_bench::SegmentModule;

constexpr std::uint8_t kFirst = platform::kSlave, kVpc3 = 11, kMaster = 2;
constexpr int kInitialiseSecondMs = 4;
constexpr Tick kDisturb = 3000 * kUs, kEnd = 6000 * kUs;

struct Choice {
  bool pins = false;      ///< at the segment by pins
  bool observed = false;  ///< `on_pin` is set
  bool disturbs = true;
  double quantum_us = 0;
  double femtoseconds = 1;
};

/// A driver without manners: characters at times that follow no rule, some in the middle of others'.
class Disturber : public bus::Agent {
 public:
  explicit Disturber(bus::Segment& segment) : sender_(segment, segment.attach("disturber", nullptr)) {
    sender_.set_timing(bus::baud(0).bit);
  }
  bus::Tick next() const override { return sender_.busy() ? sender_.next() : due_; }
  void run(bus::Tick now) override {
    if (sender_.busy()) return sender_.run(now);
    sender_.send(now, bus::characters({static_cast<std::uint8_t>(due_), 0x55}));
    due_ = now + 37 * kUs + (due_ * 7919) % (11 * kUs);
    sender_.run(now);
  }

 private:
  bus::UartSender sender_;
  bus::Tick due_ = kDisturb;
};

/// A chip's pins of the line at the segment.
struct Wires {
  sc_core::sc_signal<bool> rxd, txd, rts;
  systemc_bench::SegmentPort port;

  Wires(const std::string& name, SegmentModule& line)
      : rxd((name + "_rxd").c_str(), true),
        txd((name + "_txd").c_str(), true),
        rts((name + "_rts").c_str()),
        port((name + "_port").c_str(), line.segment(), line.agents()) {
    port.PBRXD(rxd), port.PBTXD(txd), port.PBRTS(rts);
  }
  void bind(dsdpv1::systemc::TlmModule& chip) { chip.PBRXD(rxd), chip.PBTXD(txd), chip.PBRTS(rts); }
  void bind(dsdpv1::systemc::Spc3TlmModule& chip) { chip.RXD(rxd), chip.TXD(txd), chip.RTS(rts); }
};

/// A DSDPV1 with its user CPU.
struct Device {
  platform::User user;
  dsdpv1::systemc::TlmModule chip;
  DriverCpu cpu;
  sc_core::sc_signal<bool> reset, r_req, r_sta, l_req, l_sta, intr0;

  Device(const char* name, Tick phase, const sc_core::sc_time& begins)
      : chip(name, options(phase)), cpu((std::string(name) + "_cpu").c_str(), [this, begins](DriverCpu& itself) {
          itself.spend(begins);
          user.run(itself);
        }) {
    cpu.socket.bind(chip.host_socket);
    cpu.RESET(reset), cpu.R_REQ(r_req), cpu.R_STA(r_sta), cpu.L_REQ(l_req), cpu.L_STA(l_sta), cpu.INTR0(intr0);
    chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(r_sta), chip.L_REQ(l_req), chip.L_STA(l_sta), chip.INTR0(intr0);
  }
  static dsdpv1::systemc::TlmOptions options(Tick phase) {
    dsdpv1::systemc::TlmOptions options;
    options.phase = phase;
    options.observed &= ~dsdpv1::systemc::kHostPins;
    return options;
  }
};

/// A VPC3+ with its user CPU.
struct Spc3Device {
  dsdpv1::systemc::Spc3TlmModule chip{"vpc3", options()};
  Spc3DriverCpu cpu{"vpc3_cpu", [this](Spc3DriverCpu& itself) { run(itself); }};
  sc_core::sc_signal<bool> reset{"vpc3_reset"}, x_int{"x_int", true};
  std::ostringstream log;

  Spc3Device() {
    cpu.socket.bind(chip.host_socket);
    chip.RESET(reset), cpu.RESET(reset), chip.X_INT(x_int), cpu.X_INT(x_int);
  }
  static dsdpv1::systemc::Spc3TlmOptions options() {
    dsdpv1::systemc::Spc3TlmOptions options;
    options.chip.variant = spc3::Variant::kVpc3;
    options.phase = 100;
    return options;
  }

 private:
  void bring_up() {
    static const std::uint8_t cfg[] = {0x13, 0x23};
    spc3_config config{};
    config.address = kVpc3;
    config.ident = 0x0CC9;
    config.max_input = config.max_output = 4;
    config.max_prm = 10;
    config.max_cfg = config.cfg_length = sizeof cfg;
    config.cfg = cfg;
    config.vpc3 = true;
    config.interrupts = SPC3_REG_EVENT_MAC_RESET | SPC3_REG_EVENT_NEW_CFG | SPC3_REG_EVENT_NEW_PRM;
    while (spc3_initialise(&cpu.device(), &config) == SPC3_ERR_NOT_OFFLINE) cpu.spend({10, sc_core::SC_US});
    const std::uint8_t inputs[4] = {};
    spc3_set_inputs(&cpu.device(), inputs, sizeof inputs);
    spc3_start(&cpu.device());
  }

  void run(Spc3DriverCpu& itself) {
    itself.set_reset(true);
    itself.spend({1, sc_core::SC_US});
    itself.set_reset(false);
    bring_up();
    std::uint8_t bytes[4] = {};
    for (;;) {
      if (itself.wait_for_interrupt({100, sc_core::SC_US}))
        log << "tick " << platform::to_tick(itself.now()) << " events " << spc3_service(&itself.device()) << "\n";
      spc3_outputs outputs{bytes, sizeof bytes, 0, false, false};
      if (spc3_get_outputs(&itself.device(), &outputs) != SPC3_OK || !outputs.fresh) continue;
      log << "tick " << platform::to_tick(itself.now()) << " outputs " << unsigned{bytes[0]} << "\n";
      spc3_set_inputs(&itself.device(), bytes, sizeof bytes);
      spc3_serve_watchdog(&itself.device());
    }
  }
};

class Platform : tlm::tlm_analysis_if<HeardCharacter> {
 public:
  SegmentModule line{"line"};
  bus::Master1 master{line.segment(), master_config()};
  Device first{"first", 0, {1, sc_core::SC_US}}, second{"second", 17, {kInitialiseSecondMs, sc_core::SC_MS}};
  Spc3Device vpc3;
  std::uint64_t collided = 0;

  explicit Platform(const Choice& choice) {
    line.heard.bind(*this);
    line.add(master);
    if (choice.disturbs) line.add(disturber_.emplace_back(std::make_unique<Disturber>(line.segment())).operator*());
    for (const std::uint8_t address : {kFirst, kVpc3}) master.add_slave(slave(address));
    master.on_state = [this](bus::Tick at, std::uint8_t address, bus::SlaveState, bus::SlaveState to) {
      log_ << "tick " << at << " slave " << unsigned{address} << " is " << bus::name(to) << "\n";
    };
    for (Device* device : {&first, &second}) connect(choice, *device);
    connect(choice, vpc3);
    master.start();
  }

  bus::SlaveState state(std::uint8_t address) { return master.slave(address).state; }
  /// The reports of master, line and chips, and their memories at the end.
  std::string told() {
    std::ostringstream out;
    out << "master:\n" << log_.str() << "line:\n" << characters_.str();
    for (const auto& [name, log] : chips_) out << "events and pins of " << name << ":\n" << log.str();
    out << first.user.log.str() << second.user.log.str() << vpc3.log.str();
    for (Device* device : {&first, &second}) memory(device->chip, 0x800, out);
    memory(vpc3.chip, 0x800, out);
    return out.str();
  }

 private:
  static bus::MasterConfig master_config() {
    bus::MasterConfig own;
    own.address = kMaster;
    own.baud = 0;
    return own;
  }
  static bus::SlaveParameters slave(std::uint8_t address) {
    bus::SlaveParameters parameters;
    parameters.address = address;
    parameters.ident = address == kVpc3 ? 0x0CC9 : 0x0C0D;
    parameters.cfg = {0x13, 0x23};
    parameters.input_length = parameters.output_length = 4;
    return parameters;
  }

  template <class Any>
  void connect(const Choice& choice, Any& device) {
    const std::string name = device.chip.basename();
    if (choice.pins) {
      wires_.push_back(std::make_unique<Wires>(name, line));
      wires_.back()->bind(device.chip);
    } else {
      line.attach(device.chip);
    }
    std::ostream& log = chips_[name];
    device.chip.on_event = [&log](const profibus::Event& event) {
      log << "tick " << event.at << " " << profibus::code(event.reason) << "\n";
    };
    if (!choice.observed) return;
    device.chip.on_pin = [&log](Tick at, auto pin, Level level) {
      log << "tick " << at << " pin " << static_cast<int>(pin) << " = " << level << "\n";
    };
  }

  void write(const HeardCharacter& heard) override {
    characters_ << "tick " << platform::to_tick(heard.start) << ": " << unsigned{heard.data}
                << (heard.parity_ok ? "" : " parity") << (heard.stop_ok ? "" : " stop")
                << (heard.collided ? " collided\n" : "\n");
    collided += heard.collided ? 1 : 0;
  }

  template <class Chip>
  static void memory(Chip& chip, std::uint16_t size, std::ostream& out) {
    chip.sync();
    for (std::uint16_t cell = 0; cell < size; ++cell)
      out << unsigned{chip.peek(cell)} << (cell % 32 == 31 ? "\n" : " ");
  }

  std::vector<std::unique_ptr<Disturber>> disturber_;
  std::vector<std::unique_ptr<Wires>> wires_;
  std::ostringstream log_, characters_;
  std::map<std::string, std::ostringstream> chips_;
};

}  // namespace dsdpv1::segment_platform
