#include "model/profibus/fdl.hpp"

namespace dsdpv1::profibus {

bool Fdl::addressed(Cycle now, const Telegram& telegram, std::uint8_t address, Request& request) {
  request.da = telegram.da & kAddressMask;
  request.sa = telegram.sa & kAddressMask;
  if (request.da != address && request.da != kBroadcast) return false;
  if ((telegram.fc & fc::kRequest) == 0) {
    log_.at_cycle(now, Reason::kResponse, telegram.fc, request.sa);
    return false;
  }
  if (!telegram.synced) {
    log_.at_cycle(now, Reason::kNoSyn, static_cast<unsigned>(telegram.idle_bits));
    return false;
  }
  if (request.sa == kBroadcast) {  // S32
    log_.at_cycle(now, Reason::kSa127, telegram.fc);
    return false;
  }
  request.code = telegram.fc & fc::kCode;
  if (!take_saps(now, telegram, request)) return false;
  if (request.da != kBroadcast || request.sdn()) return true;
  log_.at_cycle(now, Reason::kFunction, request.code, request.sa);
  return false;  // only SDN may be a broadcast
}

bool Fdl::take_saps(Cycle now, const Telegram& telegram, Request& request) {
  const bool dsap = (telegram.da & kSapBit) != 0, ssap = (telegram.sa & kSapBit) != 0;
  const int needed = static_cast<int>(dsap) + static_cast<int>(ssap);
  if (telegram.size < needed) {
    log_.at_cycle(now, Reason::kSapBytes, request.sa);
    return false;
  }
  int used = 0;
  if (dsap) request.dsap = telegram.data[used++];
  if (ssap) request.ssap = telegram.data[used++];
  request.data = telegram.data + used;
  request.size = telegram.size - used;
  return true;
}

bool Fdl::same_content(const Telegram& telegram, const Request& request) const {
  return memory_.fc == telegram.fc && memory_.fcs == telegram.fcs && memory_.dsap == request.dsap &&
         memory_.ssap == request.ssap && memory_.size == request.size;
}

bool Fdl::repetition(const Telegram& telegram, const Request& request) const {
  if ((telegram.fc & fc::kFcv) == 0 || !memory_.valid || memory_.sa != request.sa) return false;
  if (rule_ == FcbRule::kContent) return same_content(telegram, request);
  return !request.sdn() && ((telegram.fc ^ memory_.fc) & fc::kFcb) == 0;
}

// `moved`: the request has changed the station's address.
bool Fdl::remembers(std::uint8_t code, bool moved) const {
  if (rule_ == FcbRule::kContent) return (code & fc::kFcv) != 0;
  return (code & (fc::kFcv | fc::kFcb)) != 0 && !moved;
}

void Fdl::log_repetition(Cycle now, const Telegram& telegram, const Request& request) {
  if (same_content(telegram, request))
    log_.at_cycle(now, Reason::kRepetition, request.sa);
  else
    log_.at_cycle(now, Reason::kFcbNotToggled, request.sa, telegram.fc, static_cast<unsigned>(request.dsap));
}

const Frame* Fdl::execute(Cycle now, const Telegram& telegram, const Request& request, DpSlave& slave) {
  if (repetition(telegram, request)) {
    log_repetition(now, telegram, request);
    if (!slave.answers_afresh(request)) return &answer_;
  }
  const std::uint8_t address = slave.address();  // Set_Slave_Address is answered from the old one (S25)
  const Reply reply = slave.handle(now, request);
  if (reply.kind == Reply::Kind::kNothing) {
    if (rule_ == FcbRule::kLetter && request.da != kBroadcast) forget();
    return nullptr;
  }
  build_frame(request, reply, address, answer_);
  memory_ = {remembers(telegram.fc, slave.address() != address),
             request.sa,
             telegram.fc,
             telegram.fcs,
             request.dsap,
             request.ssap,
             request.size};
  return &answer_;
}

}  // namespace dsdpv1::profibus
