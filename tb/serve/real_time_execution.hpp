#pragma once
// A run in real time, with a host on the segment.
#include <memory>
#include <string>

#include "tb/bench/execution.hpp"
#include "tb/bench/record.hpp"
#include "tb/serve/framing.hpp"
#include "tb/serve/host_connection.hpp"
#include "tb/serve/host_line.hpp"
#include "tb/serve/line_limit.hpp"
#include "tb/serve/pace.hpp"

namespace dsdpv1::tb::serve {

/// Simulated time follows real time in slices of at most 1 ms, 0.1 ms while the line is in use, with sleep in between.
/// It stops while a telegram of the host is incomplete (Intake), and catches up afterwards. So a telegram that arrives
/// slowly, from a real UART, ends on the segment when it ended on the wire. With a UART simulated time does not stop
/// while the answer is awaited and sent: the host sends nothing meanwhile, and the UART gives the answer its times.
///
/// The host is read only up to kMostWaiting bytes waiting for the line; further bytes stay in the socket or
/// pseudo-terminal, and finally the host waits. After a hold longer than Intake::kPatience nothing is read until
/// simulated time has caught up, or for as long as the hold was, so that a slow host cannot stop simulated time.
class RealTimeExecution : public Execution {
 public:
  /// Eight of the longest telegrams; at 12 Mbit/s nearly two slices of 1 ms, so that the line never waits for the
  /// program. The rest of an incomplete telegram is read beyond that.
  static constexpr std::size_t kMostWaiting = 8 * kLongestTelegram;

  /// `baud` as in bus/baud.hpp.
  RealTimeExecution(std::unique_ptr<HostConnection> port, int baud);

  /// Call after the last make_chip and before `run`: the host acts after the chips.
  void join();
  void run(Tick end, const std::function<bool()>& stopped) override;

  /// Prints one line about the port or the pace.
  std::function<void(Tick at, const std::string& text)> say = [](Tick, const std::string&) {};
  Pacing pacing() const;

 private:
  void take_from_host();
  std::size_t room() const;
  void hold_time();
  void tell_about_port(const std::string& text);
  void tell_left_out(bool at_end);
  void advance(Tick end);
  Tick limit() const;
  void give_to_host();
  void sleep();
  void tell(const Pace::Loss& loss);

  std::unique_ptr<HostConnection> port_;
  HostLine line_;
  Intake intake_;
  std::optional<Pace> pace_;
  LineLimit lines_;
  std::optional<WallTime> held_since_;
  WallTime rest_until_{};  ///< nothing is read until then, so that simulated time catches up
  WallTime told_at_{};
  bool told_ = false;
};

}  // namespace dsdpv1::tb::serve
