#pragma once
// Which act of the user an event of the chip is about.
#include <optional>

#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

/// The access or edge that broke a rule of the host port, the write of the flag that handed over a block which the chip
/// refuses, or the last byte of a telegram that it refuses. Absent if the user has not caused the event.
std::optional<user_cpu::Act> user_act_of(const profibus::Event& event);

}  // namespace dsdpv1::tb
