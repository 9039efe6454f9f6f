#pragma once
// MSAC_C2 of a class-2 master: one connection to one slave (7.3, rulings V2, V3, V10, V11). No I/O; the master station
// asks for the next telegram whenever it may send one.
//
//   CLOSED -- Initiate --> INITIATING --(56)--> CONNECTING --(57)--> OPEN <--answer-- BUSY
//                             | RS                | D7, 58            | --request, Idle--> |
//                             v                   v                   v                    v
//                           CLOSED <-------------------- 58 of the slave, RS, no answer ----
//                           CLOSED <-- ABORTING <------- wrong answers, time over, abort() --
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "bus/master/acyclic.hpp"
#include "bus/master/fdl.hpp"
#include "bus/telegram/dpv1_words.hpp"
#include "bus/telegram/telegram.hpp"
#include "bus/time.hpp"

namespace dsdpv1::bus {

enum class ConnectionState : std::uint8_t {
  kClosed,
  kInitiating,  ///< Initiate is to be sent, or was acknowledged with E5: SAP 49 is polled for the immediate answer
  kConnecting,  ///< the channel is known: polled for the initiate answer
  kOpen,        ///< nothing in progress; Idle keeps the slave's I timer from ending
  kBusy,        ///< a request or Idle waits for its answer: polls
  kAborting,    ///< the abort PDU is to be sent
};
/// "CLOSED", "INITIATING", ...
const char* name(ConnectionState state);

/// One end of the long form of Add_Addr (V10): its type and address bytes as in EN 50170.
struct AddressEnd {
  std::uint8_t type = 0;
  Bytes address = {};  ///< at most 255 bytes, together with the other end at most 227
};
/// Add_Addr in the form used by devices on the market: source and destination API.
Bytes short_add_addr(std::uint8_t source_api, std::uint8_t destination_api);
/// `S_Type, S_Len, D_Type, D_Len, S_Addr, D_Addr`.
Bytes long_add_addr(const AddressEnd& source, const AddressEnd& destination);

struct ConnectionParameters {
  std::uint8_t slave = 0;                 ///< 0..126
  std::uint16_t send_timeout = 100;       ///< unit 10 ms; F = U = this, I = twice this; a slave refuses 0
  int response_timeout = 0;               ///< C2_Response_Timeout, unit 10 ms: time for an answer; 0 = 2 x send_timeout
  Bytes features = {0x01, 0x00};          ///< Features_Supported: DS_Read and DS_Write
  Bytes profile_features = {0x00, 0x00};  ///< Profile_Features_Supported
  std::uint16_t profile_ident = 0;        ///< Profile_Ident_Number
  Bytes add_addr = {0x00, 0x00};          ///< see short_add_addr, long_add_addr; any bytes
  std::int64_t poll_interval_us = 0;      ///< minimum time between two polls; 0: at every token
  std::optional<ConnectionState> silent_from;  ///< a fault: on entering this state it falls silent (Behaviour::kSilent)
};

/// Faults of a master.
enum class Behaviour : std::uint8_t {
  kNormal,
  kSilent,    ///< sends nothing on this connection: the slave's F or I timer ends
  kPollOnly,  ///< also polls when open, sends neither requests nor Idle: the slave's I timer ends
};

/// How a connection ended.
struct ConnectionEnd {
  enum class By : std::uint8_t {
    kSlaveAbort,  ///< abort PDU of the slave
    kMaster,      ///< abort by this side: requested, or because of a wrong answer or a timeout
    kRefused,     ///< Initiate refused: RS (no channel), or D7 with codes
    kNoChannel,   ///< the slave does not know the channel any more: RS
    kNoAnswer,    ///< the station does not answer
    kStopped,     ///< the master was stopped
  };
  By by = By::kStopped;
  std::uint8_t subnet = 0, instance_and_reason = 0, detail = 0;       ///< of an abort, of either side
  std::uint8_t error_decode = 0, error_code_1 = 0, error_code_2 = 0;  ///< of D7
  std::string words = {};  ///< "aborted by the slave: MSAC_C2: ABT_TO (timeout of the connection), no subnet, detail 1"
};

/// An abort by the master; the defaults are an ordinary end.
struct AbortReason {
  std::uint8_t subnet = 1;
  std::uint8_t instance = abort_instance::kUser;
  std::uint8_t reason = 0;  ///< 0..15
  std::uint8_t detail = 0;
  bool sdn = false;  ///< sent without acknowledgement

  /// Byte 2 of the PDU.
  std::uint8_t code() const { return static_cast<std::uint8_t>(unsigned{instance} << 4 | (reason & 0x0FU)); }
};

/// A PDU sent unchanged, at the next opportunity in any state: a request while one is open, a wrong SSAP, nonsense. Its
/// answer is ignored unless it is the slave's abort.
struct RawAcyclic {
  Bytes pdu = {};                         ///< empty: a poll
  std::optional<std::uint8_t> dsap = {};  ///< absent: the channel's SAP, 49 without a channel
  std::uint8_t ssap = sap::kMs2Master;
  bool sdn = false;
  std::function<void(const FdlResult&)> done = {};
};

class Connection {
 public:
  /// Throws std::invalid_argument for a value out of range.
  Connection(const ConnectionParameters& parameters, std::uint8_t master);

  /// Values granted by the slave; complete from kOpen on.
  struct Granted {
    std::optional<std::uint8_t> sap = {};  ///< of the channel, 0 to 48; from kConnecting on
    std::uint16_t send_timeout = 0;        ///< unit 10 ms
    std::uint8_t max_length = 0;           ///< Max_Len_Data_Unit
    Bytes initiate_answer = {};            ///< the whole PDU 57
  };

  const ConnectionParameters& parameters() const { return parameters_; }
  ConnectionState state() const { return state_; }
  const Granted& granted() const { return granted_; }
  std::size_t open_operations() const { return operations_.size(); }

  // --- Calls of the master's user.
  // Begins with Initiate; only when closed.
  void open();
  /// Waits for the connection to be open and for earlier operations. Closed: throws std::logic_error.
  void push(Tick now, AcyclicRequest request, AcyclicCallback done);
  /// Before the channel is known the connection ends without a telegram.
  void abort(Tick now, const AbortReason& reason);
  void inject(RawAcyclic raw) { raw_.push_back(std::move(raw)); }
  void set_behaviour(Behaviour behaviour) { behaviour_ = behaviour; }

  // --- Calls of the master station.
  // True if a telegram is due at `now`.
  bool due(Tick now);
  Telegram next_request(Tick now);
  /// The result of that telegram. FdlOutcome::kAborted: it is sent again.
  void done(Tick now, const FdlResult& result);
  /// Returns to kClosed without a telegram.
  void stop(Tick now);

  std::function<void(ConnectionState from, ConnectionState to)> on_state;
  std::function<void(const ConnectionEnd&)> on_end;

 private:
  enum class Asked : std::uint8_t { kInitiate, kPoll, kRequest, kIdle, kAbort, kRaw };
  Tick response_timeout() const;
  bool normal_due(Tick now);
  bool open_due(Tick now) const;
  Asked choose() const;
  Telegram telegram(const Bytes& pdu, std::uint8_t dsap) const;
  Telegram raw_telegram() const;
  Bytes initiate_pdu() const;
  void go(ConnectionState state);
  void end(Tick now, const ConnectionEnd& how);
  void end_aborted(Tick now);
  void abort_for(Tick now, std::uint8_t reason, const char* words);
  void wrong_answer(Tick now, const Bytes& pdu, std::uint8_t expected);
  void aborted_by_slave(Tick now, const Bytes& pdu);
  void finish_operation(Tick now, AcyclicOutcome outcome);
  void raw_done(Tick now, const FdlResult& result);
  void refused(Tick now, std::uint8_t refusal);
  void initiate_refused(Tick now, const Bytes& pdu);
  void acknowledged(Tick now);
  void answered(Tick now, const Bytes& pdu);
  void immediate_answer(Tick now, const Bytes& pdu);
  void initiate_answer(Tick now, const Bytes& pdu);
  void service_answer(Tick now, const Bytes& pdu);
  AcyclicResult& current() { return operations_.front().result; }

  ConnectionParameters parameters_;
  std::uint8_t master_;
  ConnectionState state_ = ConnectionState::kClosed;
  Behaviour behaviour_ = Behaviour::kNormal;
  Granted granted_;
  std::deque<AcyclicOperation> operations_;
  std::deque<RawAcyclic> raw_;
  AbortReason abort_;
  const char* abort_words_ = "";
  Asked asked_ = Asked::kInitiate;
  ConnectionState asked_in_ = ConnectionState::kClosed;
  bool acknowledged_initiate_ = false;  ///< kInitiating: by E5, SAP 49 is polled
  bool at_work_ = false;                ///< the first operation has been sent
  bool idle_at_work_ = false;           ///< kBusy with Idle
  Tick waiting_from_ = 0;               ///< begin of the wait in kInitiating, kConnecting and kBusy
  Tick last_answer_ = 0, next_poll_ = 0;
};

}  // namespace dsdpv1::bus
