#pragma once
// The reasons of the DSDPV1: those of its host port and handshake, and all that the chip has, in its own words.
#include <string>
#include <vector>

#include "model/dpram/reasons.hpp"
#include "model/profibus/event.hpp"

namespace dsdpv1 {

namespace detail {
enum class ReasonIndex : std::size_t {
#define X(id, ...) id,
#include "model/dsdpv1/reasons.inc"
#undef X
  kCount
};
extern const profibus::ReasonRow kReasonRows[static_cast<std::size_t>(ReasonIndex::kCount)];
}  // namespace detail

/// What only the host port has to say: `dsdpv1::Reason::kWriteSetup`.
struct Reason {
#define X(id, ...) \
  static constexpr profibus::Reason id{detail::kReasonRows[static_cast<std::size_t>(detail::ReasonIndex::id)]};
#include "model/dsdpv1/reasons.inc"
#undef X
};

/// All reasons of the chip: host port, DPRAM, DP slave. In this order docs/reasons.md has them.
std::vector<profibus::Reason> reasons();
/// The event in words, one line, without the time.
std::string describe(const profibus::Event& event);
/// The text of a reason with its placeholders, and what to do about it: for documentation.
std::string text_template(profibus::Reason reason);
std::string advice(profibus::Reason reason);

}  // namespace dsdpv1
