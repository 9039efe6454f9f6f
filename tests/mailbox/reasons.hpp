#pragma once
// The reasons of the mailbox's SPI port. No document has rulings for this chip.
#include "model/profibus/reason.hpp"

namespace dsdpv1::mailbox {

using profibus::Severity;

inline constexpr profibus::ReasonRow kReasonRows[] = {
    {Severity::kInfo, "STARTED", "", "started: address {a}, ident {b:4x}", "Nothing: the baud rate search begins."},
    {Severity::kRefusal, "START_REFUSED", "", "start refused: address {a} is above 125, or the flags {b:2x} are not 00",
     "Give a station address from 0 to 125, and 00 as the flags."},
    {Severity::kViolation, "SPI_FRAME_LENGTH", "", "frame dropped: {a} bits with the command {c:2x}, which has {b}",
     "Send one whole frame a select: 9 bytes for 01 and 02, 5 bytes for 03."},
    {Severity::kViolation, "SPI_COMMAND", "", "frame dropped: {a:2x} is no command ({b} bits)",
     "The commands are 01 (write inputs), 02 (read outputs) and 03 (start)."}};

/// `mailbox::Reason::kStarted`.
struct Reason {
  static constexpr profibus::Reason kStarted{kReasonRows[0]}, kStartRefused{kReasonRows[1]},
      kFrameLength{kReasonRows[2]}, kCommandUnknown{kReasonRows[3]};
};

}  // namespace dsdpv1::mailbox
