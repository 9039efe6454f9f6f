#pragma once
// decode: the line out of a wave, VCD or FST of any simulator or analyser.
#include <string>
#include <string_view>

#include "bus/capture/csv_reader.hpp"

namespace dsdpv1::app {

bool begins_as_wave(std::string_view beginning);

/// Gives `taker` the signals that it wants, the wires of a vector as "A[3]"; with x and z a level stays. Returns the
/// wave's unit of time in ticks. `path` as below.
double read_wave_levels(const std::string& path, bus::capture::LevelTaker& taker);
/// The telegrams of one signal of a single bit. `path` is a file: a pipe has given its beginning away. Throws
/// tb::InputError, and CaptureError as other readers.
bus::capture::LogicSource read_wave_line(const std::string& path, const bus::capture::LogicSettings& settings,
                                         const bus::capture::TakeTelegram& take);

}  // namespace dsdpv1::app
