#include "board/gdb/gdb_description.hpp"

#include <fmt/format.h>

namespace dsdpv1::arm {
namespace {

std::string reg(const std::string& name, const char* type) {
  return fmt::format(R"(<reg name="{}" bitsize="32" type="{}"/>)", name, type);
}

std::string core_registers() {
  std::string text;
  for (int i = 0; i <= 12; ++i) text += reg(fmt::format("r{}", i), "int");
  return text + reg("sp", "data_ptr") + reg("lr", "int") + reg("pc", "code_ptr") + reg("xpsr", "int");
}

std::string system_registers() {
  std::string text = reg("msp", "data_ptr") + reg("psp", "data_ptr");
  for (const char* const name : {"primask", "basepri", "faultmask", "control"}) text += reg(name, "int");
  return text;
}

}  // namespace

std::string target_description() {
  return fmt::format(R"(<?xml version="1.0"?><!DOCTYPE target SYSTEM "gdb-target.dtd"><target version="1.0">)"
                     R"(<architecture>arm</architecture><feature name="org.gnu.gdb.arm.m-profile">{}</feature>)"
                     R"(<feature name="org.gnu.gdb.arm.m-system">{}</feature></target>)",
                     core_registers(), system_registers());
}

std::string memory_map_description(const std::vector<MemoryRegion>& regions) {
  std::string text = R"(<?xml version="1.0"?><memory-map>)";
  for (const MemoryRegion& region : regions) {
    const char* const type = region.page != 0 ? "flash" : region.writable ? "ram" : "rom";
    text += fmt::format(R"(<memory type="{}" start="0x{:x}" length="0x{:x}")", type, region.start, region.size);
    text +=
        region.page != 0 ? fmt::format(R"(><property name="blocksize">0x{:x}</property></memory>)", region.page) : "/>";
  }
  return text + "</memory-map>";
}

}  // namespace dsdpv1::arm
