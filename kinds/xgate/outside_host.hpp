#pragma once
// A program outside of the simulation as the host of an XGate-DPS10: its bytes at the pins of the UART.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinds/user_cpu/uart_receiver.hpp"
#include "kinds/xgate/settings.hpp"
#include "model/xgate/frame.hpp"
#include "tb/chip/user_cpu/outside_line.hpp"
#include "tb/chip/user_cpu/station_cpu.hpp"
#include "tb/kit/user.hpp"

namespace dsdpv1::xgate {

/// Sends and receives at the same time, at the module's rate: it follows a right command 03 (X13). An operating system
/// passes a frame on in pieces: those of a command leave without a gap once its length has come.
class OutsideHost : public user_cpu::StationCpu {
 public:
  /// A command whose rest does not come for this long leaves incomplete; X4 ends it.
  static constexpr Tick kPatience = 50 * bus::kTicksPerMs;

  /// All must outlive it.
  OutsideHost(kit::OwnPins& pins, user_cpu::OutsideLine& line, const ChipSettings& chip, Tick start);
  ~OutsideHost() override;

  Tick next() const override;
  void run(Tick now) override;
  void interrupt_changed(Tick /*at*/, bool /*level*/) override {}
  void command(Tick /*now*/, const user_cpu::Command& /*command*/) override {}
  user_cpu::UserCounters counters() const override;
  bool tells() const override { return false; }
  std::uint64_t outputs_received() const override { return 0; }
  const std::vector<std::uint8_t>& outputs() const override { return no_outputs_; }

 private:
  void came(Tick now);
  void read(std::uint8_t byte);
  void begin(Tick now);
  void send(Tick now);
  void receive(Tick now);
  void answered(Tick now, std::uint8_t byte);
  void set_rate(std::uint32_t rate);
  bool sending() const { return edge_ < out_.size(); }

  kit::OwnPins& pins_;
  user_cpu::OutsideLine& line_;
  const Tick rate_hold_;
  UartTiming timing_;

  FrameParser command_, answer_;
  std::size_t read_ = 0, whole_ = 0;  ///< of line_.to_chip: read by command_; may leave
  Tick now_, give_up_ = bus::kNever;
  UartTelegram out_;
  Tick begun_ = 0;
  std::size_t edge_ = 0;  ///< the next of out_
  bool level_ = true;
  user_cpu::UartReceiver in_;
  std::uint32_t asked_ = 0, new_rate_ = 0;  ///< by a command 03 on its way, 0: none; rightly answered ...
  Tick rate_at_ = bus::kNever;              ///< ... and used from then on
  std::vector<std::uint8_t> no_outputs_;
};

/// For UserRequest::outside. Actions for the host's program, and expectations of its outputs, are left out.
tb::MakeUser outside_host(const tb::UserRequest& request);

}  // namespace dsdpv1::xgate
