#include "small_elf.hpp"

#include <cstring>

namespace dsdpv1::arm::test {
namespace {

template <typename T>
void append(std::vector<std::uint8_t>& to, const T& value) {
  const auto at = to.size();
  to.resize(at + sizeof value);
  std::memcpy(to.data() + at, &value, sizeof value);
}

Elf32_Shdr section(std::uint32_t type, std::size_t offset, std::size_t size) {
  Elf32_Shdr header{};
  header.sh_type = type;
  header.sh_offset = static_cast<std::uint32_t>(offset);
  header.sh_size = static_cast<std::uint32_t>(size);
  return header;
}

}  // namespace

std::vector<std::uint8_t> words(const std::vector<std::uint32_t>& values) {
  std::vector<std::uint8_t> bytes;
  for (const std::uint32_t value : values) append(bytes, value);
  return bytes;
}

SmallElf::SmallElf() : header{} {
  std::memcpy(header.e_ident, ELFMAG, SELFMAG);
  header.e_ident[EI_CLASS] = ELFCLASS32;
  header.e_ident[EI_DATA] = ELFDATA2LSB;
  header.e_ident[EI_VERSION] = EV_CURRENT;
  header.e_type = ET_EXEC;
  header.e_machine = EM_ARM;
  header.e_version = EV_CURRENT;
  header.e_entry = 0x0800'0009;
  header.e_ehsize = sizeof(Elf32_Ehdr);
  header.e_phentsize = sizeof(Elf32_Phdr);
  header.e_shentsize = sizeof(Elf32_Shdr);
  add_segment(0x0800'0000, words({0x2001'0000, 0x0800'0009, 0x0000'E7FE}));  // e7fe: b .
  add_segment(0x0800'000C, words({0x1234'5678})).p_vaddr = 0x2000'0000;
  names = std::string("\0start\0data\0", 12);
  symbols.resize(3);
  symbols[1] = {1, 0x0800'0009, 2, ELF32_ST_INFO(STB_GLOBAL, STT_FUNC), 0, 1};
  symbols[2] = {7, 0x2000'0000, 4, ELF32_ST_INFO(STB_LOCAL, STT_OBJECT), 0, 2};
}

Elf32_Phdr& SmallElf::add_segment(std::uint32_t address, std::vector<std::uint8_t> content) {
  Elf32_Phdr segment{};
  segment.p_type = PT_LOAD;
  segment.p_vaddr = segment.p_paddr = address;
  segment.p_filesz = segment.p_memsz = static_cast<std::uint32_t>(content.size());
  segments.push_back(segment);
  contents.push_back(std::move(content));
  return segments.back();
}

std::vector<std::uint8_t> SmallElf::bytes() const {
  Elf32_Ehdr head = header;
  head.e_phoff = sizeof head;
  head.e_phnum = static_cast<Elf32_Half>(segments.size());
  std::size_t content_at = sizeof head + segments.size() * sizeof(Elf32_Phdr);
  std::vector<std::uint8_t> table, content;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    Elf32_Phdr segment = segments[i];
    segment.p_offset = static_cast<std::uint32_t>(content_at + content.size());
    append(table, segment);
    content.insert(content.end(), contents[i].begin(), contents[i].end());
  }
  const std::size_t names_at = content_at + content.size(), symbols_at = names_at + names.size();
  const std::size_t symbols_size = symbols.size() * sizeof(Elf32_Sym);
  head.e_shoff = static_cast<std::uint32_t>(symbols_at + symbols_size);
  head.e_shnum = 3;
  std::vector<std::uint8_t> file;
  append(file, head);
  file.insert(file.end(), table.begin(), table.end());
  file.insert(file.end(), content.begin(), content.end());
  file.insert(file.end(), names.begin(), names.end());
  for (const Elf32_Sym& symbol : symbols) append(file, symbol);
  append(file, Elf32_Shdr{});
  append(file, section(SHT_STRTAB, names_at, names.size()));
  Elf32_Shdr symbol_table = section(SHT_SYMTAB, symbols_at, symbols_size);
  symbol_table.sh_link = 1;
  append(file, symbol_table);
  return file;
}

}  // namespace dsdpv1::arm::test
