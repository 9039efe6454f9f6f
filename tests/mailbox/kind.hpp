#pragma once
// The mailbox as a kind of chip: all that scenarios and the bench need to know of it.
#include "tb/bench/chip_maker.hpp"

namespace dsdpv1::mailbox {

const tb::ChipMaker& kind();

}  // namespace dsdpv1::mailbox
