#pragma once
// Levels out of the tables that logic analysers export: a time and levels a line (Saleae Logic), or the levels of one
// sample a line (sigrok).
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string_view>

#include "bus/capture/level_taker.hpp"
#include "bus/capture/logic_decoder.hpp"

namespace dsdpv1::bus::capture {

/// Whether a file that begins so is such a table, and no hexadecimal text.
bool begins_as_csv(std::string_view beginning);

/// Gives `taker` the signals that it wants, a line at a time: the samples a second, where the table says so.
/// Throws CaptureError, "line N: ..." where a line is wrong.
std::optional<std::uint64_t> read_csv_levels(std::istream& in, LevelTaker& taker);
/// The telegrams of one signal.
LogicSource read_csv(std::istream& in, const LogicSettings& settings, const TakeTelegram& take);

}  // namespace dsdpv1::bus::capture
