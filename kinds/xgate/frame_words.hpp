#pragma once
// Frames between host and module as text (4.5.1, tables 4.10 to 4.14).
#include <string>

#include "model/xgate/frame.hpp"

namespace dsdpv1::xgate {

/// "20 exchange, 3 bytes"; `asked`: the command that it answers, 0 if it is one itself.
std::string words_of(const Frame& frame, MailboxForm form, std::uint8_t asked);
/// "error 3/3: data exchange".
std::string error_words(unsigned type, unsigned code);

}  // namespace dsdpv1::xgate
