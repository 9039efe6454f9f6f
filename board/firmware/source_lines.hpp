#pragma once
// Where in the source an instruction comes from: the line table of the firmware's DWARF and its symbols.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "board/firmware/elf_image.hpp"

namespace dsdpv1::arm {

/// Everything is read once, at construction; a look-up is two binary searches.
class SourceLines {
 public:
  /// `file` is the ELF file (read_elf_file()) that `image` comes from. Without debug information, or where it is
  /// damaged, there are symbols only.
  SourceLines(const ElfImage& image, std::vector<std::uint8_t> file);

  /// "main at main.c:42"; without a line "main+0x12"; without a symbol "0x08000124". Bit 0 (Thumb) of the address is
  /// ignored.
  std::string at(std::uint32_t address) const;

  /// Whether there is any line at all.
  bool has_lines() const { return !lines_.empty(); }

 private:
  struct Line {
    std::uint32_t address;
    std::uint32_t file;  ///< index into files_
    int line;            ///< 0: from here on there is no line
  };
  struct Function {
    std::uint32_t address, size;  ///< size 0: up to the next one
    std::string name;
  };

  void read_lines(std::vector<std::uint8_t> file);
  void read_functions(const ElfImage& image);
  const Function* function_at(std::uint32_t address) const;
  const Line* line_at(std::uint32_t address) const;

  std::vector<std::string> files_;   ///< without folders
  std::vector<Line> lines_;          ///< by address
  std::vector<Function> functions_;  ///< by address
};

}  // namespace dsdpv1::arm
