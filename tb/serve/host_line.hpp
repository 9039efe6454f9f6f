#pragma once
// The host as a station of the simulated segment: what it writes becomes characters, what others send becomes bytes.
#include <deque>
#include <optional>

#include "bus/baud.hpp"
#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "bus/wire/uart.hpp"
#include "tb/bench/record.hpp"

namespace dsdpv1::tb::serve {

using bus::Tick;

/// A host cannot keep bus times, so they are kept here: a telegram starts when the line has been idle for T_SYN (33 bit
/// times; an answer of the host: min_TSDR, 11), and a request after one that wants an answer when the answer or the
/// slot time has ended. The characters of a telegram follow each other without a gap.
class HostLine : public bus::Agent, private bus::Listener {
 public:
  /// `baud` as in bus/baud.hpp. The segment must outlive the line.
  HostLine(bus::Segment& segment, int baud);
  /// So much is a line that never falls silent, not a telegram.
  static constexpr std::size_t kMostWhole = 4096;

  HostLine(const HostLine&) = delete;
  HostLine& operator=(const HostLine&) = delete;

  /// Sends after what was handed over before, not before `at` (not in the past).
  void send(Tick at, bus::Bytes bytes);
  /// The host has gone: what it handed over is still sent, what was heard for it is not handed over, and what answers
  /// it is for nobody: nothing is heard until a later host's telegram or something new after T_SYN begins.
  void forget();
  /// Handed over and not yet begun to be sent.
  std::size_t waiting_bytes() const { return waiting_bytes_; }
  /// The bytes whose last stop bit has ended, in order; with `whole_only` nothing while more may follow without a gap,
  /// up to kMostWhole.
  bus::Bytes take_heard(Tick now, bool whole_only);
  /// Something is on the line or about to be: a telegram of the host that waits or is sent, an awaited answer, a
  /// character.
  bool busy(Tick now) const;
  const HostLineStatistics& statistics() const { return statistics_; }

  Tick next() const override;
  void run(Tick now) override;

 private:
  struct Waiting {
    Tick at;
    bus::Bytes bytes;
    bool answer, wants_answer;
    bool of_nobody;  ///< its host has hung up
  };
  void line_changed(Tick at, bool level) override;
  void heard(const bus::ReceivedCharacter& character);
  Tick earliest(const Waiting& telegram) const;
  void start(Tick now);
  bool slot_runs(Tick now) const { return now < slot_end_; }
  Tick bits(int count) const { return count * bit_; }

  bus::StationId station_;
  bus::UartSender sender_;
  bus::UartReceiver receiver_;
  Tick bit_, slot_;
  Tick last_activity_ = 0;  ///< end of the last character sent or heard
  Tick slot_end_ = 0;       ///< until then an answer may begin
  bool deaf_ = false;       ///< what is heard is for a host that has gone
  std::deque<Waiting> waiting_;
  std::size_t waiting_bytes_ = 0;
  bus::Bytes heard_;
  HostLineStatistics statistics_;
};

}  // namespace dsdpv1::tb::serve
