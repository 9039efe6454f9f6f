#pragma once
// Selects the user's reads that give information about the chip.
#include "kinds/dsdpv1/claims/scene.hpp"

namespace dsdpv1::calibrate {

/// Whether the rulings define the result of this read: the user holds the DPRAM (P12), which a reset ends (P10, H6),
/// and no write to the same cell is pending (P8). Signals missing in the capture are assumed to be right.
bool is_known(const Scene& scene, const UserAccess& read);

/// The time in which D is stable by the rulings (P5) and in the samples; absent if it is too short for them.
struct Standing {
  Tick from = 0, to = 0;
};
std::optional<Standing> standing_data(const Scene& scene, const UserAccess& read);

/// A strobe or an access of the chip may lie between two samples: the content of a cell is then unknown.
bool may_miss_writes(const Scene& scene);

}  // namespace dsdpv1::calibrate
