#pragma once
// One slave on the bench: the chip, and the user CPU that runs the driver.
#include <memory>
#include <optional>
#include <string>

#include "bus/timeline.hpp"
#include "tb/bench/execution.hpp"
#include "tb/bench/observer.hpp"
#include "tb/bench/record.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/chip/chip_view.hpp"
#include "tb/chip/user_cpu/station_cpu.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

/// The agent is the user CPU; the execution runs the chip. Its actions are reported to the observers.
class SlaveStation : public bus::Agent, private user_cpu::Others {
 public:
  /// `number`: of the slave in the scenario. `execution` and `observers` must outlive it.
  SlaveStation(std::size_t number, const scenario::Slave& slave, user_cpu::StationConfig station,
               std::unique_ptr<ChipView> chip, MakeUser make_user, Execution& execution, const Observers& observers);
  SlaveStation(const SlaveStation&) = delete;
  SlaveStation& operator=(const SlaveStation&) = delete;

  const std::string& name() const { return slave_.name.text; }
  const ChipKind& kind() const { return *slave_.kind; }
  const ChipView& chip() const { return *chip_; }
  ChipView& chip() { return *chip_; }
  const user_cpu::StationConfig& station() const { return station_; }

  /// RESET of the board: of the chip and of the user CPU, which restarts when it is released.
  void hold_in_reset(Tick now);
  void release_reset(Tick now);

  /// Passes a command to the user program and wakes it.
  void command(Tick now, const user_cpu::Command& command);
  /// See StationCpu; a program that has not begun yet will.
  bool carries_out(const std::string& word) const { return user_ == nullptr || user_->carries_out(word); }
  void reinitialise(Tick now, std::optional<int> address, const std::optional<bus::Bytes>& cfg);
  void interrupt_changed(Tick at, bool level);

  Tick next() const override { return user_ ? user_->next() : bus::kNever; }
  void run(Tick now) override;

  /// As StationCpu::where; absent during a reset.
  std::optional<user_cpu::Place> where(const user_cpu::Act& act) const {
    return user_ ? user_->where(act) : std::nullopt;
  }
  /// The outputs that the user CPU fetched last.
  const bus::Bytes& outputs() const { return outputs_; }
  Tsdr& tsdr() { return tsdr_; }
  const Tsdr& tsdr() const { return tsdr_; }
  /// Everything except the master's side.
  SlaveResult result() const;

 private:
  Tick quiet_until() override { return execution_.quiet_until(*this); }
  bool go_on(Tick tick) override;

  const std::size_t number_;
  const scenario::Slave& slave_;
  user_cpu::StationConfig station_;
  std::unique_ptr<ChipView> chip_;
  MakeUser make_user_;
  Execution& execution_;
  const Observers& observers_;
  std::unique_ptr<user_cpu::StationCpu> user_;
  user_cpu::UserCounters before_reset_;  ///< of user CPUs ended by a reset
  std::optional<user_cpu::BoardReport> board_before_reset_;
  bool tells_ = true;  ///< the user CPU reports what its program does
  std::uint64_t outputs_seen_ = 0;
  bus::Bytes outputs_;
  Tsdr tsdr_;
};

}  // namespace dsdpv1::tb
