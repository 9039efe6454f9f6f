#pragma once
// The keywords outside blocks, their types and ranges (PROFIBUS GSD specification, revisions 1 to 5). Internal to the
// GSD reader.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dsdpv1::bus::gsd {

enum class Kind : std::uint8_t {
  kNumber,  ///< low..high
  kText,    ///< at most `high` characters
  kBytes,   ///< a list of 0..255
  kAny,     ///< kept as written
};

struct Keyword {
  std::string_view name;
  Kind kind;
  std::int64_t low, high;
};

/// The keyword with this name, ignoring case; nullptr without one.
const Keyword* find_keyword(std::string_view name);

/// The keyword meant by a misspelt name: known slips of real files, missing or extra underscores, blanks. nullptr if
/// none matches.
const Keyword* guess_keyword(std::string_view name);

/// Vendor and profile keywords (F_, X_, Unit_Diag...), kept without a remark.
bool is_kept_silently(std::string_view key);

}  // namespace dsdpv1::bus::gsd
