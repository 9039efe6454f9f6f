#include "bus/gsd/cfg.hpp"

#include <fmt/format.h>

namespace dsdpv1::bus {
namespace {

constexpr unsigned kWhole = 0x80;  // consistency: both formats
constexpr unsigned kWords = 0x40;

/// Table A.3: bits 3..0 count, 4 input, 5 output.
CfgIdentifier compact(std::size_t position, unsigned byte) {
  CfgIdentifier id;
  id.position = position;
  const CfgDirection data{static_cast<int>(byte & 0x0FU) + 1, (byte & kWords) != 0, (byte & kWhole) != 0};
  if ((byte & 0x10U) != 0) id.input = data;
  if ((byte & 0x20U) != 0) id.output = data;
  return id;
}

/// Table A.5.
CfgDirection length_byte(unsigned byte) {
  return {static_cast<int>(byte & 0x3FU) + 1, (byte & kWords) != 0, (byte & kWhole) != 0};
}

std::size_t vendor_bytes(unsigned head) {
  const unsigned length = head & 0x0FU;
  return length == 15 ? 0 : length;
}

/// Table A.4: an output length precedes an input length. `id.size` bytes are known to be present.
CfgIdentifier special(const Bytes& cfg, std::size_t position, std::size_t size) {
  CfgIdentifier id;
  id.position = position;
  id.size = size;
  id.special = true;
  const unsigned head = cfg[position];
  std::size_t next = position + 1;
  if ((head & 0x80U) != 0) id.output = length_byte(cfg[next++]);
  if ((head & 0x40U) != 0) id.input = length_byte(cfg[next++]);
  for (; next < position + size; ++next) id.vendor.push_back(cfg[next]);
  return id;
}

std::size_t special_size(unsigned head) {
  const std::size_t lengths = (head >> 7U & 1U) + (head >> 6U & 1U);
  return 1 + lengths + vendor_bytes(head);
}

std::string describe(const char* direction, const CfgDirection& data) {
  const char* unit = data.words ? "word" : "byte";
  return fmt::format("{} {} {}{}{}", direction, data.count, unit, data.count == 1 ? "" : "s",
                     data.whole && data.count > 1 ? ", consistent as a whole" : "");
}

}  // namespace

CfgLengths cfg_lengths(const Bytes& cfg) {
  CfgLengths result;
  for (std::size_t at = 0; at < cfg.size();) {
    const unsigned byte = cfg[at];
    const bool is_special = (byte & 0x30U) == 0;
    const std::size_t size = is_special ? special_size(byte) : 1;
    if (size > cfg.size() - at) {
      result.error =
          fmt::format("identifier 0x{:02X} wants {} more bytes, {} follow", byte, size - 1, cfg.size() - at - 1);
      return result;
    }
    result.identifiers.push_back(is_special ? special(cfg, at, size) : compact(at, byte));
    result.input += result.identifiers.back().input.bytes();
    result.output += result.identifiers.back().output.bytes();
    at += size;
  }
  return result;
}

std::string describe(const CfgIdentifier& identifier) {
  std::string text = identifier.empty() ? "empty slot" : "";
  if (identifier.input.count != 0) text = describe("input", identifier.input);
  if (identifier.output.count != 0) text += (text.empty() ? "" : "; ") + describe("output", identifier.output);
  if (!identifier.vendor.empty()) text += fmt::format("; {} vendor bytes", identifier.vendor.size());
  return text;
}

}  // namespace dsdpv1::bus
