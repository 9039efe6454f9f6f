#include "model/systemc/host_transaction.hpp"

namespace dsdpv1::systemc {

const AccessTiming& timing_of(const tlm::tlm_generic_payload& payload, const AccessTiming& own) {
  const auto* extension = payload.get_extension<AccessTimingExtension>();
  return extension != nullptr ? extension->timing : own;
}

bool is_ahead(const tlm::tlm_generic_payload& payload) {
  const auto* extension = payload.get_extension<AccessTimingExtension>();
  return extension != nullptr && extension->ahead;
}

}  // namespace dsdpv1::systemc
