#pragma once
// --engine rtl and --engine lockstep: scenarios on RTL.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cosim/lockstep.hpp"
#include "tb/bench/execution.hpp"
#include "tb/bench/record.hpp"

namespace dsdpv1::cosim {

/// The RTL drives the pins. A core beside it, on the same inputs, tells states and events, which pins do not show.
std::unique_ptr<tb::Execution> make_rtl_execution(MakeRtl make);

/// Model and RTL side by side for every chip of the scenario; ends with the first difference.
class LockstepExecution : public tb::Execution {
 public:
  LockstepExecution(MakeRtl make, const LockstepOptions& options) : make_(std::move(make)), options_(options) {}

  std::unique_ptr<tb::ChipView> make_chip(const tb::ChipKind& kind, const tb::ChipRequest& request) override;
  void run(tb::Tick end, const std::function<bool()>& stopped) override;

  bool broken_off() override { return different() != nullptr; }
  /// The chip with the first difference, null when there was none.
  Lockstep* different();
  const std::string& different_name();
  /// Of all chips together; cycles of the one compared furthest.
  MatchCounts counts() const;
  /// Counts up to the first difference, and that.
  tb::LockstepResult result();

 private:
  struct Chip {
    std::string name;
    Lockstep* lockstep;  ///< owned by the ChipView
  };
  MakeRtl make_;
  LockstepOptions options_;
  std::vector<Chip> chips_;
};

/// What a lockstep run ends with: the counts of what matched, or the first difference, for which a wave is written to
/// `wave` (empty: none). True when there was no difference.
bool report(LockstepExecution& execution, const std::string& wave, std::string& text);

}  // namespace dsdpv1::cosim
