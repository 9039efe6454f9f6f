// Check_Cfg (6.2.3, rulings D8, S14 to S17).
#include "model/profibus/dp_slave.hpp"

namespace dsdpv1::profibus {

Reply DpSlave::check_cfg(Cycle now, const Request& request) {
  if (state_ != DpState::kWaitCfg && state_ != DpState::kDataExch) return refuse_state(now, request, sap::kCheckCfg);
  if (held_by_other(request)) return refuse_master(now, request, sap::kCheckCfg);
  if (request.size > capacities_.cfg) {
    log_.at_cycle(now, Reason::kCfgTooLong, static_cast<unsigned>(request.size),
                  static_cast<unsigned>(capacities_.cfg));
    return Reply::status(fc::kRr);
  }
  const CfgLengths lengths = cfg_lengths(request.data, request.size);
  if (state_ == DpState::kDataExch) {
    if (check_cfg_equal(now, request, cfg_)) mail_cfg(now, request, lengths);  // S16
    return Reply::sc();
  }
  if (!check_cfg_bytes(now, request, lengths)) return Reply::sc();
  mail_cfg(now, request, lengths);
  cfg_.assign(request.data, request.size);
  if (config_.cfg_mode == Judging::kUser) {
    log_.at_cycle(now, Reason::kCfgJudged, request.sa, static_cast<unsigned>(request.size));
    cfg_awaited_ = true;
  } else {
    accept_cfg(now);
  }
  return Reply::sc();
}

bool DpSlave::check_cfg_bytes(Cycle now, const Request& request, const CfgLengths& lengths) {
  const bool user = config_.cfg_mode == Judging::kUser;
  if (config_.cfg_mode == Judging::kMaximum && (request.size == 0 || request.size > config_.max_cfg)) {
    refuse_cfg(now, Reason::kCfgLength, static_cast<unsigned>(request.size), static_cast<unsigned>(config_.max_cfg));
    return false;
  }
  if (config_.cfg_mode == Judging::kExact && !check_cfg_equal(now, request, config_.cfg)) return false;
  if (!lengths.complete()) {
    refuse_cfg(now, Reason::kCfgUndecodable, static_cast<unsigned>(request.size));
    return false;
  }
  const int max_input = user ? capacities_.io : config_.max_input;
  const int max_output = user ? capacities_.io : config_.max_output;
  if (lengths.input() > max_input || lengths.output() > max_output) {
    refuse_cfg(now, Reason::kCfgIoLength, static_cast<unsigned>(lengths.input()),
               static_cast<unsigned>(lengths.output()), static_cast<unsigned>(capacities_.io));
    return false;
  }
  return true;
}

bool DpSlave::check_cfg_equal(Cycle now, const Request& request, const Block<kMaxCfg>& expected) {
  if (expected.equals(request.data, request.size)) return true;
  int first = 0;
  while (first < expected.size && first < request.size &&
         expected.bytes[static_cast<std::size_t>(first)] == request.data[first])
    ++first;
  refuse_cfg(now, Reason::kCfgDiffers, static_cast<unsigned>(first), static_cast<unsigned>(expected.size),
             static_cast<unsigned>(request.size));
  return false;
}

void DpSlave::mail_cfg(Cycle now, const Request& request, const CfgLengths& lengths) {
  mail_.cfg.block.assign(request.data, request.size);
  mail_.cfg.input = lengths.input();
  mail_.cfg.output = lengths.output();
  mail_.cfg.due.set(now);
}

void DpSlave::refuse_cfg(Cycle now, Reason reason, unsigned a, unsigned b, unsigned c) {
  log_.at_cycle(now, reason, a, b, c);
  diagnosis_.cfg_fault();
  leave_to_wait_prm(now);
}

void DpSlave::accept_cfg(Cycle now) {
  const CfgLengths lengths = cfg_lengths(cfg_.bytes.data(), cfg_.size);
  log_.at_cycle(now, Reason::kCfgAccepted, master_, static_cast<unsigned>(lengths.input()),
                static_cast<unsigned>(lengths.output()));
  diagnosis_.cfg_good();
  cfg_awaited_ = false;
  if (lengths.input() != inputs_.size()) inputs_.reset(lengths.input());  // D10: zeros until the first valid block
  outputs_.reset(lengths.output());
  if (lengths.output() == 0) mail_.output.due.clear();
  enter(now, DpState::kDataExch);
}

void DpSlave::cfg_verdict(Cycle now, bool good) {
  if (mail_.cfg.due.waiting())
    log_.at_cycle(now, Reason::kVerdictSuperseded, 1);
  else if (!cfg_awaited_)
    log_.at_cycle(now, Reason::kVerdictUnexpected, 1);
  else if (good)
    accept_cfg(now);
  else
    refuse_cfg(now, Reason::kCfgUserRefused);
}

}  // namespace dsdpv1::profibus
