// P7, D7: INTR0 and READY.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "kinds/dsdpv1/claims/found.hpp"
#include "model/dsdpv1/chip.hpp"

namespace dsdpv1::calibrate {
namespace {

const Claim kPulses = {"P7", "every pulse of INTR0 is as long as the others", {wire::kIntr0}};
const Claim kInAccess = {
    "P7", "INTR0 falls while the chip has the DPRAM, or when the gap ends", {wire::kIntr0, wire::kLReq}};
const Claim kReady = {"D7", "READY rises while the chip reads the DPRAM", {wire::kReady, wire::kLReq}};

struct Pulse {
  Tick fall = 0, rise = 0;
};

std::vector<Pulse> pulses_of(const Scene& scene) {
  std::vector<Pulse> pulses;
  const Trace& trace = scene.record[wire::kIntr0];
  for (std::size_t edge = trace.next(0, false); edge + 1 < trace.edges.size(); edge += 2)
    if (!scene.in_reset(trace.edges[edge], trace.edges[edge + 1] + scene.time.margin()))  // not cut by a reset
      pulses.push_back({trace.edges[edge], trace.edges[edge + 1]});
  return pulses;
}

bool sees_accesses(const Scene& scene) { return scene.record.sees(wire::kLReq) && !scene.may_miss_accesses(); }

/// Whether the chip holds the DPRAM at `at`, or held it just before.
bool owned(const Scene& scene, Tick at) {
  const Trace& trace = scene.record[wire::kLReq];
  const Tick about = scene.time.ticks(1) + scene.time.margin();
  return !trace.low(at - about, at + about);
}

// --- how long a pulse is

bool may_be_cut(const Scene& scene, const Pulse& pulse) {
  return scene.may_hide_reset(pulse.rise - scene.time.margin(), pulse.rise + scene.time.margin());
}

Estimate length_of(const Scene& scene, const std::vector<Pulse>& pulses) {
  std::vector<Instance> instances;
  instances.reserve(pulses.size());
  for (const Pulse& pulse : pulses)
    instances.push_back(
        {pulse.fall, scene.time.between(pulse.fall, pulse.rise), scene.time.best(pulse.fall, pulse.rise)});
  return estimate(instances, &scene.time);
}

/// The pulses of full length: if no two agree the shortest may be cut; if some agree, a shorter one may be.
std::vector<Pulse> whole_pulses(const Scene& scene, std::vector<Pulse> pulses) {
  const auto length = [](const Pulse& pulse) { return pulse.rise - pulse.fall; };
  std::sort(pulses.begin(), pulses.end(), [&](const Pulse& a, const Pulse& b) { return length(a) < length(b); });
  while (pulses.size() > 1 && may_be_cut(scene, pulses.front())) {
    const Estimate all = length_of(scene, pulses);
    const bool alone = all.count - all.outliers.size() < 2,
               shorter = scene.time.between(pulses.front().fall, pulses.front().rise).hi < all.span.lo;
    if (!alone && !shorter) break;
    pulses.erase(pulses.begin());
  }
  return pulses;
}

void fit_low(const Scene& scene, const std::vector<Pulse>& pulses, Found& found) {
  const std::vector<Pulse> whole = whole_pulses(scene, pulses);
  Fit& fit = found.fit(parameter::kIntrLow);
  fit.estimate = length_of(scene, whole);
  if (pulses.empty()) fit.not_shown = "INTR0 has no pulse";
  if (whole.size() == 1 && may_be_cut(scene, whole.front()) && fit.estimate.span.hi < dsdpv1::Config{}.intr_low) {
    fit.estimate.span.hi = std::numeric_limits<double>::max();
    fit.at_least = true;
    return;
  }
  for (const Outlier& outlier : fit.estimate.outliers)
    found.judge.fails(kPulses, outlier.at, fmt::format("{:+.1f} cycles from the others", outlier.by));
  for (std::size_t i = fit.estimate.outliers.size(); i < fit.estimate.count; ++i) found.judge.holds(kPulses);
}

// --- when they come

/// A pulse that begins while the chip does not hold the DPRAM had to wait for the end of the gap; others only show that
/// the gap is not longer.
void fit_gap(const Scene& scene, const std::vector<Pulse>& pulses, Found& found) {
  std::vector<Instance> waited;
  double shortest = 1e12;
  for (std::size_t i = 1; i < pulses.size(); ++i) {
    const Tick from = pulses[i - 1].rise, to = pulses[i].fall;
    const Span gap = scene.time.between(from, to);
    if (scene.in_reset(from, to)) continue;
    shortest = std::min(shortest, gap.hi);
    if (sees_accesses(scene) && !owned(scene, to)) waited.push_back({to, gap, scene.time.best(from, to)});
  }
  Fit& fit = found.fit(parameter::kIntrGap);
  fit.estimate = estimate(waited, &scene.time);
  if (!waited.empty()) return;
  if (shortest >= 1e12) {
    fit.not_shown = "no two pulses of INTR0";
    return;
  }
  fit.estimate.count = 1;
  fit.estimate.span = {1, shortest};
  fit.at_most = true;
}

void judge_falls(const Scene& scene, const std::vector<Pulse>& pulses, Found& found) {
  const Fit& gap = found.fit(parameter::kIntrGap);
  for (std::size_t i = 0; i < pulses.size(); ++i) {
    const bool waited =
        i > 0 && !gap.at_most && overlap(scene.time.between(pulses[i - 1].rise, pulses[i].fall), gap.estimate.span);
    if (!waited)
      found.judge.judge(kInAccess, owned(scene, pulses[i].fall), pulses[i].fall,
                        "INTR0 falls without an access of the chip");
  }
}

void judge_ready(const Scene& scene, Found& found) {
  const Trace& ready = scene.record[wire::kReady];
  for (std::size_t edge = ready.next(0, true); edge < ready.edges.size(); edge += 2)
    found.judge.judge(kReady, owned(scene, ready.edges[edge]), ready.edges[edge],
                      "READY rises without an access of the chip");
}

}  // namespace

void measure_interrupt(const Scene& scene, Found& found) {
  const std::vector<Pulse> pulses = pulses_of(scene);
  fit_low(scene, pulses, found);
  fit_gap(scene, pulses, found);
  if (sees_accesses(scene)) judge_falls(scene, pulses, found), judge_ready(scene, found);
}

ClaimList interrupt_claims() { return {&kPulses, &kInAccess, &kReady}; }

}  // namespace dsdpv1::calibrate
