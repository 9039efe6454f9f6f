// A SystemC platform round the TLM module: a user CPU that brings the chip up with the C driver, and a bus station that
// asks it for its FDL status and prints the answer.
#include <tlm_utils/simple_initiator_socket.h>

#include <iostream>
#include <systemc>
#include <vector>

#include "driver/dsdpv1.h"
#include "model/systemc/dsdpv1_tlm.hpp"

using dsdpv1::systemc::BusCharacter;
using dsdpv1::systemc::TlmModule;
using sc_core::SC_NS;
using sc_core::SC_US;

namespace {

constexpr std::uint8_t kSlave = 9, kMaster = 2;

/// The user CPU: one thread that runs the driver; the driver's port is this module's socket and pins.
class Cpu : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<Cpu> socket{"socket"};
  sc_core::sc_out<bool> reset{"reset"}, r_req{"r_req"}, r_sta{"r_sta"};
  sc_core::sc_in<bool> l_req{"l_req"}, l_sta{"l_sta"};
  sc_core::sc_event initialised;

  explicit Cpu(const sc_core::sc_module_name& name) : sc_module(name) {
    SC_HAS_PROCESS(Cpu);
    SC_THREAD(run);
  }

 private:
  static Cpu& self(void* ctx) { return *static_cast<Cpu*>(ctx); }

  dsdpv1_port port() {
    dsdpv1_port p{};
    p.ctx = this;
    p.read = [](void* ctx, uint16_t address) { return self(ctx).transport(tlm::TLM_READ_COMMAND, address, 0); };
    p.write = [](void* ctx, uint16_t address, uint8_t value) {
      self(ctx).transport(tlm::TLM_WRITE_COMMAND, address, value);
    };
    p.set_r_req = [](void* ctx, bool level) { set_pin(self(ctx).r_req, level); };
    p.set_r_sta = [](void* ctx, bool level) { set_pin(self(ctx).r_sta, level); };
    p.get_l_req = [](void* ctx) { return get_pin(self(ctx).l_req); };
    p.get_l_sta = [](void* ctx) { return get_pin(self(ctx).l_sta); };
    p.pause = [](void* /*ctx*/, uint32_t ns) { sc_core::wait(ns, SC_NS); };
    return p;
  }

  // A GPIO access of an MCU takes its time; without it polling would stand still.
  static void set_pin(sc_core::sc_out<bool>& pin, bool level) {
    pin.write(level);
    sc_core::wait(50, SC_NS);
  }
  static bool get_pin(sc_core::sc_in<bool>& pin) {
    sc_core::wait(50, SC_NS);
    return pin.read();
  }

  uint8_t transport(tlm::tlm_command command, uint16_t address, uint8_t value) {
    tlm::tlm_generic_payload payload;
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(&value);
    payload.set_data_length(1);
    payload.set_streaming_width(1);
    socket->b_transport(payload, delay);
    if (payload.is_response_error()) std::cout << "access failed: " << payload.get_response_string() << "\n";
    return value;
  }

  void run() {
    r_req.write(false);
    r_sta.write(false);
    wait(1, SC_US);
    reset.write(true);
    const dsdpv1_port chip_port = port();
    dsdpv1_device device;
    dsdpv1_open(&device, &chip_port, nullptr);
    report("ready", dsdpv1_wait_ready(&device));
    report("initialised", dsdpv1_initialise(&device, &config()));
    initialised.notify();
  }

  static const dsdpv1_config& config() {
    static const uint8_t cfg[] = {0x13, 0x23};  // four bytes of inputs, four of outputs
    static dsdpv1_config c{};
    c.address = kSlave;
    c.ident = 0x0C0D;
    c.max_input = c.max_output = 4;
    c.max_cfg = c.cfg_length = sizeof cfg;
    c.cfg = cfg;
    return c;
  }

  static void report(const char* what, dsdpv1_error error) {
    std::cout << what << " at " << sc_core::sc_time_stamp().to_seconds() * 1e6 << " us: " << dsdpv1_error_text(error)
              << "\n";
  }
};

/// A station at the other end of the bus, at 12 Mbit/s.
class Station : public sc_core::sc_module, private tlm::tlm_analysis_if<BusCharacter> {
 public:
  sc_core::sc_port<tlm::tlm_analysis_if<BusCharacter>> send{"send"};
  sc_core::sc_export<tlm::tlm_analysis_if<BusCharacter>> receive{"receive"};

  Station(const sc_core::sc_module_name& name, const sc_core::sc_event& start) : sc_module(name), start_(start) {
    receive.bind(*this);
    SC_HAS_PROCESS(Station);
    SC_THREAD(run);
  }

 private:
  void run() {
    wait(start_);
    // The first error-free telegram only ends the baud rate search (S9).
    for (int attempt = 0; attempt < 2; ++attempt) {
      wait(100, SC_US);
      ask_fdl_status();
    }
    wait(100, SC_US);
    print_answer();
    sc_core::sc_stop();
  }

  void ask_fdl_status() {
    const std::uint8_t fc = 0x49;
    send_telegram({0x10, kSlave, kMaster, fc, static_cast<std::uint8_t>(kSlave + kMaster + fc), 0x16});
  }

  void send_telegram(const std::vector<std::uint8_t>& telegram) {
    const sc_core::sc_time bit(1.0 / 12e6, sc_core::SC_SEC);
    sc_core::sc_time start = sc_core::sc_time_stamp();
    for (const std::uint8_t byte : telegram) {
      send->write({start, bit, byte, true, true});
      start += 11 * bit;
    }
    sent_ = start;
    answer_.clear();
  }

  void write(const BusCharacter& character) override { answer_.push_back(character); }

  void print_answer() const {
    std::cout << "answer:";
    for (const BusCharacter& c : answer_) std::cout << " " << std::hex << unsigned{c.data} << std::dec;
    if (!answer_.empty())
      std::cout << ", TSDR " << (answer_.front().start - sent_) / answer_.front().bit << " bit times";
    std::cout << "\n";
  }

  const sc_core::sc_event& start_;
  sc_core::sc_time sent_{sc_core::SC_ZERO_TIME};
  std::vector<BusCharacter> answer_;
};

}  // namespace

int sc_main(int, char*[]) {
  dsdpv1::systemc::require_femtoseconds();
  TlmModule chip("chip");
  Cpu cpu("cpu");
  Station station("station", cpu.initialised);

  sc_core::sc_signal<bool> reset("reset"), r_req("r_req"), r_sta("r_sta"), l_req("l_req"), l_sta("l_sta");
  cpu.socket.bind(chip.host_socket);
  cpu.reset(reset), chip.RESET(reset);
  cpu.r_req(r_req), chip.R_REQ(r_req);
  cpu.r_sta(r_sta), chip.R_STA(r_sta);
  chip.L_REQ(l_req), cpu.l_req(l_req);
  chip.L_STA(l_sta), cpu.l_sta(l_sta);
  station.send.bind(chip.bus_in);
  chip.bus_out.bind(station.receive);

  sc_core::sc_start(1, sc_core::SC_SEC);
  return 0;
}
