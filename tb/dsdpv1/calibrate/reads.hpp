#pragma once
// Which of the user's reads say something of the chip.
#include "tb/dsdpv1/calibrate/scene.hpp"

namespace calibrate {

/// Whether the rulings say what this read brings: the user has the DPRAM (P12), which a reset takes (P10, H6), and no
/// write of the same cell is on its way (P8). What is not in the capture is taken to be right.
bool is_known(const Scene& scene, const UserAccess& read);

}  // namespace calibrate
