#pragma once
// Levels out of the tables that logic analysers export: a time and levels a line (Saleae Logic), or the levels of one
// sample a line (sigrok).
#include <iosfwd>
#include <string_view>

#include "bus/capture/logic_decoder.hpp"

namespace bus::capture {

/// Whether a file that begins so is such a table, and no hexadecimal text.
bool begins_as_csv(std::string_view beginning);

/// What was read, for the user.
struct LogicSource {
  std::string signal;
  int baud = 0;
};

/// Reads a line at a time. Throws CaptureError, "line N: ..." where a line is wrong.
LogicSource read_csv(std::istream& in, const LogicSettings& settings, const TakeTelegram& take);

}  // namespace bus::capture
