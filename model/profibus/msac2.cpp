#include "model/profibus/msac2.hpp"

namespace dsdpv1::profibus {
namespace {

constexpr int kArea = 2;
// The second byte of an abort PDU is the subnet, the third instance and reason (V11).
constexpr std::uint8_t kNoSubnet = 0, kInstance = 0x10;

}  // namespace

void Msac2::reset() {
  for (Channel& channel : channels_) channel = Channel();
  turn_ = kNobody;
}

RmEntry Msac2::entry(int number) const {
  const Channel& channel = channel_at(number);
  RmEntry entry;
  entry.in_use = channel.state != State::kFree;
  entry.master = entry.in_use ? channel.master : std::uint8_t{0};
  entry.exchanging = channel.state == State::kBusy || channel.state == State::kAnswered;
  entry.connected = entry.exchanging || channel.state == State::kOpen;
  return entry;
}

RmRegistry Msac2::registry() const {
  RmRegistry registry;
  for (int channel = 0; channel < kC2Channels; ++channel) registry[static_cast<std::size_t>(channel)] = entry(channel);
  return registry;
}

void Msac2::enter(Cycle now, int number, State state) {
  const unsigned before = entry(number).bits();
  channel_at(number).state = state;
  const RmEntry after = entry(number);
  if (after.bits() != before) log_.at_cycle(now, Reason::kRmEntry, sap_of(number), after.master, after.bits());
}

// --- a channel -------------------------------------------------------------------------------------------------------

bool Msac2::lent_to_sender(const Request& request) const {
  const Channel& channel = channel_at(channel_of(request));
  return channel.state != State::kFree && channel.master == request.sa && request.ssap == kSsap;
}

/// Why the sender may not use the channel.
Reply Msac2::refuse(Cycle now, const Request& request) const {
  const Channel& channel = channel_at(channel_of(request));
  const auto sap = static_cast<unsigned>(request.dsap);
  if (channel.state == State::kFree)
    log_.at_cycle(now, Reason::kC2NotInUse, sap, request.sa);
  else if (channel.master != request.sa)
    log_.at_cycle(now, Reason::kC2Master, sap, request.sa, channel.master);
  else
    ssap_right(now, log_, request, kSsap);
  return Reply::status(fc::kRs);
}

Reply Msac2::handle(Cycle now, const Request& request) {
  if (!lent_to_sender(request)) return refuse(now, request);
  const int channel = channel_of(request);
  if (request.size == 0) return poll(now, channel);
  if (request.data[0] != dpv1::kAbort) return this->request(now, channel, request);
  aborted_by_master(now, request);
  return Reply::sc();
}

bool Msac2::abort_unanswered(Cycle now, const Request& request) {
  if (!lent_to_sender(request) || request.size == 0 || request.data[0] != dpv1::kAbort) return false;
  aborted_by_master(now, request);
  return true;
}

void Msac2::aborted_by_master(Cycle now, const Request& request) {
  const int channel = channel_of(request);
  log_.at_cycle(now, Reason::kC2AbortedByMaster, sap_of(channel), request.size > 2 ? request.data[2] : 0U,
                request.size > 3 ? request.data[3] : 0U);
  free(now, channel);
}

Reply Msac2::poll(Cycle now, int number) {
  Channel& channel = channel_at(number);
  switch (channel.state) {
    case State::kInitiated: return connect(now, number);
    case State::kAnswered: return send_answer(now, number);
    case State::kAborted: return send_abort(now, number, channel.abort_reason);
    case State::kBusy: channel.watch = now + channel.timeout; break;
    default: break;
  }
  return Reply::sc();
}

Reply Msac2::request(Cycle now, int number, const Request& request) {
  Channel& channel = channel_at(number);
  const std::uint8_t function = request.data[0];
  switch (channel.state) {
    case State::kInitiated: return abort_for_request(now, number, function, kSequenceError);
    case State::kAborted: return send_abort(now, number, channel.abort_reason);
    case State::kOpen: break;
    default: log_.at_cycle(now, Reason::kAcyclicOpen, sap_of(number), function); return Reply::status(fc::kRr);
  }
  channel.watch = now + channel.timeout;
  if (function == dpv1::kIdle) {
    put(channel.pdu, {dpv1::kIdle});
    enter(now, number, State::kAnswered);
  } else if (function == dpv1::kInitiate) {
    return abort_for_request(now, number, function, kSequenceError);
  } else if (request_fault(request.data, request.size, {capacity_, true}) != 0) {
    return abort_for_request(now, number, function, kInvalidPdu);
  } else {
    log_.at_cycle(now, Reason::kC2Request, sap_of(number) << 8 | function, request.data[1], request.data[2]);
    channel.pdu.assign(request.data, request.size);
    enter(now, number, State::kBusy);
    if (turn_ == kNobody) begin_turn(now, number);
  }
  return Reply::sc();
}

Reply Msac2::send_answer(Cycle now, int number) {
  Channel& channel = channel_at(number);
  if (channel.pdu.bytes[0] != dpv1::kIdle)
    log_.at_cycle(now, Reason::kC2Answer, sap_of(number), channel.pdu.bytes[0],
                  static_cast<unsigned>(channel.pdu.size));
  enter(now, number, State::kOpen);
  channel.watch = now + channel.idle_timeout;
  return Reply::with_data(fc::kDl, channel.pdu.bytes.data(), channel.pdu.size);
}

/// Acknowledges a request that the chip cannot serve; the next telegram is answered with the abort (V9, V11).
Reply Msac2::abort_for_request(Cycle now, int number, std::uint8_t function, std::uint8_t reason) {
  log_.at_cycle(now, Reason::kC2WrongRequest, sap_of(number), function, reason);
  abort(now, number, reason);
  return Reply::sc();
}

Reply Msac2::send_abort(Cycle now, int number, std::uint8_t reason) {
  const auto instance_reason = static_cast<std::uint8_t>(kInstance | reason);
  log_.at_cycle(now, Reason::kC2Abort, sap_of(number), instance_reason);
  free(now, number);
  put(reply_, {dpv1::kAbort, kNoSubnet, instance_reason});
  return Reply::with_data(fc::kDl, reply_.bytes.data(), reply_.size);
}

void Msac2::answer(Cycle now, const std::uint8_t* pdu, int size) {
  if (turn_ == kNobody || mail_.due.waiting()) return log_.at_cycle(now, Reason::kAcyclicNoRequest, kArea);
  if (!answer_fits(now, log_, kArea, pdu, mail_.pdu)) return;
  const int number = turn_;
  channel_at(number).pdu.assign(pdu, size);
  enter(now, number, State::kAnswered);
  end_turn(now, number);
}

// --- timers ----------------------------------------------------------------------------------------------------------

void Msac2::abort(Cycle now, int number, std::uint8_t reason) {
  Channel& channel = channel_at(number);
  enter(now, number, State::kAborted);
  channel.abort_reason = reason;
  channel.watch = now + channel.timeout;
  end_turn(now, number);
}

void Msac2::free(Cycle now, int number) {
  Channel& channel = channel_at(number);
  enter(now, number, State::kFree);
  channel.watch = kNever;
  end_turn(now, number);
}

// --- the user's attention, which both channels share (V4) ------------------------------------------------------------

void Msac2::begin_turn(Cycle now, int number) {
  Channel& channel = channel_at(number);
  turn_ = number;
  mail_.pdu = channel.pdu;
  mail_.due.set(now);
  channel.user = now + channel.timeout;
}

void Msac2::end_turn(Cycle now, int number) {
  channel_at(number).user = kNever;
  if (turn_ != number) return;
  turn_ = kNobody;
  mail_.due.clear();
  const int other = 1 - number;
  if (channel_at(other).state == State::kBusy) begin_turn(now, other);
}

}  // namespace dsdpv1::profibus
