// From an address to function, file and line.
#include "board/firmware/source_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

namespace dsdpv1::arm {
namespace {

/// The line of the test's firmware with this mark.
int line_marked(const std::string& mark) {
  std::ifstream source(FIRMWARE_SOURCE);
  int number = 0;
  for (std::string line; std::getline(source, line);) {
    ++number;
    if (line.find("LINE " + mark + " ") != std::string::npos) return number;
  }
  return 0;
}

struct Firmware {
  explicit Firmware(const std::string& path) : image(load_elf(path)), lines(image, read_elf_file(path)) {}
  std::uint32_t address_of(const std::string& function) const { return image.symbols.at(function).address; }
  ElfImage image;
  SourceLines lines;
};

TEST(SourceLines, NameFunctionFileAndLine) {
  const Firmware firmware(FIRMWARE ".elf");
  EXPECT_TRUE(firmware.lines.has_lines());
  const std::uint32_t last_of_run = firmware.address_of("run") + firmware.image.symbols.at("run").size;
  EXPECT_EQ(firmware.lines.at(firmware.address_of("next_of")),
            "next_of at counter.c:" + std::to_string(line_marked("next_of")));
  std::string seen;
  for (std::uint32_t address = firmware.address_of("run"); address < last_of_run; address += 2)
    seen += firmware.lines.at(address) + "\n";
  EXPECT_THAT(seen, testing::HasSubstr("run at counter.c:" + std::to_string(line_marked("run"))));
}

TEST(SourceLines, InlinedFunctionHasItsOwnName) {
  const Firmware firmware(PROGRAMS "/foreign.elf");
  const Symbol& run = firmware.image.symbols.at("run");
  std::set<std::string> functions;
  for (std::uint32_t address = run.address; address < run.address + run.size; address += 2)
    functions.insert(firmware.lines.line_of(address).function);
  EXPECT_THAT(functions, testing::IsSupersetOf({"run", "start_72_mhz", "start_pins", "pause"}));
}

TEST(SourceLines, ThumbBitOfAnAddressIsIgnored) {
  const Firmware firmware(FIRMWARE ".elf");
  const std::uint32_t address = firmware.address_of("next_of");
  EXPECT_EQ(firmware.lines.at(address | 1U), firmware.lines.at(address));
}

TEST(SourceLines, AddressOutsideTheProgramIsANumber) {
  const Firmware firmware(FIRMWARE ".elf");
  EXPECT_EQ(firmware.lines.at(0x0807'0000), "0x08070000");
  EXPECT_EQ(firmware.lines.at(0), "0x00000000");
}

TEST(SourceLines, WithoutDebugInformationThereIsSymbolAndOffset) {
  const Firmware firmware(FIRMWARE "-no-debug.elf");
  EXPECT_FALSE(firmware.lines.has_lines());
  EXPECT_EQ(firmware.lines.at(firmware.address_of("run")), "run");
  EXPECT_EQ(firmware.lines.at(firmware.address_of("run") + 2), "run+0x2");
}

TEST(SourceLines, WithoutSymbolsThereIsTheAddress) {
  const Firmware firmware(FIRMWARE "-stripped.elf");
  EXPECT_EQ(firmware.lines.at(0x0800'0008), "0x08000008");
}

TEST(SourceLines, LinesWithoutSymbolsHaveNoFunction) {
  const ElfImage image = load_elf(FIRMWARE ".elf");
  const SourceLines lines(ElfImage{}, read_elf_file(FIRMWARE ".elf"));
  EXPECT_EQ(lines.at(image.symbols.at("next_of").address), "counter.c:" + std::to_string(line_marked("next_of")));
}

TEST(SourceLines, DamagedDebugInformationIsSurvived) {
  const std::vector<std::uint8_t> whole = read_elf_file(FIRMWARE ".elf");
  const ElfImage image = load_elf(FIRMWARE ".elf");
  const std::uint32_t address = image.symbols.at("run").address;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::vector<std::uint8_t> file = whole;
    file[at] ^= 0xFF;
    EXPECT_THAT(SourceLines(image, file).at(address), testing::StartsWith("run")) << "byte " << at;
  }
}

}  // namespace
}  // namespace dsdpv1::arm
