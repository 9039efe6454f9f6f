// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// A SystemC platform around the TLM module: a user CPU that brings the chip up with the C driver, and a bus station
// that requests its FDL status and prints the answer.
#include <iostream>
#include <systemc>
#include <vector>

#include "driver/dsdpv1.h"
#include "driver/systemc/driver_cpu.hpp"
#include "model/systemc/dsdpv1_tlm.hpp"

using dsdpv1::systemc::BusCharacter;
using dsdpv1::systemc::DriverCpu;
using dsdpv1::systemc::TlmModule;
using dsdpv1::systemc::to_time;
using sc_core::SC_US;

namespace {

constexpr std::uint8_t kSlave = 9, kMaster = 2;

const dsdpv1_config& config() {
  static const uint8_t cfg[] = {0x13, 0x23};  // four bytes of inputs, four of outputs
  static dsdpv1_config c{};
  c.address = kSlave;
  c.ident = 0x0C0D;
  c.max_input = c.max_output = 4;
  c.max_cfg = c.cfg_length = sizeof cfg;
  c.cfg = cfg;
  return c;
}

void report(const DriverCpu& cpu, const char* what, dsdpv1_error error) {
  std::cout << what << " at " << cpu.now().to_seconds() * 1e6 << " us: " << dsdpv1_error_text(error) << "\n";
}

/// The program of the user CPU.
void bring_up(DriverCpu& cpu, sc_core::sc_event& initialised) {
  cpu.spend(sc_core::sc_time(1, SC_US));
  cpu.set_reset(true);
  report(cpu, "ready", dsdpv1_wait_ready(&cpu.device()));
  report(cpu, "initialised", dsdpv1_initialise(&cpu.device(), &config()));
  cpu.sync();
  initialised.notify();
}

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
    constexpr dsdpv1::systemc::Tick kBit = 1000, kCharacter = 11 * kBit;  // 12 Mbit/s
    dsdpv1::systemc::Tick start = dsdpv1::systemc::current_tick();
    for (const std::uint8_t byte : telegram) {
      send->write(
          {to_time(start), to_time(kBit), byte, true, true});  // each time is rounded once, so errors do not accumulate
      start += kCharacter;
    }
    sent_ = to_time(start);
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
  TlmModule chip("chip");
  sc_core::sc_event initialised("initialised");
  DriverCpu cpu("cpu", [&initialised](DriverCpu& itself) { bring_up(itself, initialised); });
  Station station("station", initialised);

  sc_core::sc_signal<bool> reset("reset"), r_req("r_req"), r_sta("r_sta"), l_req("l_req"), l_sta("l_sta");
  cpu.socket.bind(chip.host_socket);
  cpu.RESET(reset), chip.RESET(reset);
  cpu.R_REQ(r_req), chip.R_REQ(r_req);
  cpu.R_STA(r_sta), chip.R_STA(r_sta);
  chip.L_REQ(l_req), cpu.L_REQ(l_req);
  chip.L_STA(l_sta), cpu.L_STA(l_sta);
  station.send.bind(chip.bus_in);
  chip.bus_out.bind(station.receive);

  sc_core::sc_start(1, sc_core::SC_SEC);
  return 0;
}
