#include "tb/dsdpv1/dsdpv1_view.hpp"

namespace tb {

ChipStatus Dsdpv1View::status() const {
  const dsdpv1::Status own = core().status();
  ChipStatus status;
  status.dp_state = own.dp_state;
  if (own.baud_index.known()) status.baud = own.baud_index.code();
  status.address = own.address;
  status.master = own.master;
  status.telegrams_received = own.telegrams_received;
  status.telegrams_answered = own.telegrams_answered;
  status.data_exchanges = own.data_exchanges;
  status.outputs_missed = own.outputs_missed;
  status.c2 = own.c2;
  status.accesses = own.accesses;
  status.longest_wait = static_cast<Tick>(own.longest_wait) * profibus::kTicksPerCycle;
  return status;
}

}  // namespace tb
