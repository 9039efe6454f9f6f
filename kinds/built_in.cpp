// The kinds of chips that this program has.
#include "kinds/dsdpv1/kind.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

std::vector<const ChipKind*> built_in_chip_kinds() { return {&dsdpv1_kind(), &dsdpv1_r_kind(), &dsdpv1_rsu_kind()}; }

}  // namespace dsdpv1::tb
