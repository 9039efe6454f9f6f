// Services that only read (rulings S4, S13): Get_Cfg (6.2.9), RD_Inp, RD_Outp; Slave_Diag is in diagnosis.cpp.
#include "model/profibus/dp_slave.hpp"

namespace dsdpv1::profibus {

// Requests without data (S13).
Reply DpSlave::read_only(Cycle now, const Request& request) {
  const bool of_exchange = request.dsap == sap::kReadInputs || request.dsap == sap::kReadOutputs;
  if (of_exchange && state_ != DpState::kDataExch) return refuse_state(now, request, request.dsap);
  if (request.size > 0) {
    log_.at_cycle(now, Reason::kSapData, static_cast<unsigned>(request.dsap), static_cast<unsigned>(request.size),
                  request.sa);
    return Reply::status(fc::kRr);
  }
  switch (request.dsap) {
    case sap::kReadInputs: return reply_data(inputs_.shown().bytes.data(), inputs_.size());
    case sap::kReadOutputs: return reply_data(outputs_.shown().bytes.data(), outputs_.size());
    case sap::kGetCfg: return get_cfg();
    default: return slave_diag(request);
  }
}

Reply DpSlave::get_cfg() const {
  const Block<kMaxCfg>& cfg = state_ == DpState::kDataExch ? cfg_ : config_.cfg;  // 6.2.9
  return reply_data(cfg.bytes.data(), cfg.size);
}

Reply DpSlave::reply_data(const std::uint8_t* data, int size) const {
  return size == 0 ? Reply::sc() : Reply::with_data(fc::kDl, data, size);
}

}  // namespace dsdpv1::profibus
