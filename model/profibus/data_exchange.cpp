// Data_Exchange (6.2.1, rulings D10, S12, S18 to S20): outputs in, inputs back.
#include "model/profibus/dp_slave.hpp"

namespace dsdpv1::profibus {

Reply DpSlave::data_exchange(Cycle now, const Request& request) {
  constexpr int kDefaultSap = 0;
  if (state_ != DpState::kDataExch) return refuse_state(now, request, kDefaultSap);
  if (held_by_other(request)) return refuse_master(now, request, kDefaultSap);
  if (request.size == outputs_.size()) {
    if (request.size > 0) outputs_.write(request.data);
    if (!outputs_.held()) hand_outputs(now);
  } else if (!fail_safe_clear(now, request)) {
    log_.at_cycle(now, Reason::kOutputLength, static_cast<unsigned>(request.size),
                  static_cast<unsigned>(outputs_.size()));
    diagnosis_.cfg_fault();
    leave_to_wait_prm(now);
    return Reply::status(fc::kRr);  // S19
  }
  ++data_exchanges_;
  return input_reply();
}

Reply DpSlave::input_reply() const {
  const bool high = diagnosis_.high_priority();
  if (inputs_.size() > 0)
    return Reply::with_data(high ? fc::kDh : fc::kDl, inputs_.shown().bytes.data(), inputs_.size());
  return high ? Reply::status(fc::kDh) : Reply::sc();
}

bool DpSlave::new_inputs(Cycle now, const std::uint8_t* bytes, int size) {
  if (size != inputs_.size()) {
    log_.at_cycle(now, Reason::kInputLength, static_cast<unsigned>(size), static_cast<unsigned>(inputs_.size()));
    return false;
  }
  inputs_.write(bytes);
  return true;
}

}  // namespace dsdpv1::profibus
