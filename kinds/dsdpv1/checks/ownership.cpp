#include "kinds/dsdpv1/checks/ownership.hpp"

#include <algorithm>
#include <utility>

#include "bus/time_text.hpp"

namespace dsdpv1::checks {
namespace {

std::string no_context() { return {}; }

/// An access so soon after a release is one that the compiler has moved behind it.
constexpr Tick kSoon = 2 * bus::kTicksPerUs;

}  // namespace

void Ownership::reset(Tick at, bool low) {
  in_reset_ = low;
  reset_changed_ = at;
  both_own_since_.reset();
  alone_since_.reset();
  last_access_end_.reset();
  not_owned_since_.reset();
  accessing_ = false;
}

void Ownership::record(Check check, Tick at, Tick measured, const std::optional<Act>& act) {
  if (!in_reset_) recorder_.value(check, at, measured, no_context, act);
}

std::optional<Tick> Ownership::held_off_since() const {
  return holds_off() ? std::optional(std::max(held_off_since_, reset_changed_)) : std::nullopt;
}

void Ownership::r_req(Tick at, bool level) {
  const bool before = holds_off();
  r_req_ = level;
  holding_off_may_have_changed(at, before);
  const bool with_r_sta = r_sta_ && r_sta_rose_ == at;  // the order within a tick is irrelevant
  if (level) {
    r_req_rose_ = at;
    end_alone(at);
    if (with_r_sta) record(Check::kSyncWindow, at, at - held_off_since_);
  } else if (with_r_sta) {
    alone_since_ = at;
  }
  ownership_may_have_changed(at);
}

void Ownership::r_sta(Tick at, bool level) {
  const bool before = holds_off();
  r_sta_ = level;
  holding_off_may_have_changed(at, before);
  if (level) {
    r_sta_rose(at);
  } else {
    end_both_own(at);
    end_alone(at);
  }
  ownership_may_have_changed(at);
}

void Ownership::r_sta_rose(Tick at) {
  r_sta_rose_ = at;
  if (r_req_) {
    record(Check::kNoRequest, at, at - r_req_rose_);
    record(Check::kSyncWindow, at, at - held_off_since_);
    judge_looks(at);
  } else {
    alone_since_ = at;
  }
  if (l_sta_)
    both_own_since_ = at;
  else
    record(Check::kBothOwn, at, at - std::max(l_sta_fell_, held_off_since_));
}

/// In the window R_STA breaks the rule of kSyncWindow. A look that has found L_STA high is none.
void Ownership::judge_looks(Tick at) {
  const Limit& window = recorder_.limit(Check::kSyncWindow);
  if (!hears_looks_ || in_reset_ || (window.on && at - held_off_since_ < window.value)) return;
  const Tick look = std::min(l_req_look_, l_sta_look_);
  const Tick low_since = l_sta_ ? held_off_since_ : std::max(held_off_since_, l_sta_fell_);
  const bool none = look < low_since;
  const auto words = [&] {
    const auto is_meant = [&](Tick last) { return none ? last < low_since : last == look; };
    const char* const pins = !is_meant(l_sta_look_) ? "L_REQ" : !is_meant(l_req_look_) ? "L_STA" : "L_REQ and L_STA";
    return std::string(none ? "no look at " : "the last look at ") + pins +
           (none && look >= held_off_since_ ? " since they fell" : "");
  };
  recorder_.value(Check::kLookInWindow, at, none ? 0 : look - held_off_since_, words,
                  none ? Act::done(at) : Act::looked(look));
}

/// Both low for zero time does not count as low: the window continues (H2).
void Ownership::holding_off_may_have_changed(Tick at, bool before) {
  if (holds_off() == before) return;
  if (holds_off()) {
    if (at != freed_) held_off_since_ = at;
    return;
  }
  freed_ = at;
  const Tick since = std::max(held_off_since_, reset_changed_);
  record(Check::kNeverReleased, since, at - since, Act::omitted(since, at));
}

void Ownership::l_sta(Tick at, bool level) {
  l_sta_ = level;
  if (!level) {
    l_sta_fell_ = at;
    end_both_own(at);
  } else if (r_sta_) {
    both_own_since_ = at;
  }
}

void Ownership::end_both_own(Tick at) {
  if (both_own_since_) record(Check::kBothOwn, *both_own_since_, *both_own_since_ - at);
  both_own_since_.reset();
}

void Ownership::end_alone(Tick at) {
  if (alone_since_) record(Check::kNoRequest, *alone_since_, *alone_since_ - at);
  alone_since_.reset();
}

void Ownership::ownership_may_have_changed(Tick at) {
  if (std::exchange(owned_, owns()) == owns()) return;
  if (owned_) {
    owned_since_ = at;
    last_access_end_.reset();
    end_without_ownership(at);
  } else {
    ownership_lost(at);
  }
}

void Ownership::ownership_lost(Tick at) {
  if (accessing_) {
    not_owned_since_ = at;
    began_not_owned_ = false;
  } else if (last_access_end_) {
    record(Check::kReleasedInAccess, at, at - *last_access_end_);
  }
}

void Ownership::access_began(Tick at) {
  accessing_ = true;
  began_not_owned_ = !owns();
  if (began_not_owned_)
    not_owned_since_ = at;
  else
    record(Check::kNotOwner, at, at - owned_since_);
}

void Ownership::access_ended(Tick at) {
  accessing_ = false;
  last_access_end_ = at;
  end_without_ownership(at);
}

void Ownership::end_without_ownership(Tick at) {
  if (!not_owned_since_) return;
  const Tick since = *std::exchange(not_owned_since_, std::nullopt);
  if (!began_not_owned_) return record(Check::kReleasedInAccess, since, since - at);
  const Tick late = since - freed_;
  if (!in_reset_)
    recorder_.value(Check::kNotOwner, since, since - at, [this, late] {
      const bool scattered = !holds_off() && freed_ >= 0 && late < kSoon;
      return scattered ? bus::short_time(late) + " after the release: is the pointer volatile?" : std::string();
    });
}

void Ownership::finish(Tick at) {
  end_both_own(at);
  end_alone(at);
  if (accessing_) end_without_ownership(at);
  if (const std::optional<Tick> since = held_off_since())
    record(Check::kNeverReleased, *since, at - *since, Act::omitted(*since, at));
}

}  // namespace dsdpv1::checks
