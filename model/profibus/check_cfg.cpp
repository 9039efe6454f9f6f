// Check_Cfg (6.2.3, rulings D8, S14 to S17).
#include "model/profibus/station.hpp"
#include "model/profibus/user_side.hpp"

namespace dsdpv1::profibus {

Reply DpSlave::check_cfg(Cycle now, const Request& request) {
  if (state_ != DpState::kWaitCfg && state_ != DpState::kDataExch) return refuse_state(now, request, sap::kCheckCfg);
  if (held_by_other(request)) return refuse_master(now, request, sap::kCheckCfg);
  const bool exchanging = state_ == DpState::kDataExch;
  switch (store_.configuration(now, request, exchanging)) {
    case Take::kAccepted:
      if (!exchanging) accept_cfg(now);
      break;
    case Take::kAwaited: cfg_awaited_ = true; break;
    case Take::kRefused: cfg_fault(now); break;
    case Take::kNoRoom: return Reply::status(fc::kRr);
  }
  return Reply::sc();
}

void DpSlave::cfg_fault(Cycle now) {
  diagnosis_.cfg_fault();
  leave_to_wait_prm(now);
}

void DpSlave::accept_cfg(Cycle now) {
  const IoLengths lengths = store_.configured();
  log_.at_cycle(now, Reason::kCfgAccepted, master_, static_cast<unsigned>(lengths.input),
                static_cast<unsigned>(lengths.output));
  diagnosis_.cfg_good();
  cfg_awaited_ = false;
  enter(now, DpState::kDataExch);
}

void DpSlave::cfg_verdict(Cycle now, bool good) {
  if (!cfg_awaited_) return log_.at_cycle(now, Reason::kVerdictUnexpected, 1);
  if (good) return accept_cfg(now);
  log_.at_cycle(now, Reason::kCfgUserRefused);
  cfg_fault(now);
}

// --- the user's side -------------------------------------------------------------------------------------------------

Take UserSide::configuration(Cycle now, const Request& request, bool exchanging) {
  if (request.size > capacities_.cfg) {
    log_.at_cycle(now, Reason::kCfgTooLong, static_cast<unsigned>(request.size),
                  static_cast<unsigned>(capacities_.cfg));
    return Take::kNoRoom;
  }
  const CfgLengths lengths = cfg_lengths(request.data, request.size);
  const bool right = exchanging ? check_cfg_equal(now, request, cfg_) : check_cfg_bytes(now, request, lengths);  // S16
  if (!right) return Take::kRefused;
  mail_cfg(now, request, lengths);
  cfg_.assign(request.data, request.size);
  if (exchanging || config().cfg_mode != Judging::kUser) return Take::kAccepted;
  log_.at_cycle(now, Reason::kCfgJudged, request.sa, static_cast<unsigned>(request.size));
  return Take::kAwaited;
}

bool UserSide::check_cfg_bytes(Cycle now, const Request& request, const CfgLengths& lengths) {
  const SlaveConfig& given = config();
  const bool user = given.cfg_mode == Judging::kUser;
  const auto refuse = [&](Reason reason, int a, int b = 0, int c = 0) {
    log_.at_cycle(now, reason, static_cast<unsigned>(a), static_cast<unsigned>(b), static_cast<unsigned>(c));
    return false;
  };
  if (given.cfg_mode == Judging::kMaximum && (request.size == 0 || request.size > given.max_cfg))
    return refuse(Reason::kCfgLength, request.size, given.max_cfg);
  if (given.cfg_mode == Judging::kExact && !check_cfg_equal(now, request, given.cfg)) return false;
  if (!lengths.complete()) return refuse(Reason::kCfgUndecodable, request.size);
  const int max_input = user ? capacities_.io : given.max_input;
  const int max_output = user ? capacities_.io : given.max_output;
  if (lengths.input() > max_input || lengths.output() > max_output)
    return refuse(Reason::kCfgIoLength, lengths.input(), lengths.output(), capacities_.io);
  return true;
}

bool UserSide::check_cfg_equal(Cycle now, const Request& request, const Block<kMaxCfg>& expected) {
  if (expected.equals(request.data, request.size)) return true;
  int first = 0;
  while (first < expected.size && first < request.size &&
         expected.bytes[static_cast<std::size_t>(first)] == request.data[first])
    ++first;
  log_.at_cycle(now, Reason::kCfgDiffers, static_cast<unsigned>(first), static_cast<unsigned>(expected.size),
                static_cast<unsigned>(request.size));
  return false;
}

void UserSide::mail_cfg(Cycle now, const Request& request, const CfgLengths& lengths) {
  mail_.cfg.block.assign(request.data, request.size);
  mail_.cfg.input = lengths.input();
  mail_.cfg.output = lengths.output();
  mail_.cfg.due.set(now);
}

IoLengths UserSide::configured() {
  const CfgLengths lengths = cfg_lengths(cfg_.bytes.data(), cfg_.size);
  if (lengths.input() != inputs_.size()) inputs_.reset(lengths.input());  // D10: zeros until the first valid block
  outputs_.reset(lengths.output());
  if (lengths.output() == 0) mail_.output.due.clear();
  return {lengths.input(), lengths.output()};
}

void UserSide::cfg_verdict(Cycle now, bool good) {
  if (mail_.cfg.due.waiting())
    log_.at_cycle(now, Reason::kVerdictSuperseded, 1);
  else
    station_.cfg_verdict(now, good);
}

}  // namespace dsdpv1::profibus
