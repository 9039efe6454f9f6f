#pragma once
// The blocks that an FST file consists of: enough to tell a complete one from one that was cut.
#include <cstdint>
#include <string>

namespace dsdpv1::tb {

struct FstBlocks {
  unsigned changes = 0;
  bool header = false, geometry = false, names = false;
  std::uint64_t unpacked = 0;   ///< all of it is compressed once more: how large it is in truth; 0: it is not
  bool damaged = false;         ///< names are said to be larger than their block can be when it is unpacked
  bool whole = false;           ///< the last block ends where the file does
  std::uint64_t variables = 0;  ///< that the header speaks of
  bool complete() const { return whole && (unpacked != 0 || (changes != 0 && geometry && names)); }
};

FstBlocks fst_blocks(const std::string& path);

}  // namespace dsdpv1::tb
