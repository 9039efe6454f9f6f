#include "kinds/dsdpv1/checks/user_duties.hpp"

namespace dsdpv1::checks {

void UserDuties::reset() {
  holds_.reset();
  start_.reset();
  served_.reset();
  fresh_.reset();
  answers_.reset();
  refusals_.reset();
}

void UserDuties::hold_ended(Tick at, HoldOf what) {
  const UserHold& hold = holds_.ended(at, what);
  served_.hold(hold, holds_);
  fresh_.hold(hold);
  answers_.pass(at, refusals_.judges());
  answers_.hold(hold, holds_);
  start_.hold(hold, holds_.is_same_initialisation());
  if (hold.initialises()) holds_.initialised();
  refusals_.hold(hold, holds_);
  holds_.forget_reads();
}

void UserDuties::telegram(Tick now, const bus::WireTelegram& telegram) {
  served_.pass(now);
  answers_.pass(now, refusals_.judges());
  if (fresh_.telegram(telegram)) served_.request_came(telegram.end);
}

void UserDuties::finish(Tick end) {
  served_.pass(end);
  answers_.pass(end, refusals_.judges());
  fresh_.finish(end);
}

}  // namespace dsdpv1::checks
