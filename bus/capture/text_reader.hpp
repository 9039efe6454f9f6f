#pragma once
// Telegrams of text: hexadecimal in any spacing, a log of dsdpv1-sim, a log of another program.
#include <iosfwd>
#include <optional>

#include "bus/capture/captured_telegram.hpp"

namespace dsdpv1::bus::capture {

/// Gives `take` each telegram with its line, and what is between them as telegrams without a start delimiter. A log's
/// telegram has the time when it had ended, and with `baud` its start. Text without times is laid out with `baud`, an
/// answer after min_TSDR (11 bit times), anything else after an idle time of 37 (T_ID1); without it telegrams have no
/// time. Throws CaptureError with the line, before anything is taken.
void read_text(std::istream& in, std::optional<int> baud, const TakeTelegram& take);

}  // namespace dsdpv1::bus::capture
