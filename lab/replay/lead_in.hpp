#pragma once
// Before a replay: requests at the capture's rate to an absent station, until the model has found the rate. Then the
// telegrams that bring it into the data exchange in which the capture begins.
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "bus/telegram/telegram.hpp"
#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "bus/wire/uart.hpp"

namespace dsdpv1::tb::replay {

using bus::Tick;

class LeadIn : public bus::Agent {
 public:
  /// `avoid`: the address of the model. `found`, whether it has this rate, is asked before each request. The segment
  /// must outlive it.
  LeadIn(bus::Segment& segment, int baud, std::uint8_t avoid, std::function<bool(int baud)> found);
  /// Begins again with another rate, after its end.
  void search(int baud, Tick now);
  /// Ends it at once.
  void leave_out() { wanted_ = false; }
  /// The telegrams to send once the rate is found, each followed by time for the model's user CPU.
  void then_send(std::vector<bus::Telegram> telegrams) { telegrams_ = std::move(telegrams); }

  /// Called for each telegram of then_send, with the end of its last stop bit.
  std::function<void(const bus::Telegram& telegram, Tick end)> on_sent;
  /// Called at each end, with the time from which on the line is free.
  std::function<void(Tick free)> on_end;

  Tick next() const override;
  void run(Tick now) override;

  /// Time enough for the model's user CPU to initialise it.
  static constexpr Tick kStart = 500 * bus::kTicksPerUs;
  /// After so long the capture is played even if the rate was not found: a search tries each rate in some 1.2 s.
  static constexpr Tick kLongest = 6 * bus::kTicksPerSecond;

 private:
  void set_baud(int baud);
  void send(Tick now, const bus::Bytes& bytes);

  bus::UartSender sender_;
  bus::Bytes request_;
  int baud_ = 0;
  Tick pause_ = 0, due_ = kStart, give_up_ = kLongest;
  bool wanted_ = true, ended_ = false;
  std::vector<bus::Telegram> telegrams_;
  std::size_t next_telegram_ = 0;
  std::function<bool(int baud)> found_;
};

}  // namespace dsdpv1::tb::replay
