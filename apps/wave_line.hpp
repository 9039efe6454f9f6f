#pragma once
// decode: the line out of a wave, VCD or FST of any simulator or analyser.
#include <string>
#include <string_view>

#include "bus/capture/csv_reader.hpp"

namespace app {

bool begins_as_wave(std::string_view beginning);

/// `path` is a file: a pipe has given its beginning away. Throws tb::InputError, and CaptureError as other readers.
bus::capture::LogicSource read_wave_line(const std::string& path, const bus::capture::LogicSettings& settings,
                                         const bus::capture::TakeTelegram& take);

}  // namespace app
