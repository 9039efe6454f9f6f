#pragma once
// Times and bytes as people write them in scenarios and on command lines.
#include <cstdint>
#include <optional>
#include <string>

#include "bus/bytes.hpp"
#include "bus/time.hpp"

namespace dsdpv1::tb {

/// "-12", "0x1F": decimal, or hexadecimal with 0x, at most 15 digits; nullopt for anything else.
std::optional<std::int64_t> parse_integer(const std::string& text);

/// The forms of a time, for error messages.
extern const char* const kTimeForm;

/// "250ns", "1.5ms", "20us", "2s", "48cycles" (of 48 MHz) as ticks, rounded once to the nearest; nullopt for anything
/// else.
std::optional<bus::Tick> parse_time(const std::string& text);

/// The shortest way to write a time that `parse_time` reads back: "1.5ms".
std::string time_text(bus::Tick ticks);

/// Ticks of a cycle of 48 MHz.
constexpr bus::Tick kTicksPerCycle = 250;

/// A time as a cycle of 48 MHz: "cycle 84797 + 122 ticks (1766.604 us)".
std::string cycle_text(bus::Tick at);

/// "01 a0 FF*10": hexadecimal bytes, `*n` repeats one n times; nullopt for anything else. Blank text is no bytes.
std::optional<bus::Bytes> parse_bytes(const std::string& text);

/// "01 A0 FF"; longer than `most` bytes: the first ones, "..." and the length.
std::string bytes_text(const bus::Bytes& bytes, std::size_t most = 32);

}  // namespace dsdpv1::tb
