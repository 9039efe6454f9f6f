#pragma once
// What a run has brought, as plain values: for expectations, the result file and the table.
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "bus/bytes.hpp"
#include "bus/time.hpp"
#include "model/profibus/dp_state.hpp"
#include "tb/chip/checks/recorder.hpp"
#include "tb/chip/chip_view.hpp"
#include "tb/chip/user_cpu/station_cpu.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

using bus::Tick;

/// Something that happened: an event of a chip, an error of a driver, a flag of the bus monitor.
struct Occurrence {
  Tick at = 0;
  std::string station;  ///< name of the slave, "bus" for the monitor
  std::string code;     ///< stable: "PRM_IDENT", "DSDPV1_ERR_INIT_CRC", "BUS_COLLISION"
  profibus::Severity severity = profibus::Severity::kInfo;
  std::string text;
  std::string place = {};  ///< the cell that it is about, as its documents write it; empty: none
  bool allowed = false;    ///< a violation that the scenario lists
};

/// "info", "refusal", "violation".
const char* name(profibus::Severity severity);

/// What happened at one station with one code at one place: however long the run, none is forgotten.
struct Repeated {
  std::string station, code, place;
  std::string text;  ///< of the first time
  Tick first = 0, last = 0;
  std::uint64_t count = 0;
  bool allowed = false;
};

class Repetitions {
 public:
  /// `text` writes the words of one that comes for the first time.
  void count(const Occurrence& occurrence, const std::function<std::string()>& text);
  /// By the first time.
  std::vector<Repeated> list() const;

 private:
  std::map<std::tuple<std::string, std::string, std::string>, Repeated> entries_;  ///< by station, code, place
};

/// Answers of one slave, measured by the monitor.
struct Tsdr {
  std::uint64_t answers = 0;
  double min_bits = 0, max_bits = 0;
  void add(double bits);
};

struct SlaveResult {
  std::string name;
  ChipStatus status;
  std::string master_state;   ///< what its master makes of it, empty without one
  std::string master_reason;  ///< what it has met, empty when all is well
  std::string waits_for;      ///< of a slave that is not in data exchange: what stands in the way, as its chip has said
  Tsdr tsdr;
  user_cpu::UserCounters user;
  std::optional<user_cpu::BoardReport> board;  ///< of a board with a processor of its own
  bus::Bytes inputs;
  std::optional<bus::Bytes> outputs;  ///< absent: its program does not tell
};

struct MasterResult {
  std::string name;
  int address = 0;
  std::uint64_t cycles = 0;
  std::int64_t min_slave_interval_us = 0;
  bool interval_given = false;  ///< by the scenario; else it is the greatest of the slaves' GSD files
};

using scenario::ChecksMode;

/// A check on one slave.
struct CheckResult {
  std::string slave;
  const checks::Rule* rule = nullptr;
  checks::Limit limit;
  checks::Record record;
  std::uint64_t allowed = 0;              ///< violations that the scenario lists
  std::vector<checks::Violation> listed;  ///< the first kListed

  static constexpr std::size_t kListed = 20;
};

struct ExpectationResult {
  std::string text;
  int line = 0;
  bool passed = false;
  std::string seen;
  bool left_out = false;  ///< not judged: of firmware that does not tell, or the script keeps the slave away
  bool implied = false;   ///< by a master that has the slave; `line`: of the slave in the master's list
};

/// What a host outside has sent and heard (serve).
struct HostLineStatistics {
  std::uint64_t telegrams = 0;    ///< handed over by the host
  std::uint64_t sent_bytes = 0;   ///< by the host
  std::uint64_t heard_bytes = 0;  ///< by the host
  std::uint64_t held_back = 0;    ///< its telegrams that came before T_SYN or the slot time had ended
  Tick longest_held_back = 0;
};

/// How simulated time kept to real time (serve).
struct PaceStatistics {
  std::uint64_t samples = 0;
  double error_sum_us = 0, error_max_us = 0;  ///< how long after its simulated time an instant was carried out
  std::uint64_t losses = 0;                   ///< how often the computer was too slow, and time was given up
  Tick lost = 0;                              ///< simulated time given up in total

  double error_mean_us() const { return samples == 0 ? 0 : error_sum_us / static_cast<double>(samples); }
};

/// A run against a host outside (serve).
struct Pacing {
  std::string port;
  HostLineStatistics line;
  PaceStatistics pace;
};

/// Model and RTL side by side: what was the same, and where they first differ.
struct LockstepResult {
  std::uint64_t cycles = 0, pin_changes = 0, dpram_images = 0;
  struct Difference {
    std::string slave;
    Tick at = 0;
    std::string what, last_telegram, last_access, dpram;  ///< in words
  };
  std::optional<Difference> difference;
};

struct RunResult {
  std::string scenario, file, engine, view;
  bool interrupted = false;
  ChecksMode checks_mode = ChecksMode::kFail;
  bool expects_exchange = true;  ///< see ExchangeWatch; false: the scenario wants none
  std::uint64_t checks_off = 0;  ///< that the scenario leaves out, each counted once
  Tick simulated = 0;
  double wall_s = 0;
  std::uint64_t telegrams = 0, wrong_telegrams = 0;
  std::uint64_t violations = 0;       ///< those that are not allowed, and with ChecksMode::kFail those of checks
  std::uint64_t allowed = 0;          ///< those that the scenario lists, those of checks apart
  std::vector<MasterResult> masters;  ///< of class 1
  std::vector<SlaveResult> slaves;
  std::vector<Occurrence> occurrences;
  std::uint64_t occurrences_dropped = 0;  ///< beyond the first kKept
  std::vector<Repeated> refused;          ///< by the first time
  std::vector<Repeated> violated;         ///< likewise, those that are allowed too; those of checks apart
  std::vector<ExpectationResult> expectations;
  std::vector<CheckResult> checks;  ///< by slave, then in the order of the chip's rules
  std::optional<Pacing> pacing;
  std::optional<LockstepResult> lockstep;  ///< engine lockstep
  std::string fault_registers;             ///< of the processor whose fault ended the run, a few lines; else empty

  static constexpr std::size_t kKept = 10'000;
  /// Simulated time over wall time, 0 when nothing was measured.
  double real_time_factor() const;
};

/// The word for a baud index of Status: "12M" ... "9.6k", "searching".
std::string baud_text(std::optional<int> baud);
/// "fail", "report", "off", as scenarios and options have them.
const char* name(ChecksMode mode);
/// "OFFLINE", "WAIT_PRM", "WAIT_CFG", "DATA_EXCH".
const char* name(profibus::DpState state);

}  // namespace dsdpv1::tb
