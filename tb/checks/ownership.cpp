#include "tb/checks/ownership.hpp"

#include <algorithm>
#include <utility>

namespace checks {
namespace {

std::string no_context() { return {}; }

}  // namespace

void Ownership::reset() {
  r_sta_fell_.reset();
  both_own_since_.reset();
  no_request_since_.reset();
  last_access_end_.reset();
  not_owned_since_.reset();
  accessing_ = false;
}

void Ownership::r_req(Tick at, bool level) {
  r_req_ = level;
  if (level) {
    r_req_rose_ = at;
    r_sta_fell_.reset();
    if (r_sta_) recorder_.value(Check::kSyncWindow, r_sta_rose_, r_sta_rose_ - at, no_context);
    end_without_request(at);
  } else {
    recorder_.value(Check::kNeverReleased, r_req_rose_, at - r_req_rose_, no_context);
    if (r_sta_) {
      no_request_since_ = at;
    } else if (r_sta_fell_) {
      recorder_.value(Check::kNoRequest, *r_sta_fell_, at - *r_sta_fell_, no_context);
    }
  }
  ownership_may_have_changed(at);
}

void Ownership::r_sta(Tick at, bool level) {
  r_sta_ = level;
  if (level) {
    r_sta_rose_ = at;
    if (r_req_) recorder_.value(Check::kSyncWindow, at, at - r_req_rose_, no_context);
    if (!r_req_) no_request_since_ = at;
    if (l_sta_) {
      both_own_since_ = at;
    } else {
      recorder_.value(Check::kBothOwn, at, at - std::max(l_sta_fell_, r_req_rose_), no_context);
    }
  } else {
    if (r_req_) r_sta_fell_ = at;
    end_both_own(at);
    end_without_request(at);
  }
  ownership_may_have_changed(at);
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
  if (!both_own_since_) return;
  recorder_.value(Check::kBothOwn, *both_own_since_, *both_own_since_ - at, no_context);
  both_own_since_.reset();
}

void Ownership::end_without_request(Tick at) {
  if (!no_request_since_) return;
  recorder_.value(Check::kNoRequest, *no_request_since_, *no_request_since_ - at, no_context);
  no_request_since_.reset();
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
    recorder_.value(Check::kReleasedInAccess, at, at - *last_access_end_, no_context);
  }
}

void Ownership::access_began(Tick at) {
  accessing_ = true;
  began_not_owned_ = !owns();
  if (began_not_owned_) {
    not_owned_since_ = at;
  } else {
    recorder_.value(Check::kNotOwner, at, at - owned_since_, no_context);
  }
}

void Ownership::access_ended(Tick at) {
  accessing_ = false;
  last_access_end_ = at;
  end_without_ownership(at);
}

void Ownership::end_without_ownership(Tick at) {
  if (!not_owned_since_) return;
  recorder_.value(began_not_owned_ ? Check::kNotOwner : Check::kReleasedInAccess, *not_owned_since_,
                  *not_owned_since_ - at, no_context);
  not_owned_since_.reset();
}

void Ownership::finish(Tick at) {
  end_both_own(at);
  end_without_request(at);
  if (accessing_) end_without_ownership(at);
  if (r_req_) recorder_.value(Check::kNeverReleased, r_req_rose_, at - r_req_rose_, no_context);
}

}  // namespace checks
