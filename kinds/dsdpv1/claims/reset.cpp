// P9, P10: what RESET does.
#include "lab/calibrate/found.hpp"

namespace dsdpv1::calibrate {
namespace {

const Claim kRelease = {"P9",
                        "the start-up access begins 2 to 3 cycles after RESET rose",
                        {Wire::kReset, Wire::kLReq, Wire::kRReq, Wire::kRSta}};
const Claim kLevels = {"P10", "outputs have their levels of reset while RESET is low", {Wire::kReset}};

struct ResetLevel {
  Wire wire;
  bool level;
};
constexpr std::array<ResetLevel, 8> kResetLevels = {{{Wire::kPbtxd, true},
                                                     {Wire::kPbrts, false},
                                                     {Wire::kLReq, false},
                                                     {Wire::kLSta, false},
                                                     {Wire::kIntr0, true},
                                                     {Wire::kPbf, true},
                                                     {Wire::kBr, false},
                                                     {Wire::kReady, false}}};

void judge_levels(const Scene& scene, Tick fall, Tick rise, Found& found) {
  const Tick from = fall + scene.time.margin(), to = rise - scene.time.margin();
  if (from >= to) return;
  for (const ResetLevel& each : kResetLevels) {
    const Trace& trace = scene.record[each.wire];
    if (!trace.seen) continue;
    const bool right = each.level ? trace.high(from, to) : trace.low(from, to);
    if (right)
      found.judge.holds(kLevels);
    else
      found.judge.fails(kLevels, fall, name(each.wire) + (each.level ? " is low" : " is high"));
  }
}

}  // namespace

void measure_reset(const Scene& scene, Found& found) {
  const Trace& reset = scene.record[Wire::kReset];
  if (!reset.seen) return;
  for (std::size_t edge = reset.next(0, true); edge < reset.edges.size(); edge += 2) {
    const Tick rise = reset.edges[edge];
    judge_levels(scene, edge > 0 ? reset.edges[edge - 1] : 0, rise, found);
    const std::size_t start = scene.record[Wire::kLReq].next(rise - scene.time.margin(), true);
    if (start == Trace::kNone || !scene.sees_user() ||
        !scene.user_lets(rise - scene.time.margin() - scene.time.ticks(8),
                         rise + scene.time.ticks(1) + scene.time.margin()))
      continue;
    const Tick at = scene.record[Wire::kLReq].edges[start];
    if (overlap(scene.time.between(rise, at), {2, 3}))
      found.judge.holds(kRelease);
    else
      found.judge.fails(kRelease, at, "it begins at another time");
  }
}

Claims reset_claims() { return {&kRelease, &kLevels}; }

}  // namespace dsdpv1::calibrate
