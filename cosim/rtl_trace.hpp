#pragma once
// Internal signals of a user's RTL as a wave: recorded by Verilator's trace while the design runs.
#include <string>

#include "bus/time.hpp"

namespace dsdpv1::cosim {

struct RtlTrace {
  std::string file;  ///< FST; complete when the design is destroyed
  bus::Tick from = 0, to = bus::kNever;
};

/// The top scope in a trace's file.
constexpr const char* kTraceScope = "TOP";

}  // namespace dsdpv1::cosim
