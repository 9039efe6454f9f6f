// Loading of ELF files, and of files that must be rejected.
#include "board/firmware/elf_image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "io/input/input_error.hpp"
#include "small_elf.hpp"

namespace dsdpv1::arm::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// The loader's error in one line; empty if it accepts the file.
std::string answer(const std::vector<std::uint8_t>& file) {
  try {
    parse_elf(file, "fw.elf");
    return "";
  } catch (const tb::InputError& error) {
    return error.what();
  }
}

std::string answer(const std::function<void(SmallElf&)>& spoil) {
  SmallElf elf;
  spoil(elf);
  return answer(elf.bytes());
}

auto refuses(const std::string& what, const std::string& allowed) {
  return AllOf(StartsWith("fw.elf: "), HasSubstr(what), HasSubstr(allowed), testing::Not(HasSubstr("\n")));
}

TEST(ElfImage, SegmentsAreLoadedAtTheirPhysicalAddress) {
  const ElfImage image = parse_elf(SmallElf().bytes(), "fw.elf");
  ASSERT_EQ(image.segments.size(), 2U);
  EXPECT_EQ(image.segments[0].address, 0x0800'0000U);
  EXPECT_EQ(image.segments[0].bytes, words({0x2001'0000, 0x0800'0009, 0x0000'E7FE}));
  EXPECT_EQ(image.segments[1].address, 0x0800'000CU);
  EXPECT_EQ(image.segments[1].bytes, words({0x1234'5678}));
}

TEST(ElfImage, EntryAndVectorTableAreGiven) {
  const ElfImage image = parse_elf(SmallElf().bytes(), "fw.elf");
  EXPECT_EQ(image.entry, 0x0800'0009U);
  EXPECT_EQ(image.initial_sp, 0x2001'0000U);
  EXPECT_EQ(image.reset_handler, 0x0800'0009U);
}

TEST(ElfImage, SymbolsHaveAddressAndSize) {
  const ElfImage image = parse_elf(SmallElf().bytes(), "fw.elf");
  ASSERT_EQ(image.symbols.size(), 2U);
  EXPECT_EQ(image.symbols.at("start").address, 0x0800'0008U) << "without Thumb bit";
  EXPECT_TRUE(image.symbols.at("start").function);
  EXPECT_EQ(image.symbols.at("data").address, 0x2000'0000U);
  EXPECT_EQ(image.symbols.at("data").size, 4U);
  EXPECT_FALSE(image.symbols.at("data").function);
}

TEST(ElfImage, GlobalSymbolHidesLocalOnesOfItsName) {
  for (const bool global_first : {false, true}) {
    SmallElf elf;
    elf.symbols[2] = elf.symbols[1];
    Elf32_Sym& local = elf.symbols[global_first ? 2 : 1];
    local.st_info = ELF32_ST_INFO(STB_LOCAL, STT_FUNC);
    local.st_value = 0x0800'0003;
    EXPECT_EQ(parse_elf(elf.bytes(), "fw.elf").symbols.at("start").address, 0x0800'0008U);
  }
}

TEST(ElfImage, LinkedFirmwareIsTaken) {
  const ElfImage image = load_elf(FIRMWARE ".elf");
  EXPECT_EQ(image.segments.front().address, 0x0800'0000U);
  EXPECT_EQ(image.initial_sp, 0x2001'0000U);
  EXPECT_EQ(image.reset_handler, image.symbols.at("run").address | 1U);
  EXPECT_EQ(image.symbols.at("counter").address, 0x2000'0000U);
  EXPECT_EQ(image.symbols.count("$t"), 0U);
}

TEST(ElfImage, StrippedFirmwareHasNoSymbols) { EXPECT_TRUE(load_elf(FIRMWARE "-stripped.elf").symbols.empty()); }

TEST(ElfImage, SegmentWithoutBytesInTheFileIsNotLoaded) {
  SmallElf elf;
  Elf32_Phdr& bss = elf.add_segment(0x2000'1000, {});
  bss.p_memsz = 0x100;
  EXPECT_EQ(parse_elf(elf.bytes(), "fw.elf").segments.size(), 2U);
}

TEST(ElfImage, OtherFilesAreRefused) {
  EXPECT_THAT(answer(std::vector<std::uint8_t>{}),
              refuses("not an ELF file", "executable for ARM (32 bit, little endian)"));
  EXPECT_THAT(answer({'h', 'e', 'l', 'l', 'o'}), refuses("not an ELF file", "executable for ARM"));
  EXPECT_THAT(answer([](SmallElf& elf) { elf.header.e_ident[EI_CLASS] = 9; }), refuses("ELF class 9", "32 bit"));
  EXPECT_THAT(answer([](SmallElf& elf) { elf.header.e_ident[EI_DATA] = 9; }), refuses("data encoding 9", "little"));
}

TEST(ElfImage, WhereTheExampleComesFromIsSaid) {
  const auto answer_of = [](const std::string& path) -> std::string {
    try {
      read_elf_file(path);
      return "read";
    } catch (const tb::InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(answer_of("build/none/examples/firmware/device_O2.elf"),
            "build/none/examples/firmware/device_O2.elf: no such file, expected an executable for ARM (32 bit, "
            "little endian) such as "
            "arm-none-eabi-gcc links; `./run sim run SCENARIO` builds the example firmware, and so does the target "
            "dsdpv1_firmware");
  EXPECT_THAT(answer_of("none/my.elf"), testing::EndsWith("arm-none-eabi-gcc links"));
}

TEST(ElfImage, OtherMachinesAreRefusedByName) {
  EXPECT_THAT(answer([](SmallElf& elf) {
                elf.header.e_ident[EI_CLASS] = ELFCLASS64;
                elf.header.e_machine = EM_X86_64;
              }),
              refuses("64-bit program for x86-64", "32 bit"));
  EXPECT_THAT(answer([](SmallElf& elf) {
                elf.header.e_ident[EI_CLASS] = ELFCLASS64;
                elf.header.e_machine = EM_AARCH64;
              }),
              refuses("64-bit program for AArch64", "32 bit"));
  EXPECT_THAT(answer([](SmallElf& elf) { elf.header.e_machine = EM_RISCV; }), refuses("program for RISC-V", "for ARM"));
  EXPECT_THAT(answer([](SmallElf& elf) { elf.header.e_machine = 0x1234; }), refuses("machine number 4660", "for ARM"));
  EXPECT_THAT(answer([](SmallElf& elf) { elf.header.e_ident[EI_DATA] = ELFDATA2MSB; }),
              refuses("big endian", "little"));
}

TEST(ElfImage, WhatIsNotLinkedIsRefused) {
  EXPECT_THAT(answer([](SmallElf& elf) { elf.header.e_type = ET_REL; }), refuses("relocatable object", "executable"));
  EXPECT_THAT(answer([](SmallElf& elf) { elf.header.e_type = ET_DYN; }), refuses("shared library", "executable"));
  EXPECT_THAT(answer([](SmallElf& elf) { elf.segments.clear(), elf.contents.clear(); }),
              refuses("no load segments", "linked"));
}

TEST(ElfImage, SegmentsOutsideTheMemoriesAreRefused) {
  EXPECT_THAT(answer([](SmallElf& elf) { elf.add_segment(0x0000'0000, words({1})); }),
              refuses("runs at 0x00000000 with 4 bytes",
                      "flash (0x08000000 to 0x0807FFFF) and RAM (0x20000000 to 0x2000FFFF)"));
  EXPECT_THAT(answer([](SmallElf& elf) { elf.add_segment(0x0807'FFFD, words({1})); }), refuses("0x0807FFFD", "flash"));
  EXPECT_THAT(answer([](SmallElf& elf) { elf.segments[1].p_paddr = 0x0900'0000; }),
              refuses("is loaded at 0x09000000", "flash"));
  EXPECT_THAT(answer([](SmallElf& elf) { elf.add_segment(0x2000'FF00, {}).p_memsz = 0x101; }),
              refuses("0x2000FF00", "RAM"));
  EXPECT_THAT(answer([](SmallElf& elf) { elf.add_segment(0x0800'000F, words({1})); }),
              refuses("loaded over each other at 0x0800000F", "separate"));
  EXPECT_THAT(answer([](SmallElf& elf) { elf.segments[0].p_memsz = 4; }),
              refuses("12 bytes in the file and 4 in memory", "no more"));
}

TEST(ElfImage, LastByteOfAMemoryMayBeUsed) {
  EXPECT_EQ(answer([](SmallElf& elf) { elf.add_segment(0x0807'FFFC, words({1})); }), "");
  EXPECT_EQ(answer([](SmallElf& elf) { elf.add_segment(0x2000'FF00, {}).p_memsz = 0x100; }), "");
}

TEST(ElfImage, LimitsAreThoseOfTheBoard) {
  const FirmwareMemory small{{0x0800'0000, 12}, {0x2000'0000, 0x10000}};
  EXPECT_THROW(parse_elf(SmallElf().bytes(), "fw.elf", small), tb::InputError);
}

TEST(ElfImage, VectorTableIsChecked) {
  const auto with_vectors = [](std::uint32_t sp, std::uint32_t reset) {
    return answer([=](SmallElf& elf) { elf.contents[0] = words({sp, reset, 0x0000'E7FE}); });
  };
  EXPECT_THAT(answer([](SmallElf& elf) { elf.segments[0].p_vaddr = elf.segments[0].p_paddr = 0x0800'1000; }),
              refuses("loads nothing at 0x08000000", "vector table"));
  EXPECT_THAT(with_vectors(0x2001'0004, 0x0800'0009), refuses("stack pointer 0x20010004", "RAM (0x20000000"));
  EXPECT_THAT(with_vectors(0x2000'0000, 0x0800'0009), refuses("stack pointer 0x20000000", "RAM"));
  EXPECT_THAT(with_vectors(0x2000'1002, 0x0800'0009), refuses("stack pointer 0x20001002", "multiple of 4"));
  EXPECT_THAT(with_vectors(0x2001'0000, 0x2000'0009), refuses("reset vector at 0x20000009", "flash (0x08000000"));
  EXPECT_THAT(with_vectors(0x2001'0000, 0x0800'0008),
              refuses("reset vector at 0x08000008, without the Thumb bit", "odd"));
}

TEST(ElfImage, EntryIsChecked) {
  EXPECT_THAT(answer([](SmallElf& elf) { elf.header.e_entry = 0; }), refuses("entry at 0x00000000", "flash"));
  EXPECT_THAT(answer([](SmallElf& elf) { elf.header.e_entry = 0x0800'0008; }),
              refuses("entry at 0x08000008, without the Thumb bit", "odd"));
}

TEST(ElfImage, TablesThatCannotBeAreRefused) {
  EXPECT_THAT(answer([](SmallElf& elf) { elf.header.e_phentsize = 31; }),
              refuses("entries of 31 bytes in its program header", "32"));
  EXPECT_THAT(answer([](SmallElf& elf) { elf.header.e_shentsize = 39; }),
              refuses("entries of 39 bytes in its section header", "40"));
  EXPECT_THAT(answer([](SmallElf& elf) {
                for (std::uint32_t i = 0; i < 300; ++i) elf.add_segment(0x0800'1000 + i, {0});
              }),
              refuses("302 program headers", "256"));
}

TEST(ElfImage, FilesThatCannotBeReadAreRefused) {
  const auto message = [](const std::string& path) -> std::string {
    try {
      load_elf(path);
    } catch (const tb::InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message("there_is_none.elf"),
              AllOf(StartsWith("there_is_none.elf: no such file"), HasSubstr("expected")));
  EXPECT_THAT(message("."), AllOf(StartsWith(".: is a folder"), HasSubstr("expected")));
  EXPECT_THAT(message("/dev/zero"), StartsWith("/dev/zero: is larger than 64 MB"));
}

TEST(ElfImage, TruncationAtEveryLengthIsRefused) {
  const std::vector<std::uint8_t> whole = SmallElf().bytes();
  for (std::size_t length = SELFMAG; length < whole.size(); ++length) {
    const std::vector<std::uint8_t> part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_THAT(answer(part), refuses("is truncated", "the whole file"))
        << length << " of " << whole.size() << " bytes";
  }
}

TEST(ElfImage, AnyCorruptByteGivesOneLineOrAnImageInsideTheMemories) {
  const std::vector<std::uint8_t> whole = SmallElf().bytes();
  const FirmwareMemory memory;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (unsigned value = 0; value < 256; ++value) {
      std::vector<std::uint8_t> file = whole;
      file[at] = static_cast<std::uint8_t>(value);
      try {
        for (const Segment& segment : parse_elf(file, "fw.elf").segments)
          ASSERT_TRUE(memory.flash.holds(segment.address, segment.bytes.size()) ||
                      memory.ram.holds(segment.address, segment.bytes.size()));
      } catch (const tb::InputError& error) {
        ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      }
    }
  }
}

}  // namespace
}  // namespace dsdpv1::arm::test
