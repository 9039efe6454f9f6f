#pragma once
// Which of the user's reads say something of the chip.
#include "kinds/dsdpv1/claims/scene.hpp"

namespace dsdpv1::calibrate {

/// Whether the rulings say what this read brings: the user has the DPRAM (P12), which a reset takes (P10, H6), and no
/// write of the same cell is on its way (P8). What is not in the capture is taken to be right.
bool is_known(const Scene& scene, const UserAccess& read);

/// Within it D stands by the rulings (P5), and as the samples show it; nothing where it is too short for them.
struct Standing {
  Tick from = 0, to = 0;
};
std::optional<Standing> standing_data(const Scene& scene, const UserAccess& read);

/// A strobe may lie between two samples, or an access of the chip: what a cell holds is not known.
bool may_miss_writes(const Scene& scene);

}  // namespace dsdpv1::calibrate
