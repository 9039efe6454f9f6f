#include "model/profibus/msac2.hpp"

#include <algorithm>
#include <initializer_list>

namespace dsdpv1::profibus {
namespace {

constexpr int kArea = 2, kSsap = 50;
constexpr Cycle kCyclesPerUnit = 10 * kCyclesPerMs;  // Send_Timeout counts 10 ms
constexpr int kLargestTimer = 0xFFFF;                // 16 bit, table 33
// Initiate: Function_Num, 3 reserved, Send_Timeout, Features, Profile_Features, Profile_Ident, Add_Addr
constexpr int kSendTimeout = 4, kFeatures = 6, kAddAddr = 12, kLeastInitiate = 14;
constexpr std::uint8_t kReadWrite = 0x01;  // Features_Supported, first byte
// The second byte of an abort PDU is the subnet, the third instance and reason (V11).
constexpr std::uint8_t kNoSubnet = 0, kInstance = 0x10;
constexpr std::uint8_t kSequenceError = 1, kInvalidPdu = 2, kTimeout = 3, kInvalidAddAddr = 7;
constexpr unsigned kFTimer = 1, kITimer = 2, kUTimer = 3;

void put(Pdu& pdu, std::initializer_list<std::uint8_t> bytes) {
  pdu.assign(bytes.begin(), static_cast<int>(bytes.size()));
}

// Add_Addr is two API bytes, or `S_Type, S_Len, D_Type, D_Len, S_Addr, D_Addr` (V10).
constexpr int kShortAddr = 2, kLongAddr = 4;

bool addresses_right(const std::uint8_t* addr, int size) {
  return size == kShortAddr || (size >= kLongAddr && size == kLongAddr + addr[1] + addr[3]);
}

/// Appends Add_Addr with source and destination exchanged.
void exchange_addresses(const std::uint8_t* addr, int size, Pdu& pdu) {
  std::uint8_t* to = pdu.bytes.data() + pdu.size;
  pdu.size += size;
  if (size == kShortAddr) {
    to[0] = addr[1];
    to[1] = addr[0];
    return;
  }
  const std::uint8_t* source = addr + kLongAddr;
  const std::uint8_t* destination = source + addr[1];
  to = std::copy_n(addr + 2, 2, to);
  to = std::copy_n(addr, 2, to);
  to = std::copy_n(destination, addr[3], to);
  std::copy_n(source, addr[1], to);
}

int send_timeout(const std::uint8_t* initiate) { return initiate[kSendTimeout] << 8 | initiate[kSendTimeout + 1]; }

bool well_formed(const std::uint8_t* pdu, int size) {
  return pdu[0] == dpv1::kInitiate && size >= kLeastInitiate && send_timeout(pdu) != 0;
}

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

// --- the resource manager --------------------------------------------------------------------------------------------

int Msac2::free_channel() const {
  for (int channel = 0; channel < kC2Channels; ++channel)
    if (state(channel) == State::kFree) return channel;
  return kNobody;
}

Reply Msac2::initiate(Cycle now, const Request& request) {
  if (!ssap_right(now, log_, request, kSsap)) return Reply::status(fc::kRs);
  if (request.size == 0) return Reply::sc();
  if (!well_formed(request.data, request.size)) {
    log_.at_cycle(now, Reason::kC2InitiateWrong, request.data[0], static_cast<unsigned>(request.size));
    return Reply::status(fc::kRs);
  }
  const int free = free_channel();
  if (free == kNobody) {
    log_.at_cycle(now, Reason::kC2Full, request.sa);
    return Reply::status(fc::kRs);
  }
  Channel& channel = channel_at(free);
  channel.pdu.assign(request.data, request.size);
  const int units = send_timeout(request.data);
  log_.at_cycle(now, Reason::kC2Initiate, sap_of(free), request.sa, static_cast<unsigned>(units));
  channel.master = request.sa;
  enter(now, free, State::kInitiated);
  channel.timeout = units * kCyclesPerUnit;
  channel.idle_timeout = std::min(2 * units, kLargestTimer) * kCyclesPerUnit;
  channel.watch = now + channel.timeout;
  put(reply_, {dpv1::kInitiateNow, static_cast<std::uint8_t>(sap_of(free)), request.data[kSendTimeout],
               request.data[kSendTimeout + 1]});
  return Reply::with_data(fc::kDl, reply_.bytes.data(), reply_.size);
}

// --- a channel -------------------------------------------------------------------------------------------------------

bool Msac2::lent_to_sender(const Request& request) const {
  const Channel& channel = channel_at(channel_of(request));
  return channel.state != State::kFree && channel.master == request.sa && request.ssap == kSsap;
}

/// Why a channel is not the sender's.
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

Reply Msac2::connect(Cycle now, int number) {
  Channel& channel = channel_at(number);
  const std::uint8_t* initiate = channel.pdu.bytes.data();
  const int addr_size = channel.pdu.size - kAddAddr;
  if ((initiate[kFeatures] & kReadWrite) == 0) {
    log_.at_cycle(now, Reason::kC2InitiateRefused, sap_of(number), dpv1::kNotSupported);
    free(now, number);
    negative_answer(dpv1::kInitiate, dpv1::kNotSupported, reply_);
  } else if (!addresses_right(initiate + kAddAddr, addr_size)) {
    log_.at_cycle(now, Reason::kC2AddAddr, sap_of(number), static_cast<unsigned>(addr_size));
    return send_abort(now, number, kInvalidAddAddr);
  } else {
    log_.at_cycle(now, Reason::kC2Connected, sap_of(number), channel.master);
    enter(now, number, State::kOpen);
    channel.watch = now + channel.idle_timeout;
    put(reply_, {dpv1::kInitiate, static_cast<std::uint8_t>(capacity_), kReadWrite, 0, 0, 0, 0, 0});
    exchange_addresses(initiate + kAddAddr, addr_size, reply_);
  }
  return Reply::with_data(fc::kDl, reply_.bytes.data(), reply_.size);
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

/// A request that the chip cannot serve is acknowledged; the next telegram gets the abort (V9, V11).
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

void Msac2::eval(Cycle now) {
  for (int channel = 0; channel < kC2Channels; ++channel)
    if (now >= std::min(channel_at(channel).watch, channel_at(channel).user)) expire(now, channel);
}

Cycle Msac2::next() const {
  Cycle next = kNever;
  for (const Channel& channel : channels_) next = std::min({next, channel.watch, channel.user});
  return next;
}

void Msac2::expire(Cycle now, int number) {
  const Channel& channel = channel_at(number);
  if (channel.state == State::kAborted) {
    log_.at_cycle(now, Reason::kC2Freed, sap_of(number), channel.master);
    return free(now, number);
  }
  const bool watch = now >= channel.watch;
  const unsigned timer = !watch ? kUTimer : channel.state == State::kOpen ? kITimer : kFTimer;
  log_.at_cycle(now, Reason::kC2Timeout, sap_of(number), timer, channel.master);
  abort(now, number, kTimeout);
}

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
