#pragma once
// The reasons of the module itself; those of its slave and of alarms are profibus::reasons() and alarm_reasons().
#include "model/profibus/reason.hpp"

namespace dsdpv1::xgate {

namespace detail {
enum class ReasonIndex : std::size_t {
#define X(id, ...) id,
#include "model/xgate/reasons.inc"
#undef X
  kCount
};
extern const profibus::ReasonRow kReasonRows[static_cast<std::size_t>(ReasonIndex::kCount)];
}  // namespace detail

struct Reason {
#define X(id, ...) \
  static constexpr profibus::Reason id{detail::kReasonRows[static_cast<std::size_t>(detail::ReasonIndex::id)]};
#include "model/xgate/reasons.inc"
#undef X
};

profibus::ReasonTable reasons();

}  // namespace dsdpv1::xgate
