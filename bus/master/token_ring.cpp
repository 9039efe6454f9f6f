#include "bus/master/token_ring.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::bus {

namespace {

/// Station type, bits 5 and 4 of the FC of an answer (EN 50170): the state of an active station in FDL status.
constexpr unsigned kTypeMask = 0x30, kNotReady = 0x10, kReady = 0x20, kInRing = 0x30;

}  // namespace

const char* name(RingState state) {
  switch (state) {
    case RingState::kOff: return "OFF";
    case RingState::kListenToken: return "LISTEN_TOKEN";
    case RingState::kClaimToken: return "CLAIM_TOKEN";
    case RingState::kActiveIdle: return "ACTIVE_IDLE";
    case RingState::kUseToken: return "USE_TOKEN";
    case RingState::kGapPoll: return "GAP_POLL";
    case RingState::kPassToken: return "PASS_TOKEN";
    case RingState::kOut: return "OUT";
  }
  return "";
}

TokenRing::TokenRing(MasterFdl& fdl, std::uint8_t address, const BusParameters& parameters)
    : fdl_(fdl), address_(address), parameters_(parameters) {
  fdl_.on_heard = [this](const HeardTelegram& telegram) { heard(telegram); };
}

void TokenRing::set_baud(int index) {
  baud_ = index;
  bit_ = bus::baud(index).bit;
}

bool TokenRing::in_ring() const {
  return state_ == RingState::kActiveIdle || state_ == RingState::kUseToken || state_ == RingState::kGapPoll ||
         state_ == RingState::kPassToken;
}

void TokenRing::go(Tick now, RingState state, const char* why) {
  const RingState from = std::exchange(state_, state);
  if (from != state && on_state) on_state(now, from, state, why);
}

void TokenRing::start(Tick now) {
  if (state_ != RingState::kOff && state_ != RingState::kOut) return;
  duplicates_ = 0;
  token_at_ = kNever;
  gap_running_ = false;
  gap_due_ = now;
  listen_anew(now, "started");
}

void TokenRing::stop(Tick now) {
  asking_ = false;
  go(now, RingState::kOff, "stopped");
}

void TokenRing::listen_anew(Tick now, const char* why) {
  quiet_from_ = now;
  stranger_ = -1;
  learner_.reset();
  stations_.clear();
  go(now, RingState::kListenToken, why);
}

// --- the token is elsewhere ------------------------------------------------------------------------------------------

Tick TokenRing::timeout() const {
  // EN 50170: T_TO = 6 T_SL + 2 n T_SL, so the master with the lowest address comes first.
  return std::max(quiet_from_, fdl_.last_activity()) + bits((6 + 2 * Tick{address_}) * parameters_.slot(baud_));
}

Tick TokenRing::next() const {
  const bool waiting = state_ == RingState::kListenToken || state_ == RingState::kActiveIdle;
  return waiting && fdl_.idle() ? timeout() : kNever;
}

bool TokenRing::act(Tick now) {
  switch (state_) {
    case RingState::kListenToken:
    case RingState::kActiveIdle: return claim(now);
    case RingState::kClaimToken: send_token(now, address_); return true;
    case RingState::kPassToken: send_token(now, stations_.next_after(address_)); return true;
    case RingState::kGapPoll: poll_gap(now); return true;
    default: return false;
  }
}

/// A master that was in the ring keeps its LAS and continues with it; otherwise it begins a new ring.
bool TokenRing::claim(Tick now) {
  if (now < timeout()) return false;
  ++statistics_.claims;
  if (state_ == RingState::kActiveIdle) {
    take_token(now, "the token was lost");
    return true;
  }
  stations_.clear();
  stations_.add(address_);
  claims_left_ = kClaimTokens;
  go(now, RingState::kClaimToken, "the bus is silent");
  return true;
}

void TokenRing::take_token(Tick now, const char* why) {
  if (token_at_ != kNever) statistics_.rotations.add(now - token_at_);
  const Tick before = std::exchange(token_at_, now);
  hold_until_ = (before == kNever ? now : before) + bits(parameters_.target_rotation_bits);
  high_sent_ = false;
  stranger_ = -1;
  go(now, RingState::kUseToken, why);
}

// --- the token is here -----------------------------------------------------------------------------------------------

void TokenRing::release(Tick now) {
  attempts_ = 0;
  const bool gap = next_gap_address(now);
  go(now, gap ? RingState::kGapPoll : RingState::kPassToken, "nothing more to send");
}

/// One address of the GAP, from the own address to the next station, at each token; the next round begins G x T_TR
/// after the end of the last.
bool TokenRing::next_gap_address(Tick now) {
  if (parameters_.gap_factor <= 0 || now >= hold_until_) return false;
  if (!gap_running_) {
    if (now < gap_due_) return false;
    gap_running_ = true;
    gap_address_ = address_;
  }
  gap_address_ =
      gap_address_ >= parameters_.highest_address ? std::uint8_t{0} : static_cast<std::uint8_t>(gap_address_ + 1);
  if (gap_address_ != address_ && gap_address_ != stations_.next_after(address_)) return true;
  gap_running_ = false;
  gap_due_ = now + bits(Tick{parameters_.gap_factor} * parameters_.target_rotation_bits);
  return false;
}

void TokenRing::poll_gap(Tick now) {
  FdlRequest request;
  request.telegram = make_telegram(gap_address_, address_, fc::kRequest | fc::kFdlStatus);
  asking_ = true;
  fdl_.start(now, std::move(request));
}

void TokenRing::send_token(Tick now, std::uint8_t to) {
  FdlRequest request;
  request.telegram = make_token(to, address_);
  request.await_activity = to != address_;
  asking_ = true;
  fdl_.start(now, std::move(request));
}

void TokenRing::done(Tick now, const FdlResult& result) {
  asking_ = false;
  if (result.outcome == FdlOutcome::kAborted) return;
  if (!result.read_back) {
    ++statistics_.tokens_given_up;
    return listen_anew(now, "another station sends at the same time");
  }
  switch (state_) {
    case RingState::kClaimToken: return claim_sent(now);
    case RingState::kGapPoll: return gap_answered(now, result);
    case RingState::kPassToken: return token_sent(now, result);
    default: return;
  }
}

void TokenRing::claim_sent(Tick now) {
  if (--claims_left_ == 0) take_token(now, "the ring is begun");
}

void TokenRing::gap_answered(Tick now, const FdlResult& result) {
  const bool ready =
      result.answered() && result.answer.kind != TelegramKind::kSc && (result.answer.fc & kTypeMask) == kReady;
  if (ready) {
    ++statistics_.stations_found;
    stations_.add(gap_address_);
  }
  go(now, RingState::kPassToken, ready ? "a new master in the GAP" : "nothing new in the GAP");
}

void TokenRing::token_sent(Tick now, const FdlResult& result) {
  const std::uint8_t to = result.request.da;
  if (to == address_) return take_token(now, "alone in the ring");
  if (result.outcome == FdlOutcome::kSent) {
    quiet_from_ = now;
    return go(now, RingState::kActiveIdle, "the next station has the token");
  }
  if (++attempts_ < kTokenAttempts) {
    ++statistics_.token_retries;
    return;
  }
  ++statistics_.stations_dropped;
  stations_.remove(to);
  attempts_ = 0;
}

// --- reception -------------------------------------------------------------------------------------------------------

void TokenRing::heard(const HeardTelegram& heard) {
  if (state_ == RingState::kOff || state_ == RingState::kOut) return;
  const Telegram& telegram = heard.telegram;
  if (telegram.is_response()) return;
  if (state_ != RingState::kListenToken && state_ != RingState::kActiveIdle) {
    // Two masters have the token: this one drops its token (EN 50170: back to Active_Idle).
    ++statistics_.tokens_given_up;
    quiet_from_ = heard.end;
    go(heard.end, RingState::kActiveIdle, "another master has the token, too");
    fdl_.abort(heard.end);
  }
  if (telegram.sa == address_) return own_address_heard(heard.end);
  if (telegram.kind == TelegramKind::kSd4) return token_heard(heard);
  request_heard(heard);
}

void TokenRing::own_address_heard(Tick now) {
  if (state_ == RingState::kActiveIdle) return listen_anew(now, "another station sends with this address");
  if (++duplicates_ >= kDuplicateLimit) go(now, RingState::kOut, "another master has this address");
}

void TokenRing::token_heard(const HeardTelegram& heard) {
  const std::uint8_t sa = heard.telegram.sa, da = heard.telegram.da;
  if (state_ == RingState::kListenToken) {
    learner_.token_passed(sa, da);
    if (learner_.valid()) stations_ = learner_.stations();
    return;
  }
  if (da == address_) return token_for_us(heard);
  stranger_ = -1;
  if (token_skips(sa, da, address_)) {
    listen_anew(heard.end, "the token was passed over this station");
    return learner_.token_passed(sa, da);
  }
  stations_.token_passed(sa, da);
}

/// EN 50170: accepted from the previous station at once; from another only if repeated.
void TokenRing::token_for_us(const HeardTelegram& heard) {
  const std::uint8_t sa = heard.telegram.sa;
  if (sa != stations_.previous_of(address_) && stranger_ != sa) {
    stranger_ = sa;
    return;
  }
  stations_.token_passed(sa, address_);
  fdl_.not_before(heard.end + bits(parameters_.id1(baud_)));
  take_token(heard.end, "token received");
}

void TokenRing::request_heard(const HeardTelegram& heard) {
  const Telegram& request = heard.telegram;
  if (request.da != address_ || !request.wants_answer()) return;
  const bool status = request.function() == fc::kFdlStatus;
  if (state_ == RingState::kActiveIdle) return respond(heard, kInRing | (status ? fc::kOk : fc::kRs));
  if (!status) return;
  if (!learner_.valid()) return respond(heard, kNotReady);
  respond(heard, kReady);
  stations_.add(address_);
  quiet_from_ = heard.end;
  go(heard.end, RingState::kActiveIdle, "asked to enter the ring");
}

void TokenRing::respond(const HeardTelegram& heard, unsigned function_code) {
  fdl_.respond(heard.end, make_telegram(heard.telegram.sa, address_, static_cast<std::uint8_t>(function_code)));
}

}  // namespace dsdpv1::bus
