// DPV1 in a random case: Initiate, polls and requests on SAPs 51, 49, 48 and 47 (V1 to V14).
#include <algorithm>

#include "cosim/random/random_master.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr int kSapOfChannel[] = {51, 48, 47};  // by channel
constexpr int kC1Ssap = 51, kC2Ssap = 50, kInitiateSap = 49;
constexpr std::uint8_t kRead = 0x5E, kWrite = 0x5F, kTransport = 0x51, kIdle = 0x48, kAbort = 0x58, kInitiate = 0x57;

}  // namespace

void RandomMaster::send_acyclic(int dsap, int ssap, const bus::Bytes& data) {
  if (!sure_ && random_.one_in(careful_ ? 20 : 8)) ssap ^= 1;
  bus::Telegram telegram = bus::make_telegram(setup_.address, master(), function_code(), data,
                                              static_cast<std::uint8_t>(dsap), static_cast<std::uint8_t>(ssap));
  if (!sure_ && random_.one_in(30)) telegram.sa = 3;
  if (!sure_ && random_.one_in(40)) telegram.fc = bus::fc::kRequest | bus::fc::kSdnHigh;
  send(telegram);
}

void RandomMaster::acyclic_poll(int channel) {
  send_acyclic(kSapOfChannel[channel], channel == 0 ? kC1Ssap : kC2Ssap, {});
}

void RandomMaster::acyclic_request(int channel) {
  send_acyclic(kSapOfChannel[channel], channel == 0 ? kC1Ssap : kC2Ssap, acyclic_pdu(channel));
}

void RandomMaster::abort(int channel) { send_acyclic(kSapOfChannel[channel], kC2Ssap, {kAbort, 0, 0x20, 0}); }

/// Usually valid: what a slave can answer with the user's help.
bus::Bytes RandomMaster::acyclic_pdu(int channel) {
  constexpr std::uint8_t kFunctions[] = {kRead, kRead, kWrite, kWrite, kTransport};
  if (channel != 0 && !sure_ && random_.one_in(8)) return {random_.one_in(2) ? kIdle : kAbort, 0, 0x20, 0};
  const std::uint8_t function = sure_ ? kRead : random_.one_in(16) ? random_.byte() : random_.pick(kFunctions);
  setup_.function[channel] = function;
  setup_.slot[channel] = static_cast<std::uint8_t>(random_.below(3));
  setup_.index[channel] = static_cast<std::uint8_t>(random_.below(3));
  const int length = !sure_ && random_.one_in(12) ? random_.between(238, 242) : random_.below(6);
  bus::Bytes pdu = {function, setup_.slot[channel], setup_.index[channel], static_cast<std::uint8_t>(length)};
  if (function == kRead && (sure_ || !random_.one_in(12))) return pdu;
  const int bytes = random_.one_in(6) ? random_.below(8) : std::min(length, 240);
  const bus::Bytes data = random_.bytes(bytes);
  pdu.insert(pdu.end(), data.begin(), data.end());
  if (random_.one_in(24)) pdu.resize(static_cast<std::size_t>(random_.between(1, 4)));
  return pdu;
}

void RandomMaster::wait_timer(int ms, bool polls, int sa) {
  constexpr Tick kStep = bus::kTicksPerMs, kTelegram = 700 * profibus::kTicksPerCycle;
  for (; ms > 1; --ms) {
    extra_ += kStep - kTelegram * (polls ? 2 : 1);
    if (!polls)
      send(bus::make_telegram(setup_.address, static_cast<std::uint8_t>(sa), bus::fc::kRequest | bus::fc::kFdlStatus));
    for (int channel = 1; polls && channel <= 2; ++channel) acyclic_poll(channel);
  }
  extra_ += ms * kStep + random_.between(-4000, 1500) * profibus::kTicksPerCycle;
}

/// Add_Addr in both forms, and in none.
void RandomMaster::initiate(int timeout) {
  const auto high = static_cast<std::uint8_t>(timeout >> 8), low = static_cast<std::uint8_t>(timeout & 0xFF);
  bus::Bytes pdu = {kInitiate, 0, 0, 0, high, low, 1, 0, 0, 0, 0, 0};
  if (!sure_ && random_.one_in(12)) pdu[5] = static_cast<std::uint8_t>(random_.below(3));
  if (!sure_ && random_.one_in(8)) pdu[6] = 0;
  if (!sure_ && random_.one_in(3)) {  // S_Type, S_Len, D_Type, D_Len, S_Addr, D_Addr
    const int source = random_.below(3), destination = random_.below(3);
    const bus::Bytes addresses = random_.bytes(source + destination + (random_.one_in(3) ? 1 : 0));
    for (const int each : {random_.below(2), source, random_.below(2), destination})
      pdu.push_back(static_cast<std::uint8_t>(each));
    pdu.insert(pdu.end(), addresses.begin(), addresses.end());
  } else {
    pdu.push_back(random_.byte());
    pdu.push_back(random_.byte());
  }
  if (!sure_ && random_.one_in(16)) pdu.resize(static_cast<std::size_t>(random_.between(1, 16)), 0);
  send_acyclic(kInitiateSap, kC2Ssap, pdu);
}

}  // namespace dsdpv1::cosim
