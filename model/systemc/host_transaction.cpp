#include "model/systemc/host_transaction.hpp"

namespace dsdpv1::systemc {

const AccessTiming& timing_of(const tlm::tlm_generic_payload& payload, const AccessTiming& own) {
  const auto* extension = payload.get_extension<AccessTimingExtension>();
  return extension != nullptr ? extension->timing : own;
}

AccessTimingExtension* ahead_of(const tlm::tlm_generic_payload& payload) {
  auto* extension = payload.get_extension<AccessTimingExtension>();
  if (extension == nullptr || !extension->ahead) return nullptr;
  extension->done = false;
  return extension;
}

}  // namespace dsdpv1::systemc
