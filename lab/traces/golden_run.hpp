#pragma once
// A run with its golden beside it: what a command has to do before, during and after it.
#include <memory>
#include <optional>
#include <string>

#include "lab/traces/golden.hpp"
#include "lab/traces/golden_check.hpp"
#include "tb/bench/bench.hpp"

namespace dsdpv1::tb::traces {

class GoldenRun {
 public:
  /// Reads the scenario's golden from `folder` and has the bench tell what it needs; with an empty folder there is
  /// nothing to be compared. Throws InputError. It must outlive the bench.
  GoldenRun(const std::string& folder, const scenario::Scenario& scenario, bus::Segment& segment, RunOptions& options);

  /// Asked from time to time: whether a difference was found and the run need not go on.
  bool over(Tick now);
  /// After a run that went on to its end, or to the difference: in words what was found; empty when nothing was
  /// compared.
  std::string report();
  /// No difference was found so far.
  bool same() const { return !check_ || !check_->difference(); }

 private:
  std::string name_;
  bool has_firmware_ = false;
  Golden golden_;
  std::optional<Tap> tap_;
  std::optional<GoldenCheck> check_;
};

}  // namespace dsdpv1::tb::traces
