// C2 Initiate (7.3, tables 30 and 33; rulings V2, V3, V10): the resource manager lends a channel and the connection is
// made.
#include <algorithm>

#include "model/profibus/msac2.hpp"

namespace dsdpv1::profibus {
namespace {

constexpr Cycle kCyclesPerUnit = 10 * kCyclesPerMs;  // Send_Timeout counts 10 ms
constexpr int kLargestTimer = 0xFFFF;                // 16 bit, table 33
// Initiate: Function_Num, 3 reserved, Send_Timeout, Features, Profile_Features, Profile_Ident, Add_Addr
constexpr int kSendTimeout = 4, kFeatures = 6, kAddAddr = 12, kLeastInitiate = 14;
constexpr std::uint8_t kReadWrite = 0x01;  // Features_Supported, first byte

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
  const int units = std::max(send_timeout(request.data), offer_.least_timeout);
  log_.at_cycle(now, Reason::kC2Initiate, sap_of(free), request.sa, static_cast<unsigned>(units));
  channel.master = request.sa;
  enter(now, free, State::kInitiated);
  channel.timeout = units * kCyclesPerUnit;
  channel.idle_timeout = std::min(2 * units, kLargestTimer) * kCyclesPerUnit;
  channel.watch = now + channel.timeout;
  put(reply_, {dpv1::kInitiateNow, static_cast<std::uint8_t>(sap_of(free)), static_cast<std::uint8_t>(units >> 8),
               static_cast<std::uint8_t>(units & 0xFF)});
  return Reply::with_data(fc::kDl, reply_.bytes.data(), reply_.size);
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
    const auto& offered = offer_.features;
    put(reply_,
        {dpv1::kInitiate, offer_.most_data, offered[0], offered[1], offered[2], offered[3], offered[4], offered[5]});
    exchange_addresses(initiate + kAddAddr, addr_size, reply_);
  }
  return Reply::with_data(fc::kDl, reply_.bytes.data(), reply_.size);
}

}  // namespace dsdpv1::profibus
