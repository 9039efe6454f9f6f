// Data_Exchange (6.2.1, rulings D10, S12, S18 to S20): outputs in, inputs back.
#include "model/profibus/dp_slave.hpp"
#include "model/profibus/user_side.hpp"

namespace dsdpv1::profibus {

Reply DpSlave::data_exchange(Cycle now, const Request& request) {
  constexpr int kDefaultSap = 0;
  if (state_ != DpState::kDataExch) return refuse_state(now, request, kDefaultSap);
  if (held_by_other(request)) return refuse_master(now, request, kDefaultSap);
  const Exchanged exchanged = store_.exchange(now, request, prm_.fail_safe);
  if (!exchanged.taken) {
    log_.at_cycle(now, Reason::kOutputLength, static_cast<unsigned>(request.size),
                  static_cast<unsigned>(exchanged.expected));
    cfg_fault(now);
    return Reply::status(fc::kRr);  // S19
  }
  if (exchanged.leaves) leave_to_wait_prm(now);
  const View& inputs = exchanged.inputs;
  if (inputs.size == View::kNoBuffer) return Reply::status(fc::kRr);
  if (inputs.size > 0) return Reply::with_data(exchanged.high ? fc::kDh : fc::kDl, inputs.bytes, inputs.size);
  return exchanged.high ? Reply::status(fc::kDh) : Reply::sc();
}

// --- the user's side -------------------------------------------------------------------------------------------------

Exchanged UserSide::exchange(Cycle now, const Request& request, bool fail_safe) {
  if (request.size == outputs_.size()) {
    if (request.size > 0) outputs_.write(request.data);
    if (!outputs_.held()) hand_outputs(now);
  } else if (!fail_safe_clear(now, request, fail_safe)) {
    return {false, outputs_.size(), false, {}};
  }
  ++data_exchanges_;
  return {true, outputs_.size(), diagnosis_.high_priority(), read_inputs(now)};
}

bool UserSide::new_inputs(Cycle now, const std::uint8_t* bytes, int size) {
  if (size != inputs_.size()) {
    log_.at_cycle(now, Reason::kInputLength, static_cast<unsigned>(size), static_cast<unsigned>(inputs_.size()));
    return false;
  }
  inputs_.write(bytes);
  return true;
}

}  // namespace dsdpv1::profibus
