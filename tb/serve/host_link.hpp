#pragma once
// A host at a port, as a station of a simulated segment, in real time: the steps of a loop that advances simulated
// time, of a bench or of a SystemC platform.
#include <functional>
#include <memory>
#include <optional>
#include <string>

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
///
///   link.begin(now);
///   for (;;) {
///     link.take(now);
///     now = advance to link.limit(now), if that is later;
///     link.give(now);
///     link.sleep(now);
///   }
///   link.end(now);
class HostLink {
 public:
  /// Eight of the longest telegrams; at 12 Mbit/s nearly two slices of 1 ms, so that the line never waits for the
  /// program. The rest of an incomplete telegram is read beyond that.
  static constexpr std::size_t kMostWaiting = 8 * kLongestTelegram;

  /// `baud` as in bus/baud.hpp. The segment must outlive it.
  HostLink(std::unique_ptr<HostConnection> port, bus::Segment& segment, int baud);

  /// The host as an agent.
  HostLine& line() { return line_; }
  /// A telegram came from the host before the answer to its last request had left, which no delay explains: the host
  /// cannot have known that none would come. Never called for a UART, whose driver may deliver late.
  std::function<void(Tick at, const bus::Bytes& telegram)> on_early = [](Tick, const bus::Bytes&) {};
  /// The host has hung up.
  std::function<void()> on_gone = [] {};
  /// Prints one line about the port.
  std::function<void(Tick at, const std::string& text)> say = [](Tick, const std::string&) {};
  /// The same when simulated time is late; at most one in 5 s.
  std::function<void(Tick at, const std::string& text)> late = [](Tick, const std::string&) {};
  Pacing pacing() const;

  /// Simulated time is real time at `now`.
  void begin(Tick now);
  /// Reads the host, and passes complete telegrams to the line.
  void take(Tick now);
  /// The limit of simulated time at present; `now` while a telegram is incomplete.
  Tick limit(Tick now) const;
  /// Simulated time is `now`: passes on what was heard.
  void give(Tick now);
  /// Until the next slice or bytes of the host.
  void sleep(Tick now);
  void end(Tick now);

 private:
  void pass_on(Tick now, Tick at, Taken telegram);
  std::size_t room(Tick now) const;
  void hold_time();
  void tell_about_port(const std::string& text);
  void tell_left_out(bool at_end);
  void tell(const Pace::Loss& loss);

  std::unique_ptr<HostConnection> port_;
  HostLine line_;
  Intake intake_;
  std::optional<Pace> pace_;
  LineLimit lines_;
  Tick now_ = 0;            ///< of the last step
  WallTime all_read_{};     ///< everything that came before was read
  WallTime came_after_{};   ///< what was read last
  WallTime asked_after_{};  ///< the host's last request
  std::optional<WallTime> held_since_;
  WallTime rest_until_{};  ///< nothing is read until then, so that simulated time catches up
  WallTime told_at_{};
  bool told_ = false;
};

}  // namespace dsdpv1::tb::serve
