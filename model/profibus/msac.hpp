#pragma once
#include "model/profibus/alarms.hpp"
#include "model/profibus/msac1.hpp"
#include "model/profibus/msac2.hpp"

namespace dsdpv1::profibus {

/// DPV1, of a slave that has it (chapter 7).
struct Msac {
  Alarms alarms;  ///< also at SAP 51, of `c1`
  Msac1 c1;
  Msac2 c2;
};

}  // namespace dsdpv1::profibus
