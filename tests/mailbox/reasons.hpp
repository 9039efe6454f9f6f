#pragma once
// The reasons of the mailbox: those of its SPI port, and all reasons of the chip in its wording.
#include <string>
#include <vector>

#include "model/profibus/event.hpp"

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
/// The event in words, one line, without the time.
std::string describe(const profibus::Event& event);
/// The text of a reason with its placeholders, and the remedy.
std::string text_template(profibus::Reason reason);
std::string advice(profibus::Reason reason);

}  // namespace dsdpv1::mailbox
