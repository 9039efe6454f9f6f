#include "board/firmware/elf_image.hpp"

#include <elf.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string_view>

#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"

namespace dsdpv1 {

// The structures of elf.h are copied as they stand in the file: little endian on both sides.
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);

namespace arm {
namespace {

std::string allowed_file() { return std::string("expected ") + tb::kFirmwareFile.what; }

// Limits of time and memory that a file can cost; linked firmware has about three segments.
constexpr unsigned kMostProgramHeaders = 256;
constexpr std::size_t kLongestName = 4096;

const char* machine_name(unsigned machine) {
  switch (machine) {
    case EM_386: return "x86";
    case EM_X86_64: return "x86-64";
    case EM_RISCV: return "RISC-V";
    case EM_AARCH64: return "AArch64";
    case EM_MIPS: return "MIPS";
    case EM_PPC: return "PowerPC";
    case EM_PPC64: return "64-bit PowerPC";
    case EM_AVR: return "AVR";
    case EM_MSP430: return "MSP430";
    case EM_XTENSA: return "Xtensa";
    case EM_TRICORE: return "TriCore";
    default: return nullptr;
  }
}

const char* type_name(unsigned type) {
  switch (type) {
    case ET_REL: return "a relocatable object that was not linked";
    case ET_DYN: return "a shared library or position-independent";
    case ET_CORE: return "a core dump";
    default: return "no program";
  }
}

/// Reads one file. Every access is checked against its size: offsets and counts in it are not trusted.
class Reader {
 public:
  Reader(const std::vector<std::uint8_t>& file, const std::string& path, const FirmwareMemory& memory)
      : file_(file), path_(path), memory_(memory) {}

  ElfImage read() {
    check_kind();
    header_ = at<Elf32_Ehdr>(0, "ELF header");
    check_header();
    read_segments();
    read_vector_table();
    check_entry();
    read_symbols();
    return std::move(image_);
  }

 private:
  [[noreturn]] void refuse(const std::string& text) const { throw tb::InputError(path_, 0, text); }

  void check_range(std::uint64_t offset, std::uint64_t size, std::string_view what) const {
    if (size > file_.size() || offset > file_.size() - size)
      refuse(fmt::format("is truncated: {} at byte {} with {} bytes, the file has {}; expected the whole file", what,
                         offset, size, file_.size()));
  }

  template <typename T>
  T at(std::uint64_t offset, std::string_view what) const {
    check_range(offset, sizeof(T), what);
    T value{};
    std::memcpy(&value, file_.data() + offset, sizeof value);
    return value;
  }

  /// Number `index` of a table whose entries may be longer than T, as the header says.
  template <typename T>
  T entry(std::uint64_t table, std::uint64_t entry_size, std::uint64_t index, std::string_view what) const {
    if (entry_size < sizeof(T))
      refuse(fmt::format("has entries of {} bytes in its {}, expected {} or more", entry_size, what, sizeof(T)));
    return at<T>(table + index * entry_size, what);
  }

  void check_kind() const {
    if (file_.size() < SELFMAG || std::memcmp(file_.data(), ELFMAG, SELFMAG) != 0)
      refuse(fmt::format("is not an ELF file, {}", allowed_file()));
    check_range(0, EI_NIDENT, "ELF identification");
    if (file_[EI_CLASS] == ELFCLASS64)
      refuse(fmt::format("is a 64-bit program{}, {}", machine_of_64(), allowed_file()));
    if (file_[EI_CLASS] != ELFCLASS32) refuse(fmt::format("is of ELF class {}, {}", file_[EI_CLASS], allowed_file()));
    if (file_[EI_DATA] == ELFDATA2MSB) refuse(fmt::format("is big endian, {}", allowed_file()));
    if (file_[EI_DATA] != ELFDATA2LSB)
      refuse(fmt::format("has ELF data encoding {}, {}", file_[EI_DATA], allowed_file()));
  }

  /// The machine stands at the same place in files of 32 and 64 bit.
  std::string machine_of_64() const {
    constexpr std::size_t kMachineAt = offsetof(Elf32_Ehdr, e_machine);
    if (file_[EI_DATA] != ELFDATA2LSB || file_.size() < kMachineAt + 2) return "";
    const char* const name = machine_name(at<Elf32_Half>(kMachineAt, "machine"));
    return name != nullptr ? fmt::format(" for {}", name) : "";
  }

  void check_header() const {
    if (header_.e_machine != EM_ARM) {
      const char* const name = machine_name(header_.e_machine);
      refuse(fmt::format("is a program for {}, {}",
                         name != nullptr ? name : fmt::format("machine number {}", header_.e_machine), allowed_file()));
    }
    if (header_.e_type != ET_EXEC) refuse(fmt::format("is {}, {}", type_name(header_.e_type), allowed_file()));
  }

  void read_segments() {
    if (header_.e_phnum > kMostProgramHeaders)
      refuse(fmt::format("has {} program headers, expected at most {}", header_.e_phnum, kMostProgramHeaders));
    for (unsigned i = 0; i < header_.e_phnum; ++i) {
      const auto segment = entry<Elf32_Phdr>(header_.e_phoff, header_.e_phentsize, i, "program header table");
      if (segment.p_type == PT_LOAD && segment.p_memsz > 0) read_segment(segment);
    }
    if (image_.segments.empty()) refuse("has no load segments, expected a linked program with code and data");
  }

  void read_segment(const Elf32_Phdr& segment) {
    if (segment.p_filesz > segment.p_memsz)
      refuse(fmt::format(
          "has a segment at 0x{:08X} with {} bytes in the file and {} in memory, expected no more than in memory",
          segment.p_paddr, segment.p_filesz, segment.p_memsz));
    check_memory(segment.p_vaddr, segment.p_memsz, "runs");
    if (segment.p_filesz == 0) return;
    check_memory(segment.p_paddr, segment.p_filesz, "is loaded");
    check_range(segment.p_offset, segment.p_filesz, fmt::format("the segment for 0x{:08X}", segment.p_paddr));
    check_overlap(segment);
    const auto first = file_.begin() + static_cast<std::ptrdiff_t>(segment.p_offset);
    image_.segments.push_back({segment.p_paddr, {first, first + static_cast<std::ptrdiff_t>(segment.p_filesz)}});
  }

  void check_memory(std::uint32_t address, std::uint32_t size, std::string_view verb) const {
    if (!memory_.flash.holds(address, size) && !memory_.ram.holds(address, size))
      refuse(fmt::format("has a segment that {} at 0x{:08X} with {} bytes, expected {} and {}", verb, address, size,
                         flash_text(), ram_text()));
  }

  void check_overlap(const Elf32_Phdr& segment) const {
    for (const Segment& other : image_.segments) {
      if (segment.p_paddr < other.address + other.bytes.size() && other.address < segment.p_paddr + segment.p_filesz)
        refuse(fmt::format("has two segments that are loaded over each other at 0x{:08X}, expected separate ones",
                           std::max(segment.p_paddr, other.address)));
    }
  }

  static std::string text(std::string_view name, const MemoryRange& range) {
    return fmt::format("{} (0x{:08X} to 0x{:08X})", name, range.start, std::uint64_t{range.start} + range.size - 1);
  }
  std::string flash_text() const { return text("flash", memory_.flash); }
  std::string ram_text() const { return text("RAM", memory_.ram); }

  /// The word in memory after loading; nullopt where nothing is loaded.
  std::optional<std::uint32_t> loaded_word(std::uint32_t address) const {
    for (const Segment& segment : image_.segments) {
      const MemoryRange range{segment.address, static_cast<std::uint32_t>(segment.bytes.size())};
      if (!range.holds(address, 4)) continue;
      std::uint32_t word = 0;
      std::memcpy(&word, segment.bytes.data() + (address - segment.address), sizeof word);
      return word;
    }
    return std::nullopt;
  }

  void read_vector_table() {
    const std::uint32_t table = memory_.flash.start;
    const auto sp = loaded_word(table), reset = loaded_word(table + 4);
    if (!sp || !reset)
      refuse(fmt::format("loads nothing at 0x{:08X}, expected a program with its vector table there", table));
    image_.initial_sp = *sp;
    image_.reset_handler = *reset;
    const std::uint64_t ram_end = std::uint64_t{memory_.ram.start} + memory_.ram.size;
    if (*sp <= memory_.ram.start || *sp > ram_end || *sp % 4 != 0)
      refuse(fmt::format("begins with stack pointer 0x{:08X}, expected a multiple of 4 in {} or the end of it", *sp,
                         ram_text()));
    check_code_address(*reset, "reset vector");
  }

  void check_entry() {
    image_.entry = header_.e_entry;
    check_code_address(header_.e_entry, "entry");
  }

  void check_code_address(std::uint32_t address, std::string_view what) const {
    if (!memory_.flash.holds(address & ~1U, 2))
      refuse(fmt::format("has its {} at 0x{:08X}, expected {}", what, address, flash_text()));
    if ((address & 1U) == 0)
      refuse(fmt::format(
          "has its {} at 0x{:08X}, without the Thumb bit; expected odd addresses, a Cortex-M3 knows Thumb only", what,
          address));
  }

  void read_symbols() {
    for (unsigned i = 0; i < header_.e_shnum; ++i) {
      const auto section = section_header(i);
      if (section.sh_type == SHT_SYMTAB) return read_symbol_table(section);  // gABI: there is one at most
    }
  }

  Elf32_Shdr section_header(unsigned index) const {
    return entry<Elf32_Shdr>(header_.e_shoff, header_.e_shentsize, index, "section header table");
  }

  void read_symbol_table(const Elf32_Shdr& table) {
    if (table.sh_link >= header_.e_shnum)
      refuse(fmt::format("has a symbol table with names in section {}, expected sections below {}", table.sh_link,
                         header_.e_shnum));
    const auto names = section_header(table.sh_link);
    check_range(names.sh_offset, names.sh_size, "the names of symbols");
    check_range(table.sh_offset, table.sh_size, "the symbol table");
    const std::string_view text(reinterpret_cast<const char*>(file_.data()) + names.sh_offset, names.sh_size);
    for (std::uint32_t i = 0; i < table.sh_size / sizeof(Elf32_Sym); ++i)
      add_symbol(at<Elf32_Sym>(std::uint64_t{table.sh_offset} + i * sizeof(Elf32_Sym), "symbol"), text);
  }

  void add_symbol(const Elf32_Sym& symbol, std::string_view names) {
    const unsigned type = ELF32_ST_TYPE(symbol.st_info);
    const bool has_address = type == STT_NOTYPE || type == STT_OBJECT || type == STT_FUNC;
    if (!has_address || symbol.st_shndx == SHN_UNDEF || symbol.st_name >= names.size()) return;
    const std::string_view rest = names.substr(symbol.st_name, kLongestName);
    const std::string name(rest.substr(0, rest.find('\0')));
    if (name.empty() || name.front() == '$') return;  // $t, $d: ELF for ARM 5.5.5, marks between code and data
    const Symbol found{type == STT_FUNC ? symbol.st_value & ~1U : symbol.st_value, symbol.st_size, type == STT_FUNC};
    if (ELF32_ST_BIND(symbol.st_info) == STB_LOCAL)
      image_.symbols.emplace(name, found);
    else
      image_.symbols.insert_or_assign(name, found);
  }

  const std::vector<std::uint8_t>& file_;
  const std::string& path_;
  const FirmwareMemory& memory_;
  Elf32_Ehdr header_{};
  ElfImage image_{};
};

/// Scenarios name the example firmware, which need not be built.
std::string_view where_from(const std::string& path) {
  if (path.find("/examples/firmware/") == std::string::npos) return "";
  return "; `./run sim run SCENARIO` builds the example firmware, and so does the target dsdpv1_firmware";
}

}  // namespace

std::vector<std::uint8_t> read_elf_file(const std::string& path) {
  const tb::ReadFile file = tb::try_read_file(path, tb::kFirmwareFile.most_mb);
  if (!file.wrong.empty())
    throw tb::InputError(path, 0, fmt::format("{}, {}{}", file.wrong, allowed_file(), where_from(path)));
  const auto* const first = reinterpret_cast<const std::uint8_t*>(file.text.data());  // copied at once, not by bytes
  return {first, first + file.text.size()};
}

ElfImage load_elf(const std::string& path, const FirmwareMemory& memory) {
  return parse_elf(read_elf_file(path), path, memory);
}

ElfImage parse_elf(const std::vector<std::uint8_t>& file, const std::string& path, const FirmwareMemory& memory) {
  return Reader(file, path, memory).read();
}

}  // namespace arm
}  // namespace dsdpv1
