#pragma once
// The XGate-DPS10 as a kind of chip (docs/xgate.md), made with the kit.
#include "tb/kit/slave_kit.hpp"

namespace dsdpv1::xgate {

const kit::Kind& kind();

}  // namespace dsdpv1::xgate
