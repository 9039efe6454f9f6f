#pragma once
// For a capture that begins in the middle of a data exchange: the telegrams that first bring the model into one.
#include <vector>

#include "lab/replay/recording.hpp"
#include "tb/chip/user_cpu/station_config.hpp"

namespace dsdpv1::tb::replay {

/// The slave exchanges data before its first Set_Prm in the capture, or reports that it is parameterised.
bool begins_in_the_middle(const Recording& recording);

/// A configuration with as many bytes of outputs and inputs as the capture's exchanges have.
bus::Bytes cfg_of_exchange(const Recording& recording);

/// Set_Prm, Chk_Cfg and a data exchange, from the capture's master; empty if it begins with the slave's start. Values
/// that the capture does not show get defaults: min_TSDR 11, no groups, a watchdog of minutes if the slave shows WD_On.
std::vector<bus::Telegram> start_up_of(const Recording& recording, const user_cpu::StationConfig& station);

}  // namespace dsdpv1::tb::replay
