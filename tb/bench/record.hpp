#pragma once
// The result of a run as plain values: for expectations, the result file and the table.
#include <algorithm>
#include <cstdint>
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
#include "tb/chip/user_cpu/place.hpp"
#include "tb/chip/user_cpu/station_cpu.hpp"
#include "tb/scenario/scenario.hpp"
#include "tb/serve/statistics.hpp"

namespace dsdpv1::tb {

using bus::Tick;

/// An event of a chip, an error of a driver, or a flag of the bus monitor.
struct Occurrence {
  Tick at = 0;
  std::string station;  ///< name of the slave, "bus" for the monitor
  std::string code;     ///< stable: "PRM_IDENT", "DSDPV1_ERR_INIT_CRC", "BUS_COLLISION"
  profibus::Severity severity = profibus::Severity::kInfo;
  std::string text;
  std::string place = {};                     ///< the cell concerned, as written in the chip's documents; empty: none
  bool allowed = false;                       ///< a violation that the scenario lists
  std::optional<user_cpu::Place> where = {};  ///< of the user's act that caused it
  bool judged = true;                         ///< if it is a violation
};

/// "info", "refusal", "violation".
const char* name(profibus::Severity severity);

/// All occurrences at one station with one code at one place, counted over the whole run.
struct Repeated {
  std::string station, code, place;
  std::string text;  ///< of the first occurrence
  Tick first = 0, last = 0;
  std::uint64_t count = 0;
  bool allowed = false;
  std::optional<user_cpu::Place> where = {};  ///< of the first
  bool judged = true;

  /// `words` writes the text of the first time.
  template <class Words>
  void add(Tick at, const Words& words, const std::optional<user_cpu::Place>& first_where = std::nullopt) {
    if (count == 0) {
      text = words();
      where = first_where;
      first = last = at;
    }
    add_again(at);
  }
  void add_again(Tick at) {
    ++count;
    last = std::max(last, at);
  }
};

class Repetitions {
 public:
  /// Where those like it are counted, from the first one on; stays where it is.
  Repeated& entry(const Occurrence& like);
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

/// The accesses of a chip's user through a socket of a SystemC platform.
struct SocketUse {
  std::uint64_t accesses = 0;
  std::uint64_t failed = 0;          ///< without TLM_OK_RESPONSE
  std::uint64_t ahead = 0;           ///< carried out ahead of simulation time
  Tick furthest = 0;                 ///< most that one was ahead at its end
  std::uint64_t late_pins = 0;       ///< changes of pins that its user moves, before accesses already carried out
  std::string late_pin;              ///< of the first ...
  Tick late_at = 0, late_until = 0;  ///< ... its time, and the end of the accesses
};

struct SlaveResult {
  std::string name;
  ChipStatus status;
  std::string master_state;   ///< state in its master, empty without one
  std::string master_reason;  ///< reason given by the master; empty without a problem
  std::string waits_for;      ///< for a slave that is not in data exchange: the blocking event of its chip
  Tsdr tsdr;
  user_cpu::UserCounters user;
  std::optional<user_cpu::BoardReport> board;  ///< of a board with a processor
  std::optional<SocketUse> socket;             ///< of a chip in a SystemC platform
  bus::Bytes inputs;
  std::optional<bus::Bytes> outputs;  ///< absent: its program does not report
};

struct MasterResult {
  std::string name;
  int address = 0;
  std::uint64_t cycles = 0;
  std::int64_t min_slave_interval_us = 0;
  bool interval_given = false;  ///< by the scenario; else the greatest of the slaves' GSD files
};

using scenario::ChecksMode;

/// A check on one slave.
struct CheckResult {
  std::string slave;
  const checks::Rule* rule = nullptr;
  checks::Limit limit;
  checks::Record record;
  std::uint64_t allowed = 0;              ///< violations that the scenario allows
  std::vector<checks::Violation> listed;  ///< the first kListed

  static constexpr std::size_t kListed = 20;
};

struct ExpectationResult {
  std::string text;
  int line = 0;
  bool passed = false;
  std::string seen;
  bool left_out = false;  ///< not judged: firmware does not report it, or the script keeps the slave away
  bool implied = false;   ///< from a master that has the slave; `line`: of the slave in the master's list
};

/// The first difference of model and RTL as text, one item a line.
struct LockstepDifference {
  Tick at = 0;
  std::string what;                  ///< pin or cell and both values: one line
  std::string last_telegram;         ///< on the line
  std::string last_access;           ///< of the user
  std::string dpram;                 ///< the chip's last access
  std::vector<std::string> events;   ///< the model's last ones
  std::vector<std::string> rulings;  ///< those of the pin, then those of the events: "H1"
  std::string slave = {};            ///< at which, in a scenario
};

/// Lockstep of model and RTL: counts of matches, and the first difference.
struct LockstepResult {
  std::uint64_t cycles = 0, pin_changes = 0, dpram_images = 0;
  std::optional<LockstepDifference> difference;
};

struct RunResult {
  std::string scenario, file, engine, view;
  bool interrupted = false;
  ChecksMode checks_mode = ChecksMode::kFail;
  bool expects_exchange = true;  ///< see ExchangeWatch; false: disabled by the scenario
  std::uint64_t checks_off = 0;  ///< disabled by the scenario, each counted once
  Tick simulated = 0;
  double wall_s = 0;
  std::uint64_t telegrams = 0, wrong_telegrams = 0;
  std::uint64_t violations = 0;       ///< those that are not allowed, including those of checks with ChecksMode::kFail
  std::uint64_t allowed = 0;          ///< those that the scenario allows, without those of checks
  std::uint64_t unjudged = 0;         ///< those of a host, without RunOptions::strict
  std::vector<MasterResult> masters;  ///< of class 1
  std::vector<SlaveResult> slaves;
  std::vector<Occurrence> occurrences;
  std::uint64_t occurrences_dropped = 0;  ///< beyond the first kKept
  std::vector<Repeated> refused;          ///< by the first time
  std::vector<Repeated> violated;         ///< by the first time, including allowed ones; without those of checks
  std::vector<ExpectationResult> expectations;
  std::vector<CheckResult> checks;  ///< by slave, then in the order of the chip's rules
  std::optional<Pacing> pacing;
  std::optional<LockstepResult> lockstep;  ///< engine lockstep
  std::string fault_registers;             ///< of the processor whose fault ended the run, a few lines; else empty

  static constexpr std::size_t kKept = 10'000;
  /// Simulated time divided by wall time, 0 without a measurement.
  double real_time_factor() const;
};

/// "at port.c:41 in wait()"; of an omission "in wait() at port.c:41 for 5.800 ms"; without a line "at 0x08000124".
std::string place_text(const user_cpu::Place& place);
/// The text, and the place if there is one: "inputs refused, at port.c:41 in wait()".
std::string with_place(const std::string& text, const std::optional<user_cpu::Place>& place);
/// The word for a baud index of Status: "12M" ... "9.6k", "searching".
std::string baud_text(std::optional<int> baud);
/// "fail", "report", "off", as in scenarios and options.
const char* name(ChecksMode mode);
/// "OFFLINE", "WAIT_PRM", "WAIT_CFG", "DATA_EXCH".
const char* name(profibus::DpState state);

}  // namespace dsdpv1::tb
