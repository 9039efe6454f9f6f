#pragma once
// The standard user program: the firmware of a simple device, built on the driver. It initialises the chip, then
// exchanges inputs and outputs at a fixed period, judges the master's blocks, and executes the bench's commands.
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "driver/dsdpv1.h"
#include "kinds/dsdpv1/user_cpu/acyclic_server.hpp"
#include "kinds/dsdpv1/user_cpu/driver_port.hpp"
#include "kinds/dsdpv1/user_cpu/serial_port.hpp"
#include "kinds/user_cpu/native_cpu.hpp"
#include "tb/chip/user_cpu/program.hpp"
#include "tb/chip/user_cpu/program_inputs.hpp"

namespace dsdpv1::user_cpu {

/// Valid as long as `station` lives unchanged.
dsdpv1_config driver_config(const StationConfig& station);
dsdpv1_diag_type diag_type(DiagnosisKind kind);

/// Commands specific to this chip's programs, in addition to user_cpu::Command.
namespace command {
/// Takes the DPRAM and keeps it for `duration`.
struct Hold {
  Tick duration = 0;
};
/// Breaks ruling H2: R_STA rises `after` R_REQ without a sample of L_REQ and L_STA; then both fall after `hold`.
struct EarlyRSta {
  Tick after = 250;
  Tick hold = 12'000;
};
enum class Area : std::uint8_t { kInit, kInputs, kDiagnosis, kC1Answer, kC2Answer };
/// Writes a wrong CRC with the next `times` blocks of that kind.
struct WrongCrc {
  Area area = Area::kInputs;
  int times = 1;
};
/// Disturbs the next `times` telegrams to the chip: SPI and UART.
struct SpoilTelegrams {
  TelegramFault fault = TelegramFault::kFlippedBit;
  int times = 1;
  Tick pause = 0;  ///< TelegramFault::kPause
};
/// Sends a telegram that the driver does not, valid or not, a number of times: `bytes`, with their CRC. SPI and UART.
struct HostTelegram {
  std::vector<std::uint8_t> bytes;
  std::optional<int> listen;  ///< SerialPort::telegram
  int times = 1;
};
}  // namespace command

using DriverCommand =
    std::variant<command::SetInputs, command::SetDiagnosis, command::Reinitialise, command::Hold, command::Stop,
                 command::Resume, command::EarlyRSta, command::WrongCrc, command::WrongLength, command::SendVerdict,
                 command::SetAnswering, command::SpoilTelegrams, command::HostTelegram>;
/// A call of the driver that did not return DSDPV1_OK.
struct DriverError {
  Tick at = 0;
  dsdpv1_error error = DSDPV1_OK;
  const char* during = "";  ///< "initialise", "exchange" ...
};

/// In the bench's format.
ProgramError program_error(const DriverError& error);

/// The program and the bench's view of it. Not copied; must outlive the CPU that runs it.
class UserProgram {
 public:
  explicit UserProgram(ProgramOptions options, const HostPort& port = {}) : options_(std::move(options)), host_(port) {}
  UserProgram(const UserProgram&) = delete;
  UserProgram& operator=(const UserProgram&) = delete;

  /// For NativeCpu: `NativeCpu cpu(bus, timing, program.entry());`
  NativeCpu::Program entry();
  /// Executed in order, each as soon as the program has finished its present work; call NativeCpu::wake afterwards, or
  /// it waits for the next exchange. Allowed before the program runs.
  void post(const DriverCommand& command) { commands_.push_back(command); }

  /// Called for every driver error, in addition to the log.
  std::function<void(const DriverError&)> on_error;

  const ProgramCounters& counters() const { return counters_; }
  const HoldCounters& port_counters() const;
  /// All errors so far, at most 1000; later ones are only counted.
  const std::vector<DriverError>& errors() const { return errors_; }
  const std::vector<std::uint8_t>& outputs() const { return outputs_; }
  const std::vector<std::uint8_t>& inputs() const { return inputs_; }
  /// Zeros without DPV1.
  AcyclicCounters acyclic_counters() const { return acyclic_ ? acyclic_->counters() : AcyclicCounters(); }
  bool initialised() const { return counters_.initialisations != 0; }
  /// The lengths of the master's last configuration; absent before.
  std::optional<std::uint8_t> input_length() const { return input_length_; }

 private:
  void run_firmware(Cpu& cpu);
  void open(const dsdpv1_judge& judge);
  void claim_for(Tick duration);
  bool bring_up();
  void main_loop();
  void exchange();
  void poll_acyclic();
  void service();
  void service_if_pending();
  void intr0();
  bool inputs_known() const;
  dsdpv1_verdict judge(Judgement judgement);
  bool check(dsdpv1_error error, const char* during);
  bool initialise(const StationConfig& station);
  void run_command();
  void run_commands();
  void wait_for_start();
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
  void carry_out(const command::SpoilTelegrams& spoil);
  void carry_out(const command::HostTelegram& telegram);

  ProgramOptions options_;
  ProgramInputs next_inputs_{options_};
  HostPort host_;
  std::deque<DriverCommand> commands_;
  Cpu* cpu_ = nullptr;
  std::unique_ptr<DriverPort> port_;  ///< one of these two is set
  std::unique_ptr<SerialPort> serial_;
  dsdpv1_device device_{};
  std::unique_ptr<AcyclicServer> acyclic_;
  ProgramCounters counters_;
  HoldCounters before_start_;
  std::vector<DriverError> errors_;
  std::vector<std::uint8_t> inputs_, outputs_;
  std::optional<std::uint8_t> input_length_;
  bool stopped_ = false;
};

}  // namespace dsdpv1::user_cpu
