#pragma once
// The blocks that an FST file consists of: enough to tell a complete one from one that was cut.
#include <cstdint>
#include <string>

namespace dsdpv1::tb {

struct FstBlocks {
  unsigned changes = 0;
  bool header = false, geometry = false, names = false;
  std::uint64_t unpacked = 0;   ///< real size of a file that is compressed as a whole; 0: it is not
  bool damaged = false;         ///< the claimed size of names is larger than their block can unpack to
  bool whole = false;           ///< the last block ends where the file does
  std::uint64_t variables = 0;  ///< claimed by the header
  bool complete() const { return whole && (unpacked != 0 || (changes != 0 && geometry && names)); }
};

FstBlocks fst_blocks(const std::string& path);

}  // namespace dsdpv1::tb
