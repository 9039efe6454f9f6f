#pragma once
// The inside of a user's RTL as a wave: what Verilator's trace records while the design runs.
#include <string>

#include "bus/time.hpp"
#include "cosim/rtl_top.hpp"

namespace dsdpv1::cosim {

struct RtlTrace {
  std::string file;  ///< FST; it is there when the design is gone
  bus::Tick from = 0, to = bus::kNever;
};

/// The scope of a trace's file above all others.
constexpr const char* kTraceScope = "TOP";

/// RTL that wants to know when it is evaluated. A class of its own, as the reference RTL, which is built apart from
/// this program, does not.
class TimedTop : public RtlTop {
 public:
  /// The next evaluation is that of `at`, which never decreases. There is none before time 0.
  virtual void moment(bus::Tick at) = 0;
};

}  // namespace dsdpv1::cosim
