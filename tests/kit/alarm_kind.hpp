#pragma once
// A slave with process alarms made with the kit: its program raises them in each cycle or as the script orders.
#include "tb/kit/slave_kit.hpp"

namespace dsdpv1::kit {

/// `alarmer`; lives as long as the program.
const Kind& alarm_kind();

}  // namespace dsdpv1::kit
