#include <fmt/format.h>

#include "kinds/spc3/port/bus_reader.hpp"

namespace dsdpv1::spc3_bus {

std::string words_of(const SpiFrame& frame) {
  if (frame.out.empty()) return "no byte";
  if (!frame.is_known()) return fmt::format("instruction {:02X}", frame.out[0]);
  const char* what = frame.is_read() ? "read" : "write";
  if (frame.out.size() < SpiFrame::kHead) return what;
  const std::string at = fmt::format("{} {:03X}", what, frame.address());
  return frame.is_array() ? fmt::format("{}, {} bytes", at, frame.data()) : at;
}

std::string wrong_with(const SpiFrame& frame) {
  if (frame.out.empty() && frame.bits == 0) return "";
  if (!frame.out.empty() && !frame.is_known()) return "no instruction";
  if (frame.data() == 0 || frame.bits != 0)
    return fmt::format("cut after {} bytes and {} bits", frame.out.size(), frame.bits);
  if (!frame.is_array() && frame.data() > 1) return fmt::format("{} bytes of data, one counts", frame.data());
  constexpr unsigned kMapEnd = 0x1000;
  if (frame.address() + frame.data() > kMapEnd) return "beyond the map";
  return "";
}

}  // namespace dsdpv1::spc3_bus
