#pragma once
// gdb's `load` into flash: the packets vFlashErase, vFlashWrite and vFlashDone. The processor's flash stays as it is: a
// run's program is that of its file, to which lines of source, mailbox and saved runs belong. What gdb has loaded is
// compared with it. What a real flash would not do is refused in words.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "board/cpu/debug_target.hpp"

namespace dsdpv1::arm {

class FlashLoader {
 public:
  /// `target` must outlive it.
  explicit FlashLoader(const DebugTarget& target) : target_(target) {}

  /// Why not, in one line; nullopt: done.
  using Refusal = std::optional<std::string>;
  /// Begins a new program after difference().
  Refusal erase(std::uint32_t address, std::uint32_t size);
  Refusal write(std::uint32_t address, std::string_view bytes);

  /// The program is complete. The first difference to that of the processor, in words.
  std::optional<std::string> difference();
  /// Whether the program is this one, from the start of flash on.
  bool holds(const std::vector<std::uint8_t>& flash) const;
  void forget() { pages_.clear(); }

 private:
  std::optional<MemoryRegion> flash_at(std::uint32_t address, std::uint64_t size) const;

  const DebugTarget& target_;
  std::map<std::uint32_t, std::vector<std::uint8_t>> pages_;  ///< by address: erased, with what has been written since
  bool complete_ = false;
};

}  // namespace dsdpv1::arm
