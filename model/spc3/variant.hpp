#pragma once
// The three names of one core, a row for each: all differences that the core knows.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace dsdpv1::spc3 {

/// Microcyber APC3, Siemens SPC3, profichip VPC3+B/C/S in DP-V0.
enum class Variant : std::uint8_t { kApc3, kSpc3, kVpc3 };

struct VariantRow {
  const char* name;           ///< in scenarios and on command lines
  const char* title;          ///< for display
  int ram_size;               ///< bytes; an access from here on is a violation (A3)
  bool has_user_timer;        ///< event 4, mode register 0 bits 0, 1, 2 and 10
  bool has_more_modes;        ///< mode registers 2 and 3, 4 KB, mode registers readable
  bool exchanges_at_cfg_ok;   ///< A24; else with the first inputs
  bool start_clears_control;  ///< A7: 3CH
  bool reports_each_control;  ///< A47; else a changed one
};

/// In the order of Variant.
constexpr std::array<VariantRow, 3> kVariants = {{{"apc3", "APC3", 0x600, false, false, false, true, false},
                                                  {"spc3", "SPC3", 0x600, true, false, false, true, false},
                                                  {"vpc3", "VPC3+", 0x800, true, true, true, false, true}}};

constexpr const VariantRow& row(Variant variant) { return kVariants[static_cast<std::size_t>(variant)]; }
/// Number of addresses; others wrap.
constexpr int addresses(Variant variant) { return row(variant).has_more_modes ? 0x1000 : 0x800; }
/// Finds a variant by its name in scenarios; nullopt: unknown.
constexpr std::optional<Variant> variant_called(std::string_view name) {
  for (std::size_t i = 0; i < kVariants.size(); ++i)
    if (kVariants[i].name == name) return static_cast<Variant>(i);
  return std::nullopt;
}

}  // namespace dsdpv1::spc3
