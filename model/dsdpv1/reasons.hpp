#pragma once
// The reasons of the DSDPV1: those of its host port and handshake, and the list of all, with the chip's words.
#include <vector>

#include "model/dpram/reasons.hpp"
#include "model/profibus/chip_reasons.hpp"

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

/// Reasons that only the host port has: `dsdpv1::Reason::kWriteSetup`.
struct Reason {
#define X(id, ...) \
  static constexpr profibus::Reason id{detail::kReasonRows[static_cast<std::size_t>(detail::ReasonIndex::id)]};
#include "model/dsdpv1/reasons.inc"
#undef X
};

/// All reasons of the chip, in the order of docs/reasons.md: host port, DPRAM, DP slave.
std::vector<profibus::Reason> reasons();
extern const profibus::Words kWords;
inline constexpr profibus::Describe<kWords> describe{};
inline constexpr profibus::TextTemplate<kWords> text_template{};
inline constexpr profibus::Advice<kWords> advice{};

}  // namespace dsdpv1
