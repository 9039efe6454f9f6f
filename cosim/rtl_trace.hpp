#pragma once
// The inside of a user's RTL as a wave: what Verilator's trace records while the design runs.
#include <string>

#include "bus/time.hpp"

namespace dsdpv1::cosim {

struct RtlTrace {
  std::string file;  ///< FST; it is there when the design is gone
  bus::Tick from = 0, to = bus::kNever;
};

/// The scope of a trace's file above all others.
constexpr const char* kTraceScope = "TOP";

}  // namespace dsdpv1::cosim
