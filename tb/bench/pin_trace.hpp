#pragma once
// The text that step, skip, TLM and RTL are compared by: every change of every output pin.
#include <map>
#include <string>

#include "bus/time.hpp"
#include "tb/output/output_file.hpp"
#include "tb/pins/pins.hpp"

namespace tb {

/// Lines "cycle slave pin level", in order of time and at equal times of the slaves' numbers, so that it does not
/// matter which chip was evaluated first; D with its ticks behind the cycle: "cycle+ticks".
class PinTrace {
 public:
  explicit PinTrace(const std::string& path) : file_(path) {}
  void change(std::size_t number, const std::string& slave, bus::Tick at, const PinInfo& pin, Level level);
  void save() { file_.flush(); }
  bool failed() const { return file_.failed(); }
  void check() const { file_.check(); }
  void finish();

 private:
  void flush();

  OutputFile file_;
  bus::Tick at_ = 0;
  std::map<std::size_t, std::string> lines_;  ///< of `at_`, by the number of the slave
};

}  // namespace tb
