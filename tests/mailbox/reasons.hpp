#pragma once
// The reasons of the mailbox: those of its SPI port, and all reasons of the chip in its wording.
#include <vector>

#include "model/profibus/chip_reasons.hpp"

namespace dsdpv1::mailbox {

namespace detail {
enum class ReasonIndex : std::size_t {
#define X(id, ...) id,
#include "tests/mailbox/reasons.inc"
#undef X
  kCount
};
extern const profibus::ReasonRow kReasonRows[static_cast<std::size_t>(ReasonIndex::kCount)];
}  // namespace detail

/// The reasons of the SPI port: `mailbox::Reason::kStarted`.
struct Reason {
#define X(id, ...) \
  static constexpr profibus::Reason id{detail::kReasonRows[static_cast<std::size_t>(detail::ReasonIndex::id)]};
#include "tests/mailbox/reasons.inc"
#undef X
};

/// All reasons of the chip: SPI port, DP slave.
std::vector<profibus::Reason> reasons();
extern const profibus::Words kWords;
inline constexpr profibus::Describe<kWords> describe{};
inline constexpr profibus::TextTemplate<kWords> text_template{};
inline constexpr profibus::Advice<kWords> advice{};

}  // namespace dsdpv1::mailbox
