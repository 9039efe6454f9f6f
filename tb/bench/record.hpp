#pragma once
// What a run has brought, as plain values: for expectations, the result file and the table.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/bytes.hpp"
#include "bus/time.hpp"
#include "model/profibus/dp_state.hpp"
#include "tb/chip/checks/recorder.hpp"
#include "tb/chip/chip_view.hpp"
#include "tb/chip/user_cpu/station_cpu.hpp"

namespace dsdpv1::tb {

using bus::Tick;

/// Something that happened: an event of a chip, an error of a driver, a flag of the bus monitor.
struct Occurrence {
  Tick at = 0;
  std::string station;  ///< name of the slave, "bus" for the monitor
  std::string code;     ///< stable: "PRM_IDENT", "DSDPV1_ERR_INIT_CRC", "BUS_COLLISION"
  profibus::Severity severity = profibus::Severity::kInfo;
  std::string text;
  bool allowed = false;  ///< a violation that the scenario lists
};

/// "info", "refusal", "violation".
const char* name(profibus::Severity severity);

/// What was refused at one station for one reason: however long the run, none is forgotten.
struct Refused {
  std::string station, code;
  std::string text;  ///< of the first time
  Tick first = 0, last = 0;
  std::uint64_t count = 0;
};

class Refusals {
 public:
  void count(const Occurrence& occurrence);
  /// By the first time.
  std::vector<Refused> list() const;

 private:
  std::map<std::pair<std::string, std::string>, Refused> entries_;  ///< by station and code
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
  std::string master_state;  ///< what its master makes of it, empty without one
  std::string master_reason;
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

/// What is done with violations that the checks of tb/chip/checks find.
enum class ChecksMode : std::uint8_t {
  kOff,     ///< nothing is checked
  kReport,  ///< listed
  kFail,    ///< listed, and those that the scenario does not allow fail the run
};

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
  bool left_out = false;  ///< of firmware that does not tell: not judged
};

/// How a run against a host outside kept to real time (serve).
struct Pacing {
  std::string port;
  std::uint64_t telegrams_from_host = 0, bytes_from_host = 0, bytes_to_host = 0;
  std::uint64_t held_back = 0;  ///< telegrams of the host that came before T_SYN or the slot time had ended
  Tick longest_held_back = 0;
  double error_mean_us = 0, error_max_us = 0;  ///< real minus simulated time
  std::uint64_t losses = 0;                    ///< how often the computer was too slow
  Tick lost = 0;                               ///< simulated time given up because of that
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
  bool passed = false, interrupted = false;
  Tick simulated = 0;
  double wall_s = 0;
  std::uint64_t telegrams = 0, wrong_telegrams = 0;
  std::uint64_t violations = 0;       ///< those that are not allowed, and with ChecksMode::kFail those of checks
  std::vector<MasterResult> masters;  ///< of class 1
  std::vector<SlaveResult> slaves;
  std::vector<Occurrence> occurrences;
  std::uint64_t occurrences_dropped = 0;  ///< beyond the first kKept
  std::vector<Refused> refused;           ///< by the first time
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
/// "OFFLINE", "WAIT_PRM", "WAIT_CFG", "DATA_EXCH".
const char* name(profibus::DpState state);

}  // namespace dsdpv1::tb
