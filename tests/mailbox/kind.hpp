#pragma once
// The mailbox as a kind of chip: all that scenarios and the bench need to know of it.
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::mailbox {

const tb::ChipKind& kind();

}  // namespace dsdpv1::mailbox
