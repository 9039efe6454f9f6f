// Firmware for the ARM board: the ELF file, and its lines of source by libdw.
#include "board/firmware/elf_image.hpp"

#include "board/firmware/source_lines.hpp"
#include "io/input/input_error.hpp"
#include "tests/fuzz/input.hpp"

namespace dsdpv1 {
namespace {

void look_up(const arm::ElfImage& image, std::vector<std::uint8_t> file) {
  const arm::SourceLines lines(image, std::move(file));
  for (const arm::Segment& segment : image.segments)
    for (std::uint32_t at = 0; at < segment.bytes.size() && at < 64; at += 2)
      fuzz::promise(!lines.at(segment.address + at).empty(), "an address has words");
  lines.at(image.reset_handler);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<std::uint8_t> file(data, data + size);
  try {
    const arm::FirmwareMemory memory;
    const arm::ElfImage image = arm::parse_elf(file, "a.elf", memory);
    for (const arm::Segment& segment : image.segments)
      fuzz::promise(memory.flash.holds(segment.address, segment.bytes.size()) ||
                        memory.ram.holds(segment.address, segment.bytes.size()),
                    "a segment lies in a memory");
    look_up(image, file);
  } catch (const tb::InputError& error) {
    fuzz::promise_named(error.what(), "a.elf");
  }
  return 0;
}

}  // namespace dsdpv1
