#pragma once
// The standard user program: the firmware of a simple device, made of the driver. It initialises the chip, then
// exchanges inputs and outputs at a fixed period, judges what the master sends, and carries out what the bench asks of
// it.
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "driver/dsdpv1.h"
#include "tb/user_cpu/acyclic_server.hpp"
#include "tb/user_cpu/driver_port.hpp"
#include "tb/user_cpu/native_cpu.hpp"
#include "tb/user_cpu/station_config.hpp"

namespace user_cpu {

/// What the inputs are made of.
enum class InputSource : std::uint8_t {
  kLoopBack,  ///< the last outputs, zeros where the inputs are longer
  kCount,     ///< each byte counts the exchanges, modulo 256
  kConstant,  ///< ProgramOptions::constant, zeros where it is shorter
  kIdle,      ///< inputs are written only once set by command::SetInputs
};

enum class Judgement : std::uint8_t { kAccept, kRefuse, kNever };

struct ProgramOptions {
  StationConfig station;
  Tick start_delay = 0;                 ///< from the CPU's start to the first access
  Tick period = 50 * bus::kTicksPerUs;  ///< from the start of one exchange to the next, > 0
  InputSource inputs = InputSource::kLoopBack;
  std::vector<std::uint8_t> constant;
  dsdpv1_input_policy policy = DSDPV1_INPUT_NEWEST;
  Judgement prm = Judgement::kAccept;  ///< judging mode 2 only
  Judgement cfg = Judgement::kAccept;
  Tick judge_delay = 0;                 ///< time that a judgement takes
  bool judge_in_handler = true;         ///< false: the handler notes INTR0, the main loop judges
  Tick retry_delay = bus::kTicksPerMs;  ///< pause before a failed initialisation is repeated
  int init_attempts = 0;                ///< 0: until it succeeds; else the program ends after so many
  AcyclicOptions acyclic;               ///< DPV1; polled behind each exchange
};

/// What the bench may ask for while the program runs.
namespace command {
/// From now on these are the inputs, whatever ProgramOptions::inputs says; their length is sent as it is.
struct SetInputs {
  std::vector<std::uint8_t> bytes;
};
struct SetDiagnosis {
  dsdpv1_diag_type type = DSDPV1_DIAG_EXTENDED;
  std::vector<std::uint8_t> bytes;
};
struct Reinitialise {
  StationConfig station;
};
/// Takes the DPRAM and keeps it for `duration`.
struct Hold {
  Tick duration = 0;
};
/// The program does nothing at all until Resume, not even judge.
struct Stop {};
struct Resume {};
/// Breaks rule H2: R_STA rises `after` R_REQ without a look at L_REQ and L_STA; then both fall after `hold`.
struct EarlyRSta {
  Tick after = 250;
  Tick hold = 12'000;
};
enum class Area : std::uint8_t { kInit, kInputs, kDiagnosis, kC1Answer, kC2Answer };
/// The CRC of the next `times` blocks of that kind is written wrong.
struct WrongCrc {
  Area area = Area::kInputs;
  int times = 1;
};
/// The next block of inputs is one byte longer than configured, shorter where that is impossible.
struct WrongLength {};
/// A verdict that Judgement::kNever kept back.
struct SendVerdict {
  bool cfg = false;  ///< on the configuration; else on the parameters
  bool refuse = false;
};
/// How acyclic requests are answered from now on.
struct SetAnswering {
  Answering answering = Answering::kNormal;
};
}  // namespace command

using Command = std::variant<command::SetInputs, command::SetDiagnosis, command::Reinitialise, command::Hold,
                             command::Stop, command::Resume, command::EarlyRSta, command::WrongCrc,
                             command::WrongLength, command::SendVerdict, command::SetAnswering>;

/// A call of the driver that did not return DSDPV1_OK.
struct DriverError {
  Tick at = 0;
  dsdpv1_error error = DSDPV1_OK;
  const char* during = "";  ///< "initialise", "exchange" ...
};

struct ProgramCounters {
  std::uint64_t exchanges = 0;         ///< calls of dsdpv1_exchange
  std::uint64_t outputs_received = 0;  ///< blocks of outputs with the right CRC
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

/// The program and what the bench sees of it. Not copied, and must outlive the CPU that runs it.
class UserProgram {
 public:
  explicit UserProgram(ProgramOptions options) : options_(std::move(options)) {}
  UserProgram(const UserProgram&) = delete;
  UserProgram& operator=(const UserProgram&) = delete;

  /// For NativeCpu: `NativeCpu cpu(bus, timing, program.entry());`
  NativeCpu::Program entry();
  /// Carried out in order, each as soon as the program has finished what it is at; call NativeCpu::wake afterwards, or
  /// it waits for the next exchange. Allowed before the program runs.
  void post(const Command& command) { commands_.push_back(command); }

  /// Told of every driver error, besides the log.
  std::function<void(const DriverError&)> on_error;

  const ProgramCounters& counters() const { return counters_; }
  const PortCounters& port_counters() const { return port_ ? port_->counters() : before_start_; }
  /// All errors so far, at most 1000; later ones are only counted.
  const std::vector<DriverError>& errors() const { return errors_; }
  const std::vector<std::uint8_t>& outputs() const { return outputs_; }
  const std::vector<std::uint8_t>& inputs() const { return inputs_; }
  /// Zeros without DPV1.
  AcyclicCounters acyclic_counters() const { return acyclic_ ? acyclic_->counters() : AcyclicCounters(); }
  bool initialised() const { return counters_.initialisations != 0; }
  /// The lengths of the last configuration that the master sent; absent before.
  std::optional<std::uint8_t> input_length() const { return input_length_; }

 private:
  void run_firmware(Cpu& cpu);
  bool bring_up();
  void main_loop();
  void exchange();
  void poll_acyclic();
  void service();
  void service_if_pending();
  void intr0();
  std::vector<std::uint8_t> next_inputs();
  bool inputs_known() const;
  dsdpv1_verdict judge(Judgement judgement);
  bool check(dsdpv1_error error, const char* during);
  bool initialise(const StationConfig& station);
  void run_commands();
  void wait_while_stopped();

  void carry_out(const command::SetInputs& set);
  void carry_out(const command::SetDiagnosis& set);
  void carry_out(const command::Reinitialise& again);
  void carry_out(const command::Hold& hold);
  void carry_out(const command::Stop& stop);
  void carry_out(const command::Resume& resume);
  void carry_out(const command::EarlyRSta& early);
  void carry_out(const command::WrongCrc& wrong);
  void carry_out(const command::WrongLength& wrong);
  void carry_out(const command::SendVerdict& verdict);
  void carry_out(const command::SetAnswering& set);

  ProgramOptions options_;
  std::deque<Command> commands_;
  Cpu* cpu_ = nullptr;
  std::unique_ptr<DriverPort> port_;
  dsdpv1_device device_{};
  std::unique_ptr<AcyclicServer> acyclic_;
  ProgramCounters counters_;
  PortCounters before_start_;
  std::vector<DriverError> errors_;
  std::vector<std::uint8_t> inputs_, outputs_;
  std::optional<std::vector<std::uint8_t>> set_inputs_;
  std::optional<std::uint8_t> input_length_;
  std::uint8_t count_ = 0;
  bool wrong_length_ = false;
  bool stopped_ = false;
};

}  // namespace user_cpu
