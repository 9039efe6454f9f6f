#pragma once
// The text for comparing step, skip, TLM and RTL: every change of every output pin.
#include <map>
#include <string>

#include "bus/time.hpp"
#include "io/output/output_file.hpp"
#include "tb/bench/observer.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

/// Lines "cycle slave pin level", in order of time and at equal times of the slaves' numbers, so that the order of
/// evaluation of chips does not matter; D with its ticks after the cycle: "cycle+ticks".
class PinTrace : public Observer {
 public:
  /// `scenario` must outlive it. Changes before `from` are skipped.
  PinTrace(const std::string& path, const scenario::Scenario& scenario, bus::Tick from)
      : file_(path), scenario_(scenario), from_(from) {}
  void pin(std::size_t slave, bus::Tick at, PinNumber pin, Level level) override;
  void save() { file_.flush(); }
  void mute() { file_.mute(); }
  bool failed() const { return file_.failed(); }
  void check() const { file_.check(); }
  void finish();

 private:
  void flush();

  OutputFile file_;
  const scenario::Scenario& scenario_;
  bus::Tick from_, at_ = 0;
  std::map<std::size_t, std::string> lines_;  ///< of `at_`, by the number of the slave
};

}  // namespace dsdpv1::tb
