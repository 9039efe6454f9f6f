// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "model/profibus/state_frame.hpp"

#include <array>

namespace dsdpv1::profibus {
namespace {

constexpr std::size_t kSizeAt = 12, kChecksumAt = 16,
                      kChecked = 20;  // after magic and version; start of the checked bytes

// CRC-32 of IEEE 802.3.
constexpr std::array<std::uint32_t, 256> make_crc32_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? crc >> 1 ^ 0xEDB88320U : crc >> 1;
    table[byte] = crc;
  }
  return table;
}
constexpr std::array<std::uint32_t, 256> kCrc32Table = make_crc32_table();

std::uint32_t checksum(const std::uint8_t* bytes, std::size_t size) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (std::size_t i = 0; i < size; ++i) crc = crc >> 8 ^ kCrc32Table[(crc ^ bytes[i]) & 0xFF];
  return ~crc;
}

void put(std::uint32_t value, std::uint8_t* to) {
  for (int i = 0; i < 4; ++i) to[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

[[noreturn]] void fail(const std::string& text) { throw StateError(text); }

struct Head {
  std::uint64_t magic = 0;
  std::uint32_t version = 0, size = 0, checksum = 0;

  template <class Archive>
  void store(Archive& archive) {
    archive(magic, version, size, checksum);
  }
};

}  // namespace

void begin_frame(StateWriter& writer, const StateFrame& frame) {
  Head head{frame.magic, frame.version, 0, 0};
  writer(head);
}

std::vector<std::uint8_t> end_frame(std::vector<std::uint8_t> bytes) {
  put(static_cast<std::uint32_t>(bytes.size()), &bytes[kSizeAt]);
  put(checksum(&bytes[kChecked], bytes.size() - kChecked), &bytes[kChecksumAt]);
  return bytes;
}

StateReader open_frame(const std::uint8_t* bytes, std::size_t size, const StateFrame& frame) {
  StateReader reader(bytes, size);
  Head head;
  reader(head);
  if (head.magic != frame.magic || size < kChecked) fail("this is no saved state of a chip");
  if (head.version != frame.version)
    fail("the state has format version " + std::to_string(head.version) + ", allowed here is " +
         std::to_string(frame.version));
  if (head.size != size)
    fail("the state has " + std::to_string(size) + " bytes, it was saved with " + std::to_string(head.size));
  if (head.checksum != checksum(bytes + kChecked, size - kChecked)) fail("the state is damaged: its checksum is wrong");
  return reader;
}

void check_title(const std::string& saved, const std::string& own) {
  if (saved != own) fail("the state is of a " + saved + ", this chip is a " + own);
}

void check_parameter(StateReader& reader, const char* name, std::uint32_t own) {
  std::uint32_t saved = own;
  reader(saved);
  if (saved != own)
    fail("the state is of a chip whose " + std::string(name) + " is " + std::to_string(saved) + ", here it is " +
         std::to_string(own));
}

void check_frame(const StateReader& reader) {
  if (!reader.right())
    fail("byte " + std::to_string(reader.wrong_at()) + " of the state ends a value that no chip has");
  if (!reader.at_end()) fail("the state is longer than this chip's");
}

}  // namespace dsdpv1::profibus
