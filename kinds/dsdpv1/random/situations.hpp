#pragma once
// The situations of a DSDPV1 in lockstep runs: those that the rulings define, and the mapping of events to them.
#include <string>
#include <vector>

#include "cosim/random/situations.hpp"
#include "model/dsdpv1/config.hpp"
#include "model/profibus/event.hpp"

namespace dsdpv1::cosim {

/// RandomCases::known_situations, for a part whose host is connected to this port.
std::vector<Situation> known_situations(Part part, HostMode mode);
/// RandomCases::rulings_of.
std::string rulings_of(const Situation& situation, HostMode mode);
/// The situation of an event, in addition to those of group "DP states": its code, and the case that the ruling
/// distinguishes. `state`: the DP state in which it happened.
std::string event_item(const profibus::Event& event, const std::string& state);
/// "WAIT_PRM".
const char* dp_state_name(unsigned state);

}  // namespace dsdpv1::cosim
