#pragma once
#include <string>

#include "lab/traces/trace.hpp"

namespace dsdpv1::tb::traces {

/// Writes a trace as a wave (.vcd, .fst): a scope a slave with its pins, and the scope bus with the line. Throws
/// InputError.
void write_wave(const Trace& trace, const std::string& path);

}  // namespace dsdpv1::tb::traces
