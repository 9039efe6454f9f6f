#pragma once
// The host as a station of the simulated segment: converts its bytes to characters, and characters of others to bytes.
#include <deque>
#include <optional>

#include "bus/baud.hpp"
#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "bus/wire/uart.hpp"
#include "tb/serve/statistics.hpp"

namespace dsdpv1::tb::serve {

using bus::Tick;

/// A host cannot keep bus times, so this class does: a telegram starts when the line has been idle for T_SYN (33 bit
/// times; an answer of the host: min_TSDR, 11), and a request after one that expects an answer when the answer or the
/// slot time has ended. The characters of a telegram follow each other without a gap.
class HostLine : public bus::Agent, private bus::Listener {
 public:
  /// `baud` as in bus/baud.hpp. The segment must outlive it.
  HostLine(bus::Segment& segment, int baud);
  /// More bytes than this mean a line that is never silent, not a telegram.
  static constexpr std::size_t kMostWhole = 4096;

  HostLine(const HostLine&) = delete;
  HostLine& operator=(const HostLine&) = delete;

  /// Sends after earlier telegrams, not before `at` (not in the past). Returns true for a request that wants an answer.
  /// `wrong_at`: a byte with wrong parity.
  bool send(Tick at, bus::Bytes bytes, std::optional<std::size_t> wrong_at = {});
  /// The bytes are an answer: of a station at the port.
  static bool is_answer(const bus::Bytes& bytes);
  /// The host has sent a request and cannot know yet whether it is answered: nothing of the answer has been taken, and
  /// the slot time runs, or the request waits.
  bool owes_answer(Tick now) const;
  Tick slot() const { return slot_; }
  /// It has sent a telegram that began at `start`: the last one.
  bool began_at(Tick start) const { return start == began_; }
  /// The host has gone: its telegrams are still sent, but received bytes for it are dropped, as are answers to it.
  /// Reception resumes with a later host's telegram or a new telegram after T_SYN.
  void forget();
  /// Passed on but not begun to be sent.
  std::size_t waiting_bytes() const { return waiting_bytes_; }
  /// The bytes whose last stop bit has ended, in order; with `whole_only` none while more may follow without a gap, up
  /// to kMostWhole.
  bus::Bytes take_heard(Tick now, bool whole_only);
  /// The line is in use or about to be: a telegram of the host waits or is being sent, an answer is awaited, a
  /// character is on it.
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
    std::optional<std::size_t> wrong_at;
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
  Tick last_activity_ = 0;  ///< end of the last character sent or received
  Tick slot_end_ = 0;       ///< until then an answer may begin
  bool owed_ = false;       ///< to the last request
  Tick began_ = -1;         ///< the last telegram
  bool deaf_ = false;       ///< received characters are for a host that has gone
  std::deque<Waiting> waiting_;
  std::size_t waiting_bytes_ = 0;
  bus::Bytes heard_;
  HostLineStatistics statistics_;
};

}  // namespace dsdpv1::tb::serve
