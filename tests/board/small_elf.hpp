#pragma once
// The smallest ELF file that the board accepts, to be modified in tests.
#include <elf.h>

#include <cstdint>
#include <string>
#include <vector>

namespace dsdpv1::arm::test {

struct SmallElf {
  Elf32_Ehdr header;
  std::vector<Elf32_Phdr> segments;  ///< p_offset is set by bytes()
  std::vector<std::vector<std::uint8_t>> contents;
  std::vector<Elf32_Sym> symbols;  ///< st_name and st_size are taken as they are
  std::string names;               ///< of symbols, each ended with a 0

  /// Vector table and an endless loop at 0x08000000, followed by initialised data for RAM, one function and one object.
  SmallElf();
  Elf32_Phdr& add_segment(std::uint32_t address, std::vector<std::uint8_t> content);
  std::vector<std::uint8_t> bytes() const;
};

/// Little endian.
std::vector<std::uint8_t> words(const std::vector<std::uint32_t>& values);

}  // namespace dsdpv1::arm::test
