// Services that only read (rulings S4, S13): Get_Cfg (6.2.9), RD_Inp, RD_Outp; Slave_Diag is in diagnosis.cpp.
#include "model/profibus/dp_slave.hpp"
#include "model/profibus/user_side.hpp"

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
    case sap::kReadInputs: return reply_data(store_.read_inputs(now));
    case sap::kReadOutputs: return reply_data(store_.read_outputs(now));
    case sap::kGetCfg: return reply_data(store_.read_cfg(now, state_ == DpState::kDataExch));
    default: return slave_diag(now, request);
  }
}

Reply DpSlave::reply_data(const View& view) {
  if (view.size == View::kNoBuffer) return Reply::status(fc::kRr);
  return view.size == 0 ? Reply::sc() : Reply::with_data(fc::kDl, view.bytes, view.size);
}

// --- the user's side -------------------------------------------------------------------------------------------------

View UserSide::read_inputs(Cycle /*now*/) { return {inputs_.shown().bytes.data(), inputs_.size()}; }

View UserSide::read_outputs(Cycle /*now*/) { return {outputs_.shown().bytes.data(), outputs_.size()}; }

View UserSide::read_cfg(Cycle /*now*/, bool exchanging) {
  const Block<kMaxCfg>& cfg = exchanging ? cfg_ : config().cfg;  // 6.2.9
  return {cfg.bytes.data(), cfg.size};
}

}  // namespace dsdpv1::profibus
