#pragma once
// The reasons of the SPC3 family: those of its user side, and the list of all, with the chip's words.
#include <vector>

#include "model/profibus/chip_reasons.hpp"

namespace dsdpv1::spc3 {

namespace detail {
enum class ReasonIndex : std::size_t {
#define X(id, ...) id,
#include "model/spc3/reasons.inc"
#undef X
  kCount
};
extern const profibus::ReasonRow kReasonRows[static_cast<std::size_t>(ReasonIndex::kCount)];
}  // namespace detail

/// Reasons that only this family has: `spc3::Reason::kRamViolation`.
struct Reason {
#define X(id, ...) \
  static constexpr profibus::Reason id{detail::kReasonRows[static_cast<std::size_t>(detail::ReasonIndex::id)]};
#include "model/spc3/reasons.inc"
#undef X
};

/// All reasons of the chip: its user side, DP slave.
std::vector<profibus::Reason> reasons();
extern const profibus::Words kWords;
inline constexpr profibus::Describe<kWords> describe{};
inline constexpr profibus::TextTemplate<kWords> text_template{};
inline constexpr profibus::Advice<kWords> advice{};

}  // namespace dsdpv1::spc3
