// DPV1 as permitted by a GSD file.
#include "bus/gsd/setup.hpp"

namespace dsdpv1::bus {

bool enables_dpv1(const Gsd& gsd, const Bytes& user_prm) {
  constexpr unsigned kEnable = 0x80;  // DPV1_Status_1.7
  return gsd.dpv1 && !user_prm.empty() && (user_prm.front() & kEnable) != 0;
}

std::string enable_dpv1(const Gsd& gsd, SlaveParameters& parameters) {
  if (!gsd.dpv1) return "the GSD file does not say DPV1_Slave = 1";
  if (!gsd.c1_read_write) return "the GSD file does not say C1_Read_Write_supp = 1";
  parameters.dpv1 = true;
  parameters.c1_response_timeout = gsd.c1_response_timeout.value_or(parameters.c1_response_timeout);
  return {};
}

}  // namespace dsdpv1::bus
