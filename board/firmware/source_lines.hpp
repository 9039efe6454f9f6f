#pragma once
// Where in the source an instruction comes from: the line table of the firmware's DWARF and its symbols.
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "board/firmware/elf_image.hpp"

namespace dsdpv1::arm {

/// A line of the source.
struct SourceLine {
  std::string file;  ///< without folders; empty: there is none
  int line = 0;
  std::string function;  ///< empty: no symbol
};

/// Lines are read when the first one is asked for, most runs need none; a look-up is two binary searches. For one
/// thread.
class SourceLines {
 public:
  /// `file` is the ELF file (read_elf_file()) that `image` comes from. Without debug information, or where it is
  /// damaged, there are symbols only.
  SourceLines(const ElfImage& image, std::vector<std::uint8_t> file);

  /// "main at main.c:42"; without a line "main+0x12"; without a symbol "0x08000124". Bit 0 (Thumb) of the address is
  /// ignored.
  std::string at(std::uint32_t address) const;

  /// The same in parts. `function`: the innermost one, also one that is inlined.
  SourceLine line_of(std::uint32_t address) const;

  /// There is at least one line.
  bool has_lines() const { return !table().lines.empty(); }

 private:
  struct Line {
    std::uint32_t address;
    std::uint32_t file;  ///< index into Table::files
    int line;            ///< 0: no line from here on
  };
  struct Function {
    std::uint32_t address, size;  ///< size 0: up to the next one
    std::string name;
  };

  /// A part of a function by the debug information, also of one that is inlined. It has each static function, the map
  /// of symbols only one of a name.
  struct Part {
    std::uint32_t begin, end;
    std::string name;
  };

  struct Table {
    std::vector<std::string> files;  ///< without folders
    std::vector<Line> lines;         ///< by address
    std::vector<Part> parts;         ///< those inside others later
  };

  const Table& table() const;
  static Table read_table(std::vector<std::uint8_t> file);
  void read_functions(const ElfImage& image);
  const Function* function_at(std::uint32_t address) const;
  const Line* line_at(std::uint32_t address) const;
  const Part* part_at(std::uint32_t address) const;

  std::vector<Function> functions_;  ///< by address
  mutable std::vector<std::uint8_t> file_;
  mutable std::optional<Table> table_;
};

}  // namespace dsdpv1::arm
