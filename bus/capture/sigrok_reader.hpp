#pragma once
// Levels out of sessions of sigrok (.sr): a ZIP archive of samples.
#include <string>
#include <string_view>

#include "bus/capture/csv_reader.hpp"
#include "bus/capture/logic_decoder.hpp"

namespace bus::capture {

inline bool begins_as_zip(std::string_view beginning) {
  return beginning.substr(0, 4) == std::string_view("PK\x03\x04", 4);
}

/// `archive`: all of the file. Its samples are unpacked piece by piece. Throws CaptureError.
LogicSource read_sigrok(const std::string& archive, const LogicSettings& settings, const TakeTelegram& take);

}  // namespace bus::capture
