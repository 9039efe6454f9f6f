// P9, P10: the effects of RESET.
#include "kinds/dsdpv1/claims/found.hpp"

namespace dsdpv1::calibrate {
namespace {

const Claim kRelease = {"P9",
                        "the start-up access begins 2 to 3 cycles after RESET rose",
                        {wire::kReset, wire::kLReq, wire::kRReq, wire::kRSta}};
const Claim kLevels = {"P10", "outputs have their levels of reset while RESET is low", {wire::kReset}};

struct ResetLevel {
  Wire wire;
  bool level;
};
constexpr std::array<ResetLevel, 8> kResetLevels = {{{wire::kPbtxd, true},
                                                     {wire::kPbrts, false},
                                                     {wire::kLReq, false},
                                                     {wire::kLSta, false},
                                                     {wire::kIntr0, true},
                                                     {wire::kPbf, true},
                                                     {wire::kBr, false},
                                                     {wire::kReady, false}}};

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
      found.judge.fails(kLevels, fall, name_of(each.wire) + (each.level ? " is low" : " is high"));
  }
}

}  // namespace

void measure_reset(const Scene& scene, Found& found) {
  const Trace& reset = scene.record[wire::kReset];
  if (!reset.seen) return;
  for (std::size_t edge = reset.next(0, true); edge < reset.edges.size(); edge += 2) {
    const Tick rise = reset.edges[edge];
    judge_levels(scene, edge > 0 ? reset.edges[edge - 1] : 0, rise, found);
    const std::size_t start = scene.record[wire::kLReq].next(rise - scene.time.margin(), true);
    if (start == Trace::kNone || !scene.sees_user() ||
        !scene.user_lets(rise - scene.time.margin() - scene.time.ticks(8),
                         rise + scene.time.ticks(1) + scene.time.margin()))
      continue;
    const Tick at = scene.record[wire::kLReq].edges[start];
    if (overlap(scene.time.between(rise, at), {2, 3}))
      found.judge.holds(kRelease);
    else
      found.judge.fails(kRelease, at, "it begins at another time");
  }
}

ClaimList reset_claims() { return {&kRelease, &kLevels}; }

}  // namespace dsdpv1::calibrate
