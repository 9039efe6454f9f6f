#pragma once
// The text that step, skip, TLM and RTL are compared by: every change of every output pin.
#include <string>

#include "bus/time.hpp"
#include "model/dsdpv1/chip.hpp"
#include "tb/report/output_file.hpp"

namespace tb {

/// Lines "cycle slave pin level", in order of time; D with its ticks behind the cycle: "cycle+ticks".
class PinTrace {
 public:
  explicit PinTrace(const std::string& path) : file_(path) {}
  void change(const std::string& slave, bus::Tick at, dsdpv1::Pin pin, dsdpv1::Level level);
  void finish() { file_.commit(); }

 private:
  OutputFile file_;
};

}  // namespace tb
