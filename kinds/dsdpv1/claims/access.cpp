// H1, H3, H6, H8: when the chip takes the DPRAM and for how long.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "kinds/dsdpv1/claims/found.hpp"

namespace dsdpv1::calibrate {
namespace {

const Claim kTogether = {"H1", "L_REQ and L_STA rise and fall together", {wire::kLReq, wire::kLSta}};
const Claim kHeldOff = {"H1", "the chip waits while R_REQ or R_STA is high", {wire::kLReq, wire::kRReq, wire::kRSta}};
const Claim kAtOnce = {"H1",
                       "an access that waited starts when both have fallen, 2 to 3 cycles later",
                       {wire::kLReq, wire::kRReq, wire::kRSta}};
const Claim kInterval = {"H1", "accesses start one interval after the other, never earlier", {wire::kLReq}};
const Claim kRace = {
    "H2", "the chip starts no access later than 2 cycles after R_REQ rose", {wire::kLReq, wire::kRReq}};
const Claim kEmpty = {"H3", "an access with nothing to do takes 7 cycles, none less", {wire::kLReq}};
const Claim kStartUp = {"H6", "the start-up access takes 2054 cycles", {wire::kLReq}};
const Claim kOverdue = {"H8",
                        "an overdue access starts one cycle after the end of the one before",
                        {wire::kLReq, wire::kRReq, wire::kRSta}};

std::string cycles_text(const Span& span) { return fmt::format("{:.1f} to {:.1f} cycles", span.lo, span.hi); }

// --- L_REQ against L_STA

/// Each edge of `one` must have a counterpart on `other`. `names`: text for a missing one.
void judge_edges(const Scene& scene, Found& found, Wire one, Wire other, const char* names) {
  const Trace &edges = scene.record[one], &others = scene.record[other];
  const Tick near = scene.time.margin();
  for (std::size_t edge = 0; edge < edges.edges.size(); ++edge) {
    const Tick at = edges.edges[edge];
    const bool level = edges.level(edge + 1);
    const std::size_t like = others.next(at - near, level);
    const bool with = like != Trace::kNone && others.edges[like] <= at + near;
    if (with || at + near > scene.record.end || at < near)
      found.judge.holds(kTogether);
    else
      found.judge.fails(kTogether, at, fmt::format(fmt::runtime(names), level ? "rises" : "falls"));
  }
}

void judge_together(const Scene& scene, Found& found) {
  if (!scene.record[wire::kLReq].seen || !scene.record[wire::kLSta].seen) return;
  judge_edges(scene, found, wire::kLReq, wire::kLSta, "L_REQ {}, L_STA does not");
  judge_edges(scene, found, wire::kLSta, wire::kLReq, "L_STA {}, L_REQ does not");
}

// --- the interval

/// Whether the access at `i` + 1 comes when due, not delayed by the user or an overdue access.
bool undisturbed(const Scene& scene, std::size_t i) {
  const ChipAccess &one = scene.accesses[i], &two = scene.accesses[i + 1];
  if (!one.whole || scene.is_start_up(one) || scene.in_reset(one.start, two.start)) return false;
  if (scene.time.between(one.end, two.start).lo <= 2) return false;  // perhaps overdue
  return scene.user_lets(one.start - 4 * bus::kTicksPerCycle - scene.time.margin(), two.start);
}

Instance interval_of(const Scene& scene, std::size_t i) {
  const Tick from = scene.accesses[i].start, to = scene.accesses[i + 1].start;
  return {to, scene.time.between(from, to), scene.time.best(from, to)};
}

/// A run of accesses, each one interval after the previous: `count` intervals from `from` to `to`.
struct Chain {
  Tick from = 0, to = 0;
  double count = 0;
};

std::vector<Chain> chains_of(const Scene& scene, const Span& interval) {
  std::vector<Chain> chains;
  bool open = false;
  for (std::size_t i = 0; i + 1 < scene.accesses.size(); ++i) {
    const bool goes_on = undisturbed(scene, i) && overlap(interval_of(scene, i).span, interval);
    if (!goes_on) {
      open = false;
      continue;
    }
    if (!open) chains.push_back({scene.accesses[i].start, 0, 0});
    open = true;
    chains.back().to = scene.accesses[i + 1].start;
    ++chains.back().count;
  }
  return chains;
}

void narrow_by_chains(const Scene& scene, Estimate& interval) {
  std::vector<Instance> instances;
  for (const Chain& chain : chains_of(scene, interval.span)) {
    const Span all = scene.time.between(chain.from, chain.to);
    instances.push_back(
        {chain.to, {all.lo / chain.count, all.hi / chain.count}, scene.time.best(chain.from, chain.to) / chain.count});
  }
  const Estimate narrow = estimate(instances);
  if (narrow.count != 0 && overlap(narrow.span, interval.span)) interval.span = common(narrow.span, interval.span);
}

/// The whole number of cycles between far edges gives the difference of the clocks: bounds from each chain and, since
/// sampling errors spread as the clocks drift, from the sum of all.
Estimate clock_of(const Scene& scene, const std::vector<Chain>& chains, double interval) {
  constexpr double kSigmas = 4;
  const double doubt = scene.time.doubt();
  std::vector<Instance> instances;
  double right_sum = 0, seen_sum = 0, squares = 0;
  for (const Chain& chain : chains) {
    const double right = chain.count * interval, seen = TimeBase::nominal(chain.to - chain.from);
    right_sum += right;
    seen_sum += seen;
    if (seen > 2 * doubt)
      instances.push_back({chain.to, {right / (seen + doubt), right / (seen - doubt)}, right / seen});
  }
  Estimate clock = estimate(instances);
  if (clock.count == 0) return clock;
  const double ratio = right_sum / seen_sum;
  for (const Chain& chain : chains) {
    const double off = TimeBase::nominal(chain.to - chain.from) - chain.count * interval / ratio;
    squares += off * off;
  }
  const double half = (kSigmas * std::sqrt(squares) + 2 * doubt) / seen_sum;
  const Span by_sum{ratio - half, ratio + half};
  if (overlap(by_sum, clock.span)) clock.span = common(by_sum, clock.span);
  return clock;
}

void narrow_clock(Scene& scene, double interval, Found& found) {
  Estimate clock = clock_of(scene, chains_of(scene, {interval, interval}), interval);
  if (clock.count == 0 || !overlap(clock.span, scene.time.scale)) return;
  clock.span = common(clock.span, scene.time.scale);
  scene.time.scale = clock.span;
  clock.count += found.clock.count;
  found.clock = std::move(clock);
}

void fit_interval(Scene& scene, Found& found) {
  std::vector<Instance> instances;
  for (std::size_t i = 0; i + 1 < scene.accesses.size(); ++i)
    if (undisturbed(scene, i)) instances.push_back(interval_of(scene, i));
  Fit& fit = found.fit(parameter::kAccessInterval);
  fit.estimate = estimate(instances);
  if (fit.estimate.count == 0) {
    fit.not_shown = "no two accesses without the user between them";
    return;
  }
  if (!scene.sees_user()) return;
  narrow_by_chains(scene, fit.estimate);
  if (const auto whole = fit.estimate.whole()) narrow_clock(scene, static_cast<double>(*whole), found);
}

/// An early access violates the ruling; a late one does too if the user's pins show no request.
void judge_interval(const Scene& scene, Found& found) {
  Estimate& interval = found.fit(parameter::kAccessInterval).estimate;
  if (interval.count == 0) return;
  std::vector<Outlier> real;
  for (const Outlier& outlier : interval.outliers) {
    if (outlier.by > 0 && !scene.sees_user()) continue;
    real.push_back(outlier);
    found.judge.fails(kInterval, outlier.at, fmt::format("{:+.1f} cycles from the others", outlier.by));
  }
  interval.outliers = real;
  for (std::size_t i = real.size(); i < interval.count; ++i) found.judge.holds(kInterval);
}

// --- the user's pins

/// When both had last fallen before `at`; absent if one is high or there was no request.
std::optional<Tick> released_before(const Scene& scene, Tick at) {
  Tick released = -1;
  for (const Wire wire : {wire::kRReq, wire::kRSta}) {
    const Trace& trace = scene.record[wire];
    if (trace.at(at)) return std::nullopt;
    const std::size_t edge = trace.last(at, false);
    if (edge != Trace::kNone) released = std::max(released, trace.edges[edge]);
  }
  return released < 0 ? std::nullopt : std::optional<Tick>(released);
}

/// How long one of the user's pins had been high when the chip looked, 2 cycles before `at`; 0 if none was.
bool held_when_looked(const Scene& scene, Tick at) {
  const Tick doubt = scene.time.ticks(scene.time.doubt() + 0.5), looked = at - scene.time.ticks(2);
  return scene.record[wire::kRReq].high(looked - doubt - bus::kTicksPerCycle, looked + doubt) ||
         scene.record[wire::kRSta].high(looked - doubt - bus::kTicksPerCycle, looked + doubt);
}

/// If samples are so far apart that a release between two holds may be missed, a violation cannot be decided.
void judge_fine(const Scene& scene, const Claim& claim, bool right, Tick at, const std::string& how, Found& found) {
  constexpr double kShortRelease = 3;  // cycles
  if (right)
    found.judge.holds(claim);
  else if (scene.time.doubt() >= kShortRelease)
    found.judge.coarse(claim);
  else
    found.judge.fails(claim, at, how);
}

void judge_start(const Scene& scene, std::size_t i, const Fit& interval, Found& found) {
  const Tick at = scene.accesses[i].start;
  judge_fine(scene, kHeldOff, !held_when_looked(scene, at), at, "an access starts while the user holds the DPRAM",
             found);
  const Trace& request = scene.record[wire::kRReq];
  if (const std::size_t rose = request.last(at, true); request.at(at) && rose != Trace::kNone) {
    const Span after = scene.time.between(request.edges[rose], at);
    judge_fine(scene, kRace, after.lo <= 2, at, "an access starts long after R_REQ rose", found);
  }
  const std::optional<Tick> released = released_before(scene, at);
  if (!released || i == 0 || interval.estimate.count == 0 || scene.is_start_up(scene.accesses[i])) return;
  const ChipAccess& before = scene.accesses[i - 1];
  const double due = TimeBase::nominal(*released - before.start) - interval.estimate.span.hi - scene.time.doubt();
  if (due <= 0 || *released <= before.end) return;
  const Span after = scene.time.between(*released, at);
  judge_fine(scene, kAtOnce, overlap(after, {2, 3}), at, "starts " + cycles_text(after) + " after the release", found);
}

void judge_user_pins(const Scene& scene, Found& found) {
  if (!scene.sees_user()) return;
  for (std::size_t i = 0; i < scene.accesses.size(); ++i) {
    const ChipAccess& access = scene.accesses[i];  // a start-up access also waits (H6)
    if (scene.is_start_up(access) || !scene.in_reset(access.start - scene.time.ticks(8), access.start))
      judge_start(scene, i, found.fit(parameter::kAccessInterval), found);
  }
}

// --- lengths

bool cut_by_reset(const Scene& scene, const ChipAccess& access) {
  return scene.in_reset(access.start, access.end + scene.time.margin());
}

bool has_length(const Scene& scene, const ChipAccess& access) {
  return access.whole && !scene.is_start_up(access) && !cut_by_reset(scene, access);
}

Instance length_of(const Scene& scene, const ChipAccess& access) {
  return {access.start, scene.time.between(access.start, access.end), scene.time.best(access.start, access.end)};
}

/// No access is shorter than an empty one. Single samples may hide the length; then the mean decides, if it leaves only
/// one whole number.
void judge_shortest(const Scene& scene, Found& found) {
  std::vector<Instance> empty;
  for (const ChipAccess& access : scene.accesses) {
    if (!has_length(scene, access)) continue;
    const Instance length = length_of(scene, access);
    if (length.span.contains(kEmptyAccess))
      empty.push_back(length);
    else if (length.span.hi < kEmptyAccess)
      found.judge.fails(kEmpty, access.start, "an access of " + cycles_text(length.span));
  }
  const Estimate all = estimate(empty, &scene.time);
  if (all.count == 0) return;
  if (all.span.hi < kEmptyAccess)
    return found.judge.fails(kEmpty, empty.front().at, "accesses of " + cycles_text(all.span) + " on average");
  const bool certain = all.whole() == std::llround(kEmptyAccess);
  for (std::size_t i = 0; i < all.count; ++i)
    if (certain)
      found.judge.holds(kEmpty);
    else
      found.judge.coarse(kEmpty);
}

/// Accesses before which the user did not hold the DPRAM since the previous access.
std::vector<Instance> lengths_without_user(const Scene& scene) {
  std::vector<Instance> lengths;
  for (std::size_t i = 1; i < scene.accesses.size(); ++i) {
    const ChipAccess& access = scene.accesses[i];
    if (has_length(scene, access) && scene.user_lets(scene.accesses[i - 1].start, access.start))
      lengths.push_back(length_of(scene, access));
  }
  return lengths;
}

/// Most of these are empty, because no master can cause work for every third. So the shorter two thirds are, on
/// average, not longer than an empty access.
void judge_share(const Scene& scene, Found& found) {
  constexpr std::size_t kEnough = 20;
  constexpr double kExchange = 660;  // cycles: one byte of outputs and a short answer at 12 Mbit/s, with TSDR and T_SYN
  if (!scene.sees_user() || 3 * found.fit(parameter::kAccessInterval).estimate.span.hi > kExchange) return;
  std::vector<Instance> lengths = lengths_without_user(scene);
  const std::size_t all = lengths.size();
  if (all < kEnough) return;
  const auto empty = std::count_if(lengths.begin(), lengths.end(),
                                   [](const Instance& each) { return each.span.contains(kEmptyAccess); });
  const auto shorter = lengths.begin() + static_cast<std::ptrdiff_t>(2 * all / 3);
  std::nth_element(lengths.begin(), shorter, lengths.end(),
                   [](const Instance& a, const Instance& b) { return a.best < b.best; });
  const Span most = estimate({lengths.begin(), shorter}, &scene.time).span;
  const bool few = 3 * static_cast<std::size_t>(empty) < 2 * all;
  if (few || most.lo > kEmptyAccess)
    found.judge.fails(kEmpty, scene.accesses.front().start,
                      fmt::format("most of {} take another time, the shorter two thirds {}", all, cycles_text(most)));
}

/// With long samples it may merge with the next access.
void judge_start_up(const Scene& scene, Found& found) {
  for (const ChipAccess& access : scene.accesses) {
    if (!access.whole || !scene.is_start_up(access) || cut_by_reset(scene, access)) continue;
    const Span length = scene.time.between(access.start, access.end);
    if (length.contains(kStartUpAccess))
      found.judge.holds(kStartUp);
    else if (scene.time.doubt() >= 1 && length.contains(kStartUpWithNext))
      found.judge.coarse(kStartUp);
    else
      found.judge.fails(kStartUp, access.start, cycles_text(length));
  }
}

void judge_overdue(const Scene& scene, Found& found) {
  const Fit& interval = found.fit(parameter::kAccessInterval);
  if (interval.estimate.count == 0) return;
  for (std::size_t i = 0; i + 1 < scene.accesses.size(); ++i) {
    const ChipAccess &one = scene.accesses[i], &two = scene.accesses[i + 1];
    if (!one.whole || scene.in_reset(one.start, two.start)) continue;
    const bool overdue = scene.time.between(one.start, one.end).lo > interval.estimate.span.hi;
    if (!overdue || !scene.sees_user() ||
        !scene.user_lets(one.end - scene.time.ticks(4) - scene.time.margin(), two.start))
      continue;
    const Span gap = scene.time.between(one.end, two.start);
    if (gap.contains(1))
      found.judge.holds(kOverdue);
    else if (scene.time.doubt() >= 1)
      found.judge.coarse(kOverdue);
    else
      found.judge.fails(kOverdue, two.start, cycles_text(gap) + " after the end");
  }
}

}  // namespace

void measure_access(Scene& scene, Found& found) {
  judge_start_up(scene, found);
  if (scene.may_miss_accesses()) {
    found.fit(parameter::kAccessInterval).not_shown = kTooCoarse;
    for (const Claim* claim : access_claims())
      if (claim != &kStartUp) found.judge.coarse(*claim);
    return;
  }
  judge_together(scene, found);
  fit_interval(scene, found);
  judge_interval(scene, found);
  judge_user_pins(scene, found);
  judge_shortest(scene, found);
  judge_share(scene, found);
  judge_overdue(scene, found);
}

ClaimList access_claims() {
  return {&kInterval, &kTogether, &kHeldOff, &kAtOnce, &kRace, &kEmpty, &kStartUp, &kOverdue};
}

}  // namespace dsdpv1::calibrate
