#pragma once
// The standard user program for a chip of the SPC3 family: the firmware of a simple device, built on the driver. It
// brings the chip up, judges the master's blocks in the handler of X/INT or in its main loop, exchanges inputs and
// outputs at a fixed period, serves the user watchdog, and executes the bench's commands. When the chip has gone
// OFFLINE it begins again.
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "bus/time.hpp"
#include "driver/spc3/spc3.h"
#include "kinds/spc3/user_cpu/spi_user.hpp"
#include "kinds/user_cpu/cpu.hpp"
#include "tb/chip/user_cpu/program.hpp"
#include "tb/chip/user_cpu/program_inputs.hpp"

namespace dsdpv1::spc3_user {

namespace command = user_cpu::command;
using bus::Tick;

enum class Mode : std::uint8_t { kInterrupt, kPolled };

/// Options of these chips only.
struct FirmwareOptions {
  Mode mode = Mode::kInterrupt;
  int user_watchdog = 20'000;                   ///< data telegrams, 1..65535 (A34)
  int wd_baud_control = 30;                     ///< cell 0A, 1..255 (A31)
  bool vpc3 = false;                            ///< RAM of 2 KB
  std::optional<dsdpv1::SpiTiming> spi_timing;  ///< by SPI; else at the parallel bus
};

// Words of command::OfChip::order.
constexpr const char* kGoOffline = "go_offline";
constexpr const char* kLeaveMaster = "leave_master";
constexpr const char* kWriteChip = "write_chip";
constexpr const char* kReadChip = "read_chip";

/// Not copied; must outlive the CPU that runs it.
class UserProgram {
 public:
  UserProgram(const FirmwareOptions& firmware, user_cpu::ProgramOptions options)
      : firmware_(firmware), options_(std::move(options)) {}
  UserProgram(const UserProgram&) = delete;
  UserProgram& operator=(const UserProgram&) = delete;

  /// The CPU's program, on its stack.
  void run(user_cpu::Cpu& cpu);
  /// Executed in order, each as soon as the program has finished its present work; then wake the CPU.
  void post(const user_cpu::Command& command) { commands_.push_back(command); }

  std::function<void(const user_cpu::ProgramError&)> on_error;

  const user_cpu::ProgramCounters& counters() const { return counters_; }
  const std::vector<std::uint8_t>& outputs() const { return outputs_; }

 private:
  void open();
  spc3_port port();
  std::uint8_t read(std::uint16_t address) { return spi_ ? spi_->read(address) : cpu_->read(address); }
  void write(std::uint16_t address, std::uint8_t value) {
    spi_ ? spi_->write(address, value) : cpu_->write(address, value);
  }
  void bring_up();
  bool initialise();
  void main_loop();
  void service();
  void handler();
  void exchange();
  void fetch_outputs();
  void give_inputs();
  void hand_over_diagnosis();

  bool judge_prm(std::uint8_t length);
  bool judge_cfg(spc3_cfg& cfg);
  bool judge(user_cpu::Judgement judgement, bool cfg);
  bool await_verdict(bool cfg);
  void keep_address(std::uint8_t address, bool locked);

  bool check(spc3_error error, const char* during);
  void run_commands();
  void carry_out(const command::SetInputs& set) { inputs_.set(set.bytes); }
  void carry_out(const command::SetDiagnosis& set);
  void carry_out(const command::Reinitialise& again);
  void carry_out(const command::Stop&) { stopped_ = true; }
  void carry_out(const command::Resume&) { stopped_ = false; }
  void carry_out(const command::WrongLength&) {}   // refused by the kind
  void carry_out(const command::SetAnswering&) {}  // the same
  void carry_out(const command::SendVerdict&) {}   // nothing is judged now
  void carry_out(const command::OfChip& order);

  const FirmwareOptions firmware_;
  user_cpu::ProgramOptions options_;
  user_cpu::ProgramInputs inputs_{options_};
  std::deque<user_cpu::Command> commands_;
  user_cpu::Cpu* cpu_ = nullptr;
  std::optional<SpiUser> spi_;
  spc3_device device_{};
  user_cpu::ProgramCounters counters_;
  std::vector<std::uint8_t> outputs_;
  std::uint8_t input_length_ = 0;
  bool address_locked_ = false;
  std::uint8_t diagnosis_flags_ = 0;
  std::optional<std::vector<std::uint8_t>> diagnosis_;  ///< the chip has no buffer for it yet
  bool interrupted_ = false;                            ///< the handler has left the events to the main loop
  bool offline_ = false;                                ///< the chip has gone OFFLINE
  bool stopped_ = false;
};

}  // namespace dsdpv1::spc3_user
