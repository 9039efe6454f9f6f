// Clears outputs: on an empty Data_Exchange with Fail_Safe (table 21; ruling S19), on Clear_Data, on leaving DATA_EXCH
// (S18).
#include "model/profibus/user_side.hpp"

namespace dsdpv1::profibus {

// Without Fail_Safe such a request has the wrong length.
bool UserSide::fail_safe_clear(Cycle now, const Request& request, bool fail_safe) {
  if (request.size != 0 || !fail_safe) return false;
  log_.at_cycle(now, Reason::kFailSafeClear);
  clear_outputs(now);
  return true;
}

void UserSide::clear_outputs(Cycle now) {
  outputs_.clear();
  hand_outputs(now);
}

void UserSide::hand_outputs(Cycle now) {
  if (mail_.output.due.waiting()) ++outputs_replaced_;
  if (outputs_.size() > 0) mail_.output.due.set(now);
}

}  // namespace dsdpv1::profibus
