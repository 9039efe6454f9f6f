#pragma once
// Firmware compiled for the host as a user CPU: a process that makes its accesses to the chip through
// driver/host/dsdpv1_bench.h. Simulated time stands still while it computes.
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "driver/host/dsdpv1_bench_wire.h"
#include "kinds/dsdpv1/user_cpu/callers.hpp"
#include "kinds/dsdpv1/user_cpu/child_process.hpp"
#include "kinds/dsdpv1/user_cpu/orders.hpp"
#include "kinds/dsdpv1/user_cpu/serial_port.hpp"
#include "kinds/user_cpu/act_log.hpp"
#include "kinds/user_cpu/handshake_counters.hpp"
#include "kinds/user_cpu/native_cpu.hpp"
#include "tb/chip/user_cpu/station_cpu.hpp"

namespace dsdpv1::user_cpu {

/// Code of its end in logs and results.
constexpr const char* kProcessEnded = "PROCESS_ENDED";

struct ProcessOptions {
  std::vector<std::string> arguments;                           ///< the program's path and its arguments
  int patience_ms = 0;                                          ///< of the host's time without a request; 0: no limit
  std::function<PlaceOf(const std::string& program)> lines_of;  ///< null: its places are not known
};

class ProcessUser : public StationCpu {
 public:
  /// The program starts at `start`.
  ProcessUser(HostBus& bus, const CpuTiming& timing, ProcessOptions options, Tick start, const HostPort& port);

  Tick next() const override { return cpu_.next(); }
  void run(Tick now) override { cpu_.run(now); }
  void set_others(Others* others) override { cpu_.others = others; }
  void interrupt_changed(Tick at, bool level) override {
    cpu_.intr0_changed(at, level);
    announce();
  }
  /// Carries out those for the port; scenarios with commands for its program are refused.
  void command(Tick now, const Command& command) override;
  UserCounters counters() const override;
  bool tells() const override { return false; }
  bool carries_out(const std::string& word) const override { return word == kSpoilReads; }
  std::uint64_t outputs_received() const override { return 0; }
  const std::vector<std::uint8_t>& outputs() const override { return no_outputs_; }
  std::optional<Place> where(const Act& act) const override;

 private:
  using Request = dsdpv1_bench_request;
  using Answer = dsdpv1_bench_answer;

  void serve(Cpu& cpu);
  bool serve_one(Cpu& cpu);
  bool receive_callers(const Request& request);
  bool begin(const Request& request);
  void note_act(Tick now, const Request& request);
  bool carry_out(Cpu& cpu, const Request& request, Answer& answer);
  bool transfer(const Request& request, Answer& answer);
  bool receive(void* bytes, std::size_t n);
  void fail(const std::string& why);
  const Place& place_of(std::uint32_t callers) const;

  HostBus& bus_;
  ProcessOptions options_;
  HostPort port_;
  std::unique_ptr<ChildProcess> child_;
  std::unique_ptr<SerialPort> serial_;  ///< of a chip with SPI or UART in use
  HandshakeCounters handshake_;
  std::vector<std::uint8_t> bytes_;  ///< of the present transfer
  std::vector<std::uint8_t> no_outputs_;
  std::uint64_t load_address_ = 0;  ///< of the program, less that in its file
  std::string program_;             ///< its file
  std::vector<std::uint64_t> addresses_;
  std::vector<std::uint32_t> own_addresses_;  ///< of these those in the file
  std::optional<std::uint32_t> present_;      ///< the callers' number for the present request
  struct Look {
    Tick at = -1;
    std::uint32_t callers = 0;
  };
  std::array<Look, 2> looks_;  ///< the last ones at L_REQ and L_STA
  mutable Callers callers_;    ///< looks places up when they are asked for ...
  mutable PlaceOf lines_;
  mutable ActLog acts_;  ///< ... and takes the samples up to then
  NativeCpu cpu_;        // destroyed before everything that its fiber uses
};

}  // namespace dsdpv1::user_cpu
