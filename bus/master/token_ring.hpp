#pragma once
// The token among several masters (EN 50170 part 2, FDL state machine of a master): learns and enters the ring, uses,
// passes and recovers the token, polls the GAP. Uses a MasterFdl and shares it with the master station, which sends its
// own requests while `holds_token`.
#include <cstdint>
#include <functional>

#include "bus/master/fdl.hpp"
#include "bus/master/slave_parameters.hpp"
#include "bus/token/active_stations.hpp"
#include "bus/token/rotation.hpp"

namespace dsdpv1::bus {

enum class RingState : std::uint8_t {
  kOff,          ///< silent, deaf
  kListenToken,  ///< learns the LAS; answers FDL status with "not ready", with "ready" once the LAS is valid
  kClaimToken,   ///< the bus is dead: passes the token to itself twice
  kActiveIdle,   ///< in the ring, without the token
  kUseToken,     ///< the master station sends
  kGapPoll,      ///< FDL status to one address of the GAP
  kPassToken,    ///< token to the next station, until it is heard
  kOut,          ///< left the ring: another master has the same address
};
/// "OFF", "LISTEN_TOKEN", ...
const char* name(RingState state);

struct RingStatistics {
  RotationStatistics rotations = {};   ///< T_RR, from receipt to receipt
  std::uint64_t token_retries = 0;     ///< tokens repeated because no station was heard
  std::uint64_t stations_dropped = 0;  ///< taken out of the LAS because they did not take the token
  std::uint64_t stations_found = 0;    ///< by the GAP poll
  std::uint64_t claims = 0;            ///< tokens claimed after T_TO
  std::uint64_t tokens_given_up = 0;   ///< another master was heard while this one had the token
};

constexpr int kTokenAttempts = 3;  ///< EN 50170: the token is sent three times before the next station counts as gone
constexpr int kClaimTokens = 2;    ///< tokens to itself that start a ring
constexpr int kDuplicateLimit =
    2;  ///< tokens with the own address as SA, heard while listening, until it leaves permanently

class TokenRing {
 public:
  /// `address` 0..126. The layer must outlive it; the ring uses its on_heard.
  TokenRing(MasterFdl& fdl, std::uint8_t address, const BusParameters& parameters);
  TokenRing(const TokenRing&) = delete;
  TokenRing& operator=(const TokenRing&) = delete;

  /// Goes to kListenToken; does nothing unless off or out.
  void start(Tick now);
  /// Silent at once; does not stop the layer.
  void stop(Tick now);
  void set_baud(int index);

  RingState state() const { return state_; }
  /// True in kActiveIdle, kUseToken, kGapPoll and kPassToken.
  bool in_ring() const;
  bool holds_token() const { return state_ == RingState::kUseToken; }
  const ActiveStations& stations() const { return stations_; }
  const RingStatistics& statistics() const { return statistics_; }

  /// EN 50170, 4.1.1: the first high-priority message of a token always, others while T_TH = T_TR - T_RR has not
  /// passed. Only while it holds the token.
  bool may_begin(Tick now, bool high) const { return now < hold_until_ || (high && !high_sent_); }
  /// The master station has begun a message.
  void begun(bool high) { high_sent_ = high_sent_ || high; }
  /// The master station has nothing more to send: polls the GAP if due, then passes the token.
  void release(Tick now);

  /// With the layer idle: begins the ring's own telegram if one is due. Returns false without one.
  bool act(Tick now);
  /// Whether the layer's present request is the ring's; then its result goes to `done`.
  bool asking() const { return asking_; }
  void done(Tick now, const FdlResult& result);
  /// T_TO while the token is elsewhere; else kNever.
  Tick next() const;

  std::function<void(Tick at, RingState from, RingState to, const char* why)> on_state;

 private:
  Tick bits(Tick count) const { return count * bit_; }
  Tick timeout() const;
  void go(Tick now, RingState state, const char* why);
  void listen_anew(Tick now, const char* why);
  void take_token(Tick now, const char* why);
  bool claim(Tick now);
  bool next_gap_address(Tick now);
  void send_token(Tick now, std::uint8_t to);
  void poll_gap(Tick now);
  void claim_sent(Tick now);
  void gap_answered(Tick now, const FdlResult& result);
  void token_sent(Tick now, const FdlResult& result);
  void heard(const HeardTelegram& heard);
  void token_heard(const HeardTelegram& heard);
  void token_for_us(const HeardTelegram& heard);
  void request_heard(const HeardTelegram& heard);
  void own_address_heard(Tick now);
  void respond(const HeardTelegram& heard, unsigned function_code);

  MasterFdl& fdl_;
  std::uint8_t address_;
  BusParameters parameters_;
  int baud_ = 0;
  Tick bit_ = bus::baud(0).bit;

  RingState state_ = RingState::kOff;
  ActiveStations stations_;
  StationLearner learner_;
  RingStatistics statistics_;
  bool asking_ = false, high_sent_ = false, gap_running_ = false;
  int duplicates_ = 0, claims_left_ = 0, attempts_ = 0;
  std::uint8_t gap_address_ = 0;
  int stranger_ = -1;       ///< SA of a token to this station that was not the previous one; its repetition is accepted
  Tick quiet_from_ = 0;     ///< T_TO counts from here, or from the last activity
  Tick token_at_ = kNever;  ///< receipt of the last token, kNever before the first
  Tick hold_until_ = 0, gap_due_ = 0;
};

}  // namespace dsdpv1::bus
