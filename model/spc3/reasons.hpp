#pragma once
// The reasons of the SPC3 family: those of its user side, and the list of all, with the chip's words.
#include <string>
#include <vector>

#include "model/profibus/event.hpp"

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
/// The event as text, one line, without the time.
std::string describe(const profibus::Event& event);
/// The text of a reason with its placeholders, and its advice: for documentation.
std::string text_template(profibus::Reason reason);
std::string advice(profibus::Reason reason);

}  // namespace dsdpv1::spc3
