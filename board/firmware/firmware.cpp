#include "board/firmware/firmware.hpp"

#include <fmt/format.h>

#include "board/firmware/mailbox.h"
#include "io/input/input_error.hpp"

namespace dsdpv1::arm {
namespace {

std::optional<std::uint32_t> find_mailbox(const ElfImage& image, const std::string& path) {
  const auto found = image.symbols.find(DSDPV1_MAILBOX_SYMBOL);
  if (found == image.symbols.end()) return std::nullopt;
  const Symbol& symbol = found->second;
  if (symbol.size != sizeof(dsdpv1_mailbox))
    throw tb::InputError(fmt::format("{}: {} has {} bytes, expected {}: those of version {} of mailbox.h", path,
                                     DSDPV1_MAILBOX_SYMBOL, symbol.size, sizeof(dsdpv1_mailbox),
                                     DSDPV1_MAILBOX_VERSION));
  if (!FirmwareMemory().ram.holds(symbol.address, symbol.size) || symbol.address % alignof(dsdpv1_mailbox) != 0)
    throw tb::InputError(fmt::format("{}: {} is at 0x{:08X}, expected the RAM from 0x{:08X}, a multiple of 8", path,
                                     DSDPV1_MAILBOX_SYMBOL, symbol.address, FirmwareMemory().ram.start));
  return symbol.address;
}

}  // namespace

std::shared_ptr<const Firmware> load_firmware(const std::string& path) {
  std::vector<std::uint8_t> file = read_elf_file(path);
  ElfImage image = parse_elf(file, path);
  const std::optional<std::uint32_t> mailbox = find_mailbox(image, path);
  SourceLines lines(image, std::move(file));
  return std::make_shared<const Firmware>(Firmware{path, std::move(image), std::move(lines), mailbox});
}

}  // namespace dsdpv1::arm
