#pragma once
// The firmware: what of an ELF file (System V gABI chapters 4 and 5, ELF for the ARM Architecture) goes into the
// board's memories.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dsdpv1::arm {

struct MemoryRange {
  std::uint32_t start;
  std::uint32_t size;  ///< bytes

  /// It contains all of `count` bytes from `address` on.
  bool holds(std::uint64_t address, std::uint64_t count) const {
    return address >= start && count <= size && address - start <= size - count;
  }
};

/// The memories that firmware may be loaded into; the vector table stands at the start of flash. Default: STM32F103xE.
struct FirmwareMemory {
  MemoryRange flash{0x0800'0000, 512 * 1024};
  MemoryRange ram{0x2000'0000, 64 * 1024};
};

/// Bytes and where they are loaded to: the physical address (LMA), from which start-up code copies initialised data
/// into RAM.
struct Segment {
  std::uint32_t address;
  std::vector<std::uint8_t> bytes;  ///< never empty
};

struct Symbol {
  std::uint32_t address;  ///< of a function: without Thumb bit
  std::uint32_t size;     ///< bytes; 0: not stated, as for labels of an assembler
  bool function;
};

struct ElfImage {
  std::vector<Segment> segments;
  std::uint32_t entry;                    ///< with Thumb bit
  std::uint32_t initial_sp;               ///< first word of the vector table
  std::uint32_t reset_handler;            ///< second word of the vector table, with Thumb bit
  std::map<std::string, Symbol> symbols;  ///< functions, objects and labels; empty when the file was stripped. Global
                                          ///< ones before local ones of the same name
};

/// An executable for ARM, 32 bit, little endian, whose segments lie in the memories, with a vector table whose stack
/// pointer lies in RAM or at its end and whose reset handler lies in flash. Throws tb::InputError, `path: what is
/// wrong, what is allowed`, for every other file.
ElfImage load_elf(const std::string& path, const FirmwareMemory& memory = {});

/// The same from the bytes of a file; `path` is for messages only.
ElfImage parse_elf(const std::vector<std::uint8_t>& file, const std::string& path, const FirmwareMemory& memory = {});

/// The bytes of an ELF file; throws tb::InputError when it cannot be read or is larger than any firmware.
std::vector<std::uint8_t> read_elf_file(const std::string& path);

}  // namespace dsdpv1::arm
