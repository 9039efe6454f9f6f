#pragma once
// The blocks that an FST file consists of: enough to tell a complete one from one that was cut.
#include <cstdint>
#include <string>

namespace tb {

struct FstBlocks {
  unsigned changes = 0;
  bool header = false, geometry = false, names = false;
  bool packed = false;          ///< all of it is compressed once more
  bool whole = false;           ///< the last block ends where the file does
  std::uint64_t variables = 0;  ///< that the header speaks of
  bool complete() const { return whole && changes != 0 && geometry && names; }
};

FstBlocks fst_blocks(const std::string& path);

}  // namespace tb
