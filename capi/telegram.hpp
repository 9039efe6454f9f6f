#pragma once
// Converts telegrams between the header's and the bus's format.
#include "bus/telegram/telegram.hpp"
#include "dsdpv1/telegram.h"

namespace dsdpv1::capi {

/// Throws for fields out of range.
bus::Telegram telegram_of(const dpsim_telegram& telegram);

}  // namespace dsdpv1::capi
