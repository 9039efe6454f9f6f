#include "board/firmware/source_lines.hpp"

#include <dwarf.h>
#include <elfutils/libdw.h>
#include <fmt/format.h>
#include <libelf.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <tuple>
#include <unordered_map>

namespace dsdpv1::arm {
namespace {

struct EndElf {
  void operator()(Elf* elf) const { ::elf_end(elf); }
};
struct EndDwarf {
  void operator()(Dwarf* dwarf) const { ::dwarf_end(dwarf); }
};

/// One row of a unit's line table; line 0 where a sequence of instructions ends.
struct Row {
  std::uint32_t address;
  const char* source;
  int line;
};

bool read_row(Dwarf_Line* from, Row& row) {
  Dwarf_Addr address = 0;
  bool end = false;
  if (::dwarf_lineaddr(from, &address) != 0 || ::dwarf_lineendsequence(from, &end) != 0) return false;
  if (::dwarf_lineno(from, &row.line) != 0) return false;
  if (end) row.line = 0;
  row.address = static_cast<std::uint32_t>(address);
  row.source = ::dwarf_linesrc(from, nullptr, nullptr);
  return row.source != nullptr;
}

template <typename Take>
void for_each_unit(Dwarf* dwarf, const Take& take) {
  Dwarf_CU* unit = nullptr;
  Dwarf_Die die;
  while (::dwarf_get_units(dwarf, unit, &unit, nullptr, nullptr, &die, nullptr) == 0) take(die);
}

/// Calls `take` for every row of every unit that can be read.
template <typename Take>
void for_each_row(Dwarf* dwarf, Take take) {
  for_each_unit(
      dwarf,
      [&take](Dwarf_Die& die) {
        Dwarf_Lines* lines = nullptr;
        std::size_t count = 0;
        if (::dwarf_getsrclines(&die, &lines, &count) != 0) return;
        for (std::size_t i = 0; i < count; ++i) {
          Row row{};
          if (read_row(::dwarf_onesrcline(lines, i), row)) take(row);
        }
      });
}

constexpr int kDeepest = 100;  // nested blocks and functions

/// Calls `take` for every function in `parent`, before those inlined in it. Damaged entries that lead back are
/// not followed.
template <typename Take>
void for_each_function(Dwarf_Die* parent, const Take& take, int depth = 0) {
  Dwarf_Die die;
  if (depth == kDeepest || ::dwarf_child(parent, &die) != 0) return;
  for (Dwarf_Off last = ::dwarf_dieoffset(parent); ::dwarf_dieoffset(&die) > last;) {
    last = ::dwarf_dieoffset(&die);
    const int tag = ::dwarf_tag(&die);
    const bool is_function = tag == DW_TAG_inlined_subroutine || tag == DW_TAG_subprogram;
    if (is_function) take(die);
    if (is_function || tag == DW_TAG_lexical_block || tag == DW_TAG_namespace) for_each_function(&die, take, depth + 1);
    if (::dwarf_siblingof(&die, &die) != 0) return;
  }
}

const char* name_of(Dwarf_Die* die) {
  Dwarf_Attribute attribute;
  return ::dwarf_formstring(::dwarf_attr_integrate(die, DW_AT_name, &attribute));
}

/// Calls `take(begin, end)` for every part of its code.
template <typename Take>
void for_each_part(Dwarf_Die* die, const Take& take) {
  Dwarf_Addr base = 0, begin = 0, end = 0;
  for (std::ptrdiff_t at = 0; (at = ::dwarf_ranges(die, at, &base, &begin, &end)) > 0;)
    take(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end));
}

std::string_view without_folders(std::string_view path) { return path.substr(path.find_last_of('/') + 1); }

}  // namespace

SourceLines::SourceLines(const ElfImage& image, std::vector<std::uint8_t> file) : file_(std::move(file)) {
  read_functions(image);
}

void SourceLines::read_functions(const ElfImage& image) {
  for (const auto& [name, symbol] : image.symbols)
    if (symbol.function) functions_.push_back({symbol.address, symbol.size, name});
  std::sort(functions_.begin(), functions_.end(),
            [](const Function& a, const Function& b) { return a.address < b.address; });
}

const SourceLines::Table& SourceLines::table() const {
  if (!table_) table_ = read_table(std::move(file_));
  return *table_;
}

SourceLines::Table SourceLines::read_table(std::vector<std::uint8_t> file) {
  Table table;
  ::elf_version(EV_CURRENT);
  const std::unique_ptr<Elf, EndElf> elf(::elf_memory(reinterpret_cast<char*>(file.data()), file.size()));
  const std::unique_ptr<Dwarf, EndDwarf> dwarf(::dwarf_begin_elf(elf.get(), DWARF_C_READ, nullptr));
  if (!dwarf) return table;
  std::unordered_map<std::string, std::uint32_t> numbers;
  for_each_row(
      dwarf.get(),
      [&](const Row& row) {
        const auto [number, is_new] = numbers.try_emplace(std::string(without_folders(row.source)),
                                                          static_cast<std::uint32_t>(table.files.size()));
        if (is_new) table.files.push_back(number->first);
        table.lines.push_back({row.address, number->second, row.line});
      });
  for_each_unit(dwarf.get(), [&table](Dwarf_Die& unit) {
    for_each_function(&unit, [&table](Dwarf_Die& die) {
      const char* const name = name_of(&die);
      if (name == nullptr) return;
      for_each_part(&die, [&](std::uint32_t begin, std::uint32_t end) { table.parts.push_back({begin, end, name}); });
    });
  });
  // Another sequence may begin where one ends: its line counts. The last of several rows for an address counts, as in
  // gdb.
  std::stable_sort(table.lines.begin(), table.lines.end(), [](const Line& a, const Line& b) {
    return std::make_tuple(a.address, a.line != 0) < std::make_tuple(b.address, b.line != 0);
  });
  return table;
}

namespace {

/// The last entry at or before `address`; null when all come after it.
template <typename Entry>
const Entry* last_until(const std::vector<Entry>& entries, std::uint32_t address) {
  const auto after = std::upper_bound(entries.begin(), entries.end(), address,
                                      [](std::uint32_t a, const Entry& entry) { return a < entry.address; });
  return after == entries.begin() ? nullptr : &*std::prev(after);
}

}  // namespace

const SourceLines::Function* SourceLines::function_at(std::uint32_t address) const {
  const Function* const found = last_until(functions_, address);
  const bool inside = found != nullptr && (found->size == 0 || address - found->address < found->size);
  return inside ? found : nullptr;
}

const SourceLines::Line* SourceLines::line_at(std::uint32_t address) const {
  const Line* const found = last_until(table().lines, address);
  return found != nullptr && found->line > 0 ? found : nullptr;
}

/// The last one: it is inside the others.
const SourceLines::Part* SourceLines::part_at(std::uint32_t address) const {
  const std::vector<Part>& all = table().parts;
  const auto found = std::find_if(all.rbegin(), all.rend(),
                                  [address](const Part& each) { return each.begin <= address && address < each.end; });
  return found == all.rend() ? nullptr : &*found;
}

SourceLine SourceLines::line_of(std::uint32_t address) const {
  SourceLine found;
  address &= ~1U;
  if (const Part* const part = part_at(address))
    found.function = part->name;
  else if (const Function* const function = function_at(address))
    found.function = function->name;
  if (const Line* const line = line_at(address)) {
    found.file = table().files[line->file];
    found.line = line->line;
  }
  return found;
}

std::string SourceLines::at(std::uint32_t address) const {
  address &= ~1U;
  const Function* const function = function_at(address);
  if (const Line* const line = line_at(address)) {
    const std::string place = fmt::format("{}:{}", table().files[line->file], line->line);
    return function != nullptr ? fmt::format("{} at {}", function->name, place) : place;
  }
  if (function == nullptr) return fmt::format("0x{:08X}", address);
  const std::uint32_t offset = address - function->address;
  return offset == 0 ? function->name : fmt::format("{}+0x{:X}", function->name, offset);
}

}  // namespace dsdpv1::arm
