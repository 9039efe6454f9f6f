#include "board/gdb/flash_loader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dsdpv1::arm {
namespace {

constexpr std::uint8_t kErased = 0xFF;

}  // namespace

std::optional<MemoryRegion> FlashLoader::flash_at(std::uint32_t address, std::uint64_t size) const {
  for (const MemoryRegion& region : target_.memory_map())
    if (region.page != 0 && address >= region.start && address - region.start + size <= region.size) return region;
  return std::nullopt;
}

FlashLoader::Refusal FlashLoader::erase(std::uint32_t address, std::uint32_t size) {
  const auto flash = flash_at(address, size);
  if (!flash) return fmt::format("there is no flash of {} bytes at 0x{:08x} to erase", size, address);
  if ((address - flash->start) % flash->page != 0 || size % flash->page != 0)
    return fmt::format("{} bytes at 0x{:08x} cannot be erased, flash has pages of {} bytes", size, address,
                       flash->page);
  if (std::exchange(complete_, false)) pages_.clear();
  for (std::uint32_t page = 0; page < size; page += flash->page)
    pages_[address + page].assign(flash->page, std::uint8_t{kErased});
  return std::nullopt;
}

FlashLoader::Refusal FlashLoader::write(std::uint32_t address, std::string_view bytes) {
  const auto flash = flash_at(address, bytes.size());
  if (!flash) return fmt::format("there is no flash of {} bytes at 0x{:08x} to write", bytes.size(), address);
  for (const char byte : bytes) {
    const std::uint32_t place = (address - flash->start) % flash->page;
    const auto page = pages_.find(address - place);
    if (complete_ || page == pages_.end() || page->second[place] != kErased)
      return fmt::format("flash at 0x{:08x} must be erased before it is written", address);
    page->second[place] = static_cast<std::uint8_t>(byte);
    ++address;
  }
  return std::nullopt;
}

std::optional<std::string> FlashLoader::difference() {
  complete_ = true;
  for (const auto& [start, bytes] : pages_) {
    std::vector<std::uint8_t> there(bytes.size());
    target_.read_memory(start, there.data(), there.size());
    const auto [loaded, own] = std::mismatch(bytes.begin(), bytes.end(), there.begin());
    if (loaded == bytes.end()) continue;
    return fmt::format("gdb loads another program than that of the run: 0x{:02x} at 0x{:08x}, expected 0x{:02x}",
                       *loaded, start + (loaded - bytes.begin()), *own);
  }
  return std::nullopt;
}

bool FlashLoader::holds(const std::vector<std::uint8_t>& flash) const {
  return std::all_of(
      pages_.begin(), pages_.end(),
      [&](const auto& page) {
        const std::size_t at = page.first - flash_at(page.first, page.second.size())->start;
        return at + page.second.size() <= flash.size() &&
               std::equal(page.second.begin(), page.second.end(), flash.begin() + static_cast<std::ptrdiff_t>(at));
      });
}

}  // namespace dsdpv1::arm
