#pragma once
// Reads levels from tables exported by logic analysers and oscilloscopes: a time and levels or volts per line, or the
// levels of one sample per line (sigrok). A table of characters that an analyser has decoded is read as well.
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string_view>

#include "bus/capture/level_taker.hpp"
#include "bus/capture/logic_decoder.hpp"

namespace dsdpv1::bus::capture {

/// Whether a file with this beginning is such a table and not hexadecimal text.
bool begins_as_csv(std::string_view beginning);

/// Passes the chosen signals to `taker`, a line at a time; returns the samples per second if the table gives them.
/// Throws CaptureError, with the line of a wrong one.
std::optional<std::uint64_t> read_csv_levels(std::istream& in, LevelTaker& taker);
/// The telegrams of one signal, or of the characters of the table.
LogicSource read_csv(std::istream& in, const LogicSettings& settings, const TakeTelegram& take);

}  // namespace dsdpv1::bus::capture
