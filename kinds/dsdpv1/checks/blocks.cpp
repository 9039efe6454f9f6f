#include "kinds/dsdpv1/checks/blocks.hpp"

#include <fmt/format.h>

#include "kinds/dsdpv1/port/crc16.hpp"

namespace dsdpv1::checks {
namespace {

constexpr unsigned kAcyclicHeader = 4;

/// The number of bytes before the CRC: those up to `data`, and as many as the length byte at `length` counts.
std::optional<unsigned> counted(const Block& block, Address length, Address data, const Look& look) {
  const std::optional<std::uint8_t> count = look(length);
  if (!count || data + *count > block.crc) return std::nullopt;
  return static_cast<unsigned>(data - block.first) + *count;
}

/// V14: reads and transports carry data, other answers only the header.
std::optional<unsigned> covered_of_answer(const Block& block, const Look& look) {
  const std::optional<std::uint8_t> function = look(block.first);
  if (!function) return std::nullopt;
  const bool with_data = *function == regs::kFunctionNumRead || *function == regs::kFunctionNumTransport;
  return with_data ? counted(block, static_cast<Address>(block.first + 3), block.data, look)
                   : std::optional(kAcyclicHeader);
}

}  // namespace

std::string flag_name(Address cell, std::uint8_t flag) {
  unsigned bit = 0;
  while ((flag >> bit & 1U) == 0) ++bit;
  return fmt::format("B{:03X}.{}", cell, bit);
}

std::optional<unsigned> covered(const Block& block, const Look& look) {
  if (block.command == regs::kUserCommand2) return covered_of_answer(block, look);
  return counted(block, static_cast<Address>(block.data - 1), block.data, look);
}

std::optional<std::uint16_t> crc_over(Address first, unsigned count, const Look& look) {
  tb::Crc16 crc;
  for (unsigned i = 0; i < count; ++i) {
    const std::optional<std::uint8_t> byte = look(static_cast<Address>(first + i));
    if (!byte) return std::nullopt;
    crc.add(*byte);
  }
  return crc.value();
}

}  // namespace dsdpv1::checks
