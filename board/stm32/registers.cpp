#include "board/stm32/registers.hpp"

#include <algorithm>

namespace dsdpv1::arm {

const RegisterEntry* RegisterTable::find(std::uint32_t offset) const {
  const auto* const found = std::find_if(registers_.begin(), registers_.end(),
                                         [offset](const RegisterEntry& each) { return each.offset == offset; });
  return found != registers_.end() ? found : nullptr;
}

std::vector<const Tag*> RegisterTable::asked(std::uint32_t offset, std::uint32_t word) const {
  std::vector<const Tag*> found;
  for (const Tag& each : tags_)
    if (each.offset == offset && (each.with == 0 || (word & each.with) != 0) && each.value_in(word) != each.as)
      found.push_back(&each);
  return found;
}

}  // namespace dsdpv1::arm
