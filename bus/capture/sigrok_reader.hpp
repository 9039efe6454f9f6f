#pragma once
// Reads levels from sessions of sigrok (.sr): a ZIP archive of samples.
#include <string>
#include <string_view>

#include "bus/capture/csv_reader.hpp"
#include "bus/capture/logic_decoder.hpp"

namespace dsdpv1::bus::capture {

inline bool begins_as_zip(std::string_view beginning) {
  return beginning.substr(0, 4) == std::string_view("PK\x03\x04", 4);
}

/// Passes the requested channels to `taker`; returns the sample rate in Hz. `archive`: the whole file. Its samples are
/// unpacked piece by piece. Throws CaptureError.
std::uint64_t read_sigrok_levels(const std::string& archive, LevelTaker& taker);
/// The telegrams of one channel.
LogicSource read_sigrok(const std::string& archive, const LogicSettings& settings, const TakeTelegram& take);

}  // namespace dsdpv1::bus::capture
