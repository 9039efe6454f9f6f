#pragma once
// The reasons of alarms: a separate table, since most chips have none.
#include "model/profibus/reason.hpp"

namespace dsdpv1::profibus {

namespace detail {
enum class AlarmReasonIndex : std::size_t {
#define X(id, ...) id,
#include "model/profibus/alarm_reasons.inc"
#undef X
  kCount
};
extern const ReasonRow kAlarmReasonRows[static_cast<std::size_t>(AlarmReasonIndex::kCount)];
}  // namespace detail

struct AlarmReason {
#define X(id, ...) \
  static constexpr Reason id{detail::kAlarmReasonRows[static_cast<std::size_t>(detail::AlarmReasonIndex::id)]};
#include "model/profibus/alarm_reasons.inc"
#undef X
};

/// Those of a chip with Capacities::alarms.
ReasonTable alarm_reasons();

}  // namespace dsdpv1::profibus
