// The kinds of chips in this program.
#include "kinds/dsdpv1/kind.hpp"
#include "kinds/spc3/kind.hpp"
#include "kinds/xgate/kind.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

std::vector<const ChipKind*> built_in_chip_kinds() {
  std::vector<const ChipKind*> kinds;
  for (std::size_t i = 0; i < kParts.size(); ++i) kinds.push_back(&kind_of(static_cast<Part>(i)));
  for (std::size_t i = 0; i < spc3::kVariants.size(); ++i) kinds.push_back(&kind_of(static_cast<spc3::Variant>(i)));
  kinds.push_back(&xgate::kind());
  return kinds;
}

}  // namespace dsdpv1::tb
