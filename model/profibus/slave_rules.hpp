#pragma once
// The rules of a DP slave in which chips differ. The defaults are those of a slave with DPV1.
#include <cstdint>

namespace dsdpv1::profibus {

struct SlaveRules {
  bool has_saps = true;                              ///< false: only the FDL status is answered
  bool dpv1_status = true;                           ///< byte 7 of Set_Prm is DPV1_Status_1, and checked as such
  std::uint8_t control_reserved = 0xC1;              ///< bits of a Global_Control that must be 0
  bool fresh_inputs = false, fresh_outputs = false;  ///< Read_Inputs, Read_Outputs: see DpSlave::answers_afresh
};

}  // namespace dsdpv1::profibus
