#include "io/waves/fst_blocks.hpp"

#include <fstapi.h>

#include <fstream>

namespace dsdpv1::tb {
namespace {

constexpr std::streamoff kVariables = 40;  // offset of their count in the header's block, after its tag and length

std::uint64_t big_endian(std::istream& in) {
  std::uint64_t value = 0;
  for (int i = 0; i < 8; ++i) value = value << 8U | static_cast<std::uint64_t>(in.get() & 0xFF);
  return value;
}

/// LZ4 expands a byte to 255 bytes at most, and names may be compressed by it twice; zlib expands it to some 1032.
/// fstapi would allocate any claimed size and write all of it.
constexpr std::uint64_t kMostUnpackedOfByte = 255 * 255;

bool is_names(int tag) { return tag == FST_BL_HIER || tag == FST_BL_HIER_LZ4 || tag == FST_BL_HIER_LZ4DUO; }

void count(FstBlocks& blocks, int tag) {
  switch (tag) {
    case FST_BL_HDR: blocks.header = true; break;
    case FST_BL_VCDATA:
    case FST_BL_VCDATA_DYN_ALIAS:
    case FST_BL_VCDATA_DYN_ALIAS2: ++blocks.changes; break;
    case FST_BL_GEOM: blocks.geometry = true; break;
    default: blocks.names = blocks.names || is_names(tag); break;
  }
}

std::uint64_t variables(std::istream& in) {
  in.seekg(kVariables, std::ios::cur);
  return big_endian(in);
}

}  // namespace

/// Each block begins with a tag and a length that includes itself. The first unfinished block has the tag "skip".
FstBlocks fst_blocks(const std::string& path) {
  FstBlocks blocks;
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::uint64_t>(in.tellg());
  std::uint64_t at = 0;
  while (in && at < size) {
    in.seekg(static_cast<std::streamoff>(at));
    const int tag = in.get();
    const std::uint64_t length = big_endian(in);
    if (!in || tag == FST_BL_SKIP || length < 8 || length > size - at - 1) return blocks;
    count(blocks, tag);
    if (tag == FST_BL_HDR) blocks.variables = variables(in);
    if (tag == FST_BL_ZWRAPPER) blocks.unpacked = big_endian(in);
    if (is_names(tag) && big_endian(in) / kMostUnpackedOfByte > length) blocks.damaged = true;
    at += 1 + length;
  }
  blocks.whole = in && at == size;
  return blocks;
}

}  // namespace dsdpv1::tb
