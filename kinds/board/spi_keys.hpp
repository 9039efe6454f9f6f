#pragma once
// The keys of a native user CPU's SPI controller, for chips that have SPI.
#include <fmt/format.h>

#include <string>

#include "bus/time.hpp"
#include "io/input/input_error.hpp"
#include "io/keys/keys.hpp"
#include "model/dsdpv1/serial_host.hpp"

namespace dsdpv1::tb {

/// Times in ticks.
struct SpiTimes {
  int clock_khz = 9000;
  bus::Tick lead = 2400, lag = 2400, gap = 6000, byte_gap = 0, mosi_delay = 0;
  int line = 0;
};

/// `T` has an SpiTimes.
template <class T>
void add_spi_times(keys::ObjectOf<T>& o) {
  const keys::Range range = {0, bus::kTicksPerMs};
  o.integer("clock", &T::clock_khz, {10, 24000}, "kHz", "Frequency of SCK, with equal high and low times.");
  o.time("lead", &T::lead, range, "XSS falls before SCK's first rise.");
  o.time("lag", &T::lag, range, "XSS rises after SCK's last fall.");
  o.time("gap", &T::gap, range, "Least high time of XSS between two frames.");
  o.time("byte_gap", &T::byte_gap, range, "Additional low time of SCK between two bytes.");
  o.time("mosi_delay", &T::mosi_delay, range,
         "Time from SCK's fall (XSS's for the first bit) to the change of MOSI; at most half of SCK's period: it then "
         "changes with the rise.");
}

inline bus::Tick period_of(const SpiTimes& times) {
  return (1000 * bus::kTicksPerUs + times.clock_khz / 2) / times.clock_khz;
}

inline dsdpv1::SpiTiming spi_timing_of(const SpiTimes& times) {
  const bus::Tick period = period_of(times);
  return {(period + 1) / 2, period / 2, times.lead, times.lag, times.gap, times.byte_gap, times.mosi_delay};
}

/// Throws InputError.
inline void check_mosi(const SpiTimes& times, const std::string& file) {
  if (times.mosi_delay <= period_of(times) / 2) return;
  throw InputError(file, times.line,
                   fmt::format("mosi_delay is {} ticks, expected half of SCK's period, {} ticks, at most",
                               times.mosi_delay, period_of(times) / 2));
}

}  // namespace dsdpv1::tb
