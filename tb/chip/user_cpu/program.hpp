#pragma once
// The bench's commands to the program on a user CPU, and the program's counters, for any chip.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bus/time.hpp"
#include "tb/chip/user_cpu/acyclic.hpp"
#include "tb/chip/user_cpu/place.hpp"
#include "tb/chip/user_cpu/station_config.hpp"

namespace dsdpv1::user_cpu {

/// Source of the inputs.
enum class InputSource : std::uint8_t {
  kLoopBack,  ///< the last outputs, padded with zeros
  kCount,     ///< each byte counts the exchanges, modulo 256
  kConstant,  ///< ProgramOptions::constant, padded with zeros
  kIdle,      ///< inputs are written only once set by command::SetInputs
};

enum class Judgement : std::uint8_t { kAccept, kRefuse, kNever };

struct ProgramOptions {
  StationConfig station;
  Tick start_delay = 0;                 ///< from the CPU's start to the first access
  Tick period = 50 * bus::kTicksPerUs;  ///< from the start of one exchange to the next, > 0
  InputSource inputs = InputSource::kLoopBack;
  std::vector<std::uint8_t> constant;
  bool overwrite_inputs = true;        ///< false: inputs not taken by the chip yet are kept
  Judgement prm = Judgement::kAccept;  ///< judging mode 2 only
  Judgement cfg = Judgement::kAccept;
  Tick judge_delay = 0;                 ///< duration of a judgement
  bool judge_in_handler = true;         ///< false: the interrupt's handler only notes it, the main loop judges
  Tick retry_delay = bus::kTicksPerMs;  ///< pause before a failed initialisation is repeated
  int init_attempts = 0;                ///< 0: until it succeeds; else the program ends after so many
  AcyclicOptions acyclic;               ///< DPV1; polled after each exchange
};

enum class DiagnosisKind : std::uint8_t { kExtended, kExternal, kExternalGone, kStatic, kStaticGone };

/// Commands of the bench while the program runs.
namespace command {
/// Sets the inputs from now on, replacing ProgramOptions::inputs; sent with exactly this length.
struct SetInputs {
  std::vector<std::uint8_t> bytes;
};
struct SetDiagnosis {
  DiagnosisKind kind = DiagnosisKind::kExtended;
  std::vector<std::uint8_t> bytes;
};
struct Reinitialise {
  StationConfig station;
};
/// The program stops until Resume; it does not even judge.
struct Stop {};
struct Resume {};
/// Makes the next block of inputs one byte longer than configured, or shorter if that is impossible.
struct WrongLength {};
/// Sends a verdict withheld by Judgement::kNever.
struct SendVerdict {
  bool cfg = false;  ///< on the configuration; else on the parameters
  bool refuse = false;
};
/// Sets how acyclic requests are answered from now on.
struct SetAnswering {
  Answering answering = Answering::kNormal;
};
/// An order supported only by programs for one kind of chip (tb::ChipKind::orders).
struct OfChip {
  std::string order;
  Tick duration = 0;
  std::string block;
  int times = 1;
  std::vector<std::uint8_t> bytes = {};
  std::optional<int> listen = {};  ///< bytes
};
}  // namespace command

using Command =
    std::variant<command::SetInputs, command::SetDiagnosis, command::Reinitialise, command::Stop, command::Resume,
                 command::WrongLength, command::SendVerdict, command::SetAnswering, command::OfChip>;

/// A step of the program that failed.
struct ProgramError {
  Tick at = 0;
  std::string code;  ///< stable: in scenarios, logs and result files
  std::string text;
  std::optional<Place> where = {};  ///< in the program
};

struct ProgramCounters {
  std::uint64_t exchanges = 0;         ///< of cyclic data with the chip
  std::uint64_t outputs_received = 0;  ///< blocks of outputs received correctly
  std::uint64_t inputs_written = 0;    ///< blocks of inputs announced to the chip
  std::uint64_t initialisations = 0;   ///< successful ones
  std::uint64_t judgements = 0;        ///< blocks of parameters and configuration judged
  std::uint64_t driver_errors = 0;

  ProgramCounters& operator+=(const ProgramCounters& other) {
    exchanges += other.exchanges;
    outputs_received += other.outputs_received;
    inputs_written += other.inputs_written;
    initialisations += other.initialisations;
    judgements += other.judgements;
    driver_errors += other.driver_errors;
    return *this;
  }
};

/// Holds of a memory shared by chip and user. Times in ticks: a wait from request to ownership, a hold from ownership
/// to release. Zeros if nothing is shared.
struct HoldCounters {
  std::uint64_t holds = 0;
  std::uint64_t given_up = 0;  ///< requested and given up without ownership
  Tick longest_wait = 0;
  Tick longest_hold = 0;

  HoldCounters& operator+=(const HoldCounters& other) {
    holds += other.holds;
    given_up += other.given_up;
    longest_wait = std::max(longest_wait, other.longest_wait);
    longest_hold = std::max(longest_hold, other.longest_hold);
    return *this;
  }
};

/// The CPU's activity on its bus to the chip since the start.
struct CpuCounters {
  std::uint64_t accesses = 0;    ///< reads and writes
  std::uint64_t bad_reads = 0;   ///< of these, reads that sampled X or Z
  std::uint64_t interrupts = 0;  ///< handler runs

  CpuCounters& operator+=(const CpuCounters& other) {
    accesses += other.accesses;
    bad_reads += other.bad_reads;
    interrupts += other.interrupts;
    return *this;
  }
};

/// A user CPU's activity since its start.
struct UserCounters {
  HoldCounters port;
  std::optional<ProgramCounters> program = ProgramCounters();  ///< absent: the program does not report
  CpuCounters cpu;

  UserCounters& operator+=(const UserCounters& other) {
    port += other.port;
    if (program && other.program) *program += *other.program;
    if (!other.program) program.reset();
    cpu += other.cpu;
    return *this;
  }
};

}  // namespace dsdpv1::user_cpu
