#pragma once
// A run held to real time, with a host on the segment.
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

/// Simulated time follows real time in slices of at most 1 ms, 0.1 ms while something is on the line, and sleeps in
/// between. It stands still while a telegram of the host has begun and is not complete (Intake), and catches up
/// afterwards; so a telegram that came slowly, from a real UART, ends on the segment when it ended on the wire. Behind
/// a UART simulated time does not wait while the answer is awaited and sent: nothing can come from the host meanwhile,
/// and the UART gives the answer its times.
///
/// No more is read from the host than waits for the line, up to kMostWaiting; what it writes faster than the line sends
/// stays in the socket or pseudo-terminal, and in the end the host waits. After a hold longer than Intake::kPatience
/// nothing is read until simulated time has caught up, or for as long as the hold was: so a host that sends ever so
/// slowly cannot stop it.
class RealTimeExecution : public Execution {
 public:
  /// Eight of the longest telegrams; at 12 Mbit/s nearly two slices of 1 ms, so that the line never waits for the
  /// program. The rest of a telegram begun is read beyond that.
  static constexpr std::size_t kMostWaiting = 8 * kLongestTelegram;

  /// `baud` as in bus/baud.hpp.
  RealTimeExecution(std::unique_ptr<HostConnection> port, int baud);

  /// Call after the last make_chip and before `run`: the host acts behind the chips.
  void join();
  void run(Tick end, const std::function<bool()>& stopped) override;

  /// One line about the port or about the pace.
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
  WallTime rest_until_{};  ///< until then nothing is read, so that simulated time catches up
  WallTime told_at_{};
  bool told_ = false;
};

}  // namespace dsdpv1::tb::serve
