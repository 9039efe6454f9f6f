#pragma once
// The mailbox as a kind of chip: everything that scenarios and the bench need.
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::mailbox {

const tb::ChipKind& kind();

}  // namespace dsdpv1::mailbox
