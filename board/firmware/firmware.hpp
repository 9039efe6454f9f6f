#pragma once
// Firmware as the board needs it: what is loaded, where it comes from in the source, and whether a scenario can talk to
// it.
#include <memory>
#include <optional>
#include <string>

#include "board/firmware/elf_image.hpp"
#include "board/firmware/source_lines.hpp"

namespace dsdpv1::arm {

struct Firmware {
  std::string path;
  ElfImage image;
  SourceLines lines;
  std::optional<std::uint32_t> mailbox;  ///< address of the mailbox, see mailbox.h
};

/// Throws tb::InputError, one line, for a file that is not firmware of the board or whose mailbox has another version.
std::shared_ptr<const Firmware> load_firmware(const std::string& path);

}  // namespace dsdpv1::arm
