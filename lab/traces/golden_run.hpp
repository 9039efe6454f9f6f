#pragma once
// A run compared with its golden: a command's steps before, during and after it.
#include <memory>
#include <optional>
#include <string>

#include "lab/traces/golden.hpp"
#include "lab/traces/golden_check.hpp"
#include "tb/bench/bench.hpp"

namespace dsdpv1::tb::traces {

class GoldenRun {
 public:
  /// Reads the scenario's golden from `folder` and connects to the bench; with an empty folder nothing is compared.
  /// Throws InputError. It must outlive the bench.
  GoldenRun(const std::string& folder, const scenario::Scenario& scenario, bus::Segment& segment, RunOptions& options);

  /// Polled: whether a difference was found and the run need not continue.
  bool over(Tick now);
  /// Call after the run's end, or after the difference. Returns the result in words; empty when nothing was compared.
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
