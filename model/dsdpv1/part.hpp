#pragma once
// The parts that can be modelled, a row for each.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace dsdpv1 {

/// DSDPV1-R is the DSDPV1 under another name; DSDPV1-RSU has SPI and UART beside the parallel port.
enum class Part : std::uint8_t { kDsdpv1, kR, kRsu };

/// Names of a part, and what it has beside table 1.
struct PartRow {
  const char* name;       ///< in scenarios and on command lines
  const char* title;      ///< for display
  bool has_serial_ports;  ///< SPI and UART, their pins and parameters (R1, R2)
  const char* rtl;        ///< top of its reference RTL, and name of the folders of that RTL, its lists and its stimuli
};

/// In the order of Part.
constexpr std::array<PartRow, 3> kParts = {{{"dsdpv1", "DSDPV1", false, "dsdpv1"},
                                            {"dsdpv1_r", "DSDPV1-R", false, "dsdpv1"},
                                            {"dsdpv1_rsu", "DSDPV1-RSU", true, "dsdpv1_rsu"}}};

constexpr const PartRow& row(Part part) { return kParts[static_cast<std::size_t>(part)]; }
constexpr unsigned serial_parts() {
  unsigned parts = 0;
  for (std::size_t i = 0; i < kParts.size(); ++i) parts |= kParts[i].has_serial_ports ? 1U << i : 0;
  return parts;
}
/// Called at each change of a serial pin, so it avoids the table.
constexpr bool has_serial_ports(Part part) {
  constexpr unsigned kSerialParts = serial_parts();
  return (kSerialParts >> static_cast<unsigned>(part) & 1U) != 0;
}
/// Finds a part by its name in scenarios; nullopt: unknown.
constexpr std::optional<Part> part_called(std::string_view name) {
  for (std::size_t i = 0; i < kParts.size(); ++i)
    if (kParts[i].name == name) return static_cast<Part>(i);
  return std::nullopt;
}

}  // namespace dsdpv1
