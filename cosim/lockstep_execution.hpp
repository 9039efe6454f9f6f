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

/// Throws InputError for a kind without RtlOf.
void require_rtl(const tb::ChipKind& kind);

/// The RTL drives the pins. A core with the same inputs reports states and events, which pins do not show.
std::unique_ptr<tb::Execution> make_rtl_execution(MakeRtl make);

/// Model and RTL side by side for every chip of the scenario; ends with the first difference.
class LockstepExecution : public tb::Execution {
 public:
  LockstepExecution(MakeRtl make, const LockstepOptions& options) : make_(std::move(make)), options_(options) {}

  std::unique_ptr<tb::ChipView> make_chip(const tb::ChipKind& kind, const tb::ChipRequest& request) override;
  void run(tb::Tick end, const std::function<bool()>& stopped) override;

  bool broken_off() override { return different() != nullptr; }
  /// The chip with the first difference, null without one.
  Lockstep* different();
  const std::string& different_name();
  /// For all chips together; cycles of the one compared furthest.
  MatchCounts counts() const;
  /// Counts up to the first difference, and the difference.
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

/// The result of a lockstep run: the counts of matches, or the first difference, for which a wave is written to `wave`
/// (empty: none). Returns true without a difference.
bool report(LockstepExecution& execution, const std::string& wave, std::string& text);

}  // namespace dsdpv1::cosim
