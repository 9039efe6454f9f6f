// S1, S22: the causes of leaving DATA_EXCH and of BR's falls.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinds/dsdpv1/claims/found.hpp"
#include "lab/calibrate/supervision.hpp"
#include "model/dsdpv1/chip.hpp"

namespace dsdpv1::calibrate {
namespace {

const Claim kWatchdog = {
    "S1", "the watchdog of Set_Prm ends DATA_EXCH after its time", {wire::kPbrxd, wire::kPbtxd, wire::kPbf}};
const Claim kBrFalls = {"S1",
                        "BR falls the same whole number of ms after the last telegram, or the watchdog's end",
                        {wire::kPbrxd, wire::kPbtxd, wire::kBr}};

/// A new initialisation may be taken there: an access of the chip that read more than its flags.
bool long_access(const Scene& scene, Tick at) {
  constexpr double kLeast = 10;
  if (!scene.record.sees(wire::kLReq)) return true;
  const Tick about = scene.time.margin() + scene.time.ticks(1);
  const auto after = std::upper_bound(scene.accesses.begin(), scene.accesses.end(), at + about,
                                      [](Tick when, const ChipAccess& access) { return when < access.start; });
  if (after == scene.accesses.begin()) return false;
  const ChipAccess& access = *(after - 1);
  return access.end >= at - about && (!access.whole || scene.time.between(access.start, access.end).hi >= kLeast);
}

/// PBF rises for another cause than the watchdog: a request decided just before, or a new initialisation.
bool ended_otherwise(const Scene& scene, Tick at) {
  constexpr Span kJustBefore = {-1, 16};
  const auto decided = [&](const Exchange& exchange) {
    return overlap(since(scene.time, decision_of(*exchange.request), at), kJustBefore);
  };
  const Tick about = scene.time.margin();
  const bool initialised =
      scene.record.sees(wire::kBr) ? !scene.record[wire::kBr].high(at - about, at + about) : long_access(scene, at);
  return initialised || std::any_of(scene.exchanges.begin(), scene.exchanges.end(), decided);
}

void judge_watchdog(const Scene& scene, Found& found) {
  Supervision supervision(scene, scene.time, scene.record[wire::kBr]);
  const Trace& pbf = scene.record[wire::kPbf];
  for (std::size_t edge = pbf.next(0, true); edge < pbf.edges.size(); edge += 2) {
    const Tick at = pbf.edges[edge];
    const auto& prm = supervision.before(at).prm;  // in force, since PBF was low
    if (scene.in_reset(at - scene.time.margin(), at) || !prm || !prm->heard || prm->watchdog == 0) continue;
    const Span passed = since(scene.time, *prm->heard, at);
    const bool late = passed.lo > prm->watchdog, early = passed.lo > prm->watchdog / 2 && !ended_otherwise(scene, at);
    if (passed.contains(prm->watchdog))
      found.judge.holds(kWatchdog);
    else if (late || early)
      found.judge.fails(kWatchdog, at, fmt::format("{:+.1f} cycles from its end", passed.middle() - prm->watchdog));
  }
}

/// The time keeps running at the last character of a request, or at the capture's end.
struct Running {
  Tick at = 0;
  Supervised supervised;
  Span passed;  ///< cycles since the last telegram, or the end of the previous watchdog
};

/// Where the telegrams, all of them read, show what is running.
std::vector<Running> runs_on(const Scene& scene) {
  std::vector<Running> all;
  std::vector<Tick> unread;
  for (const LineTelegram& telegram : scene.received)
    if (!telegram.right && telegram.coarse(scene.time)) unread.push_back(telegram.start);
  Supervision supervision(scene, scene.time, scene.record[wire::kBr]);
  const auto add = [&](Tick at) {
    const Supervised& now = supervision.before(at);
    if (now.state == Supervised::State::kUnknown) return;
    const auto next = std::upper_bound(unread.begin(), unread.end(), now.last.edge);
    const bool all_read = next == unread.end() || *next >= at;
    const double watchdog = now.state == Supervised::State::kDpControl ? now.prm->watchdog : 0;
    if (all_read) all.push_back({at, now, since(scene.time, now.last, at) + -watchdog});
  };
  for (const Exchange& exchange : scene.exchanges) add(exchange.request->last_start);
  add(scene.record.end);
  return all;
}

/// PBF must not stay low after the watchdog has ended.
void judge_unended(const Scene& scene, Found& found) {
  for (const Running& each : runs_on(scene))
    if (each.supervised.state == Supervised::State::kDpControl && each.passed.lo > 2 &&
        scene.record[wire::kPbf].low(each.supervised.last.edge, each.at))
      found.judge.fails(kWatchdog, each.at, fmt::format("PBF is low {:.1f} cycles after its end", each.passed.lo));
}

/// Whether a fall of BR was caused by a new initialisation.
enum class Initialised : std::uint8_t { kNo, kPerhaps, kYes };

/// A new initialisation ends DATA_EXCH, in a long access of the chip; the end of BAUD_CONTROL keeps the state (S1).
Initialised initialised_at(const Scene& scene, Tick at) {
  const Trace& pbf = scene.record[wire::kPbf];
  const Tick from = at - scene.time.margin(), to = at + scene.time.margin();
  if (!long_access(scene, at) || pbf.low(from, to)) return Initialised::kNo;
  const bool rises = pbf.seen && !pbf.high(from, to);
  return rises || scene.record.sees(wire::kLReq) ? Initialised::kYes : Initialised::kPerhaps;
}

/// BR falls.
struct Fall {
  Tick at = 0;
  Span ms;  ///< since the last telegram, or the end of the previous watchdog
  Initialised initialised = Initialised::kPerhaps;
};

struct Falls {
  std::vector<Fall> all;
  bool unknown = false;       ///< there are others, whose prior events the capture does not show
  bool initialised = false;   ///< others are new initialisations, as shown by PBF or L_REQ
  std::vector<Fall> not_yet;  ///< BR is still high there
  double longest = 0;         ///< of these, at least; ms
};

/// Places where BR does not fall although the time is running.
void find_silences(const Scene& scene, Falls& falls) {
  for (const Running& each : runs_on(scene)) {
    if (!scene.record[wire::kBr].high(each.supervised.last.edge, each.at)) continue;
    falls.not_yet.push_back({each.at, {each.passed.lo / kCyclesPerMs, each.passed.hi / kCyclesPerMs}});
    falls.longest = std::max(falls.longest, falls.not_yet.back().ms.lo);
  }
}

Falls falls_of(const Scene& scene) {
  Falls falls;
  Supervision supervision(scene, scene.time, scene.record[wire::kBr]);
  const Trace& br = scene.record[wire::kBr];
  for (std::size_t edge = br.next(0, false); edge < br.edges.size(); edge += 2) {
    const Tick at = br.edges[edge];
    if (scene.in_reset(at - scene.time.margin(), at)) continue;
    const Supervised& before = supervision.before(at);
    if (before.state == Supervised::State::kUnknown) {
      falls.unknown = true;
      continue;
    }
    const double watchdog = before.state == Supervised::State::kDpControl ? before.prm->watchdog : 0;
    const Span passed = since(scene.time, before.last, at) + -watchdog;
    falls.all.push_back({at, {passed.lo / kCyclesPerMs, passed.hi / kCyclesPerMs}, initialised_at(scene, at)});
  }
  return falls;
}

constexpr double kNearMs = 0.001;

bool is_whole(const Span& ms) {
  const double whole = std::round(ms.middle());
  return whole >= 1 && ms.lo - kNearMs <= whole && whole <= ms.hi + kNearMs;
}

/// Falls that measure the time of BAUD_CONTROL. A new initialisation may come at any time, but never after its end.
std::vector<Fall> ends_of_time(Falls& falls) {
  std::vector<Fall> ends;
  double latest = falls.longest;
  for (const Fall& fall : falls.all) {
    if (!is_whole(fall.ms)) continue;
    if (fall.initialised == Initialised::kYes) {
      falls.initialised = true;
      continue;
    }
    ends.push_back(fall);
    latest = std::max(latest, fall.ms.lo);
  }
  const auto earlier = [&](const Fall& fall) {
    return fall.initialised == Initialised::kPerhaps && fall.ms.hi < latest;
  };
  ends.erase(std::remove_if(ends.begin(), ends.end(), earlier), ends.end());
  return ends;
}

/// The time that they show. A single fall that may be a new initialisation only shows that the time had not passed
/// before, unless it matches the default.
void fit_time(const std::vector<Fall>& ends, Fit& fit) {
  std::vector<Instance> instances;
  instances.reserve(ends.size());
  for (const Fall& end : ends) instances.push_back({end.at, end.ms, end.ms.middle()});
  Estimate& time = fit.estimate = estimate(instances);
  const bool certain =
      std::any_of(ends.begin(), ends.end(), [](const Fall& end) { return end.initialised == Initialised::kNo; });
  if (certain || time.count != 1 || time.span.contains(dsdpv1::Config{}.baud_control_ms)) return;
  time.span.hi = std::numeric_limits<double>::max();
  fit.at_least = true;
}

/// A fall that does not agree counts as a new initialisation, if there may be one.
void judge_falls(const Falls& falls, Found& found) {
  Fit& fit = found.fit(parameter::kBaudControlMs);
  for (const Fall& fall : falls.all) {
    const bool known = fit.estimate.count != 0 && !fit.at_least,
               right = known && is_whole(fall.ms) && overlap(fall.ms, fit.estimate.span);
    const double by = known ? fall.ms.middle() - fit.estimate.span.middle() : 0;
    if (right)
      found.judge.holds(kBrFalls);
    else if (fall.initialised == Initialised::kNo)
      found.judge.fails(kBrFalls, fall.at, fmt::format("{:.3f} ms after it", fall.ms.middle()));
    const auto told = [&](const Outlier& outlier) { return outlier.at == fall.at; };
    std::vector<Outlier>& others = fit.estimate.outliers;
    if (known && !right && std::none_of(others.begin(), others.end(), told)) others.push_back({fall.at, by});
  }
  for (const Fall& high : falls.not_yet)
    if (fit.estimate.count != 0 && high.ms.lo > fit.estimate.span.hi + kNearMs)
      found.judge.fails(kBrFalls, high.at, fmt::format("BR is high {:.3f} ms after it", high.ms.middle()));
  if (fit.estimate.count != 0) return;
  if (falls.longest > dsdpv1::Config{}.baud_control_ms + kNearMs) {
    fit.estimate.count = 1;
    fit.estimate.span = {falls.longest, std::numeric_limits<double>::max()};
    fit.at_least = true;
    return;
  }
  fit.not_shown = falls.initialised    ? "BR falls, but only where the chip may take a new initialisation"
                  : !falls.all.empty() ? "BR falls, but no whole number of ms after the last telegram"
                  : falls.unknown      ? "BR falls, but the capture does not show whether a watchdog ran before"
                                       : "BR does not fall after silence";
}

void fit_baud_control(const Scene& scene, Found& found) {
  Falls falls = falls_of(scene);
  find_silences(scene, falls);
  fit_time(ends_of_time(falls), found.fit(parameter::kBaudControlMs));
  judge_falls(falls, found);
}

}  // namespace

void measure_watchdog(const Scene& scene, Found& found) {
  if (scene.record.sees({wire::kPbrxd, wire::kPbtxd, wire::kBr})) fit_baud_control(scene, found);
  if (scene.record.sees({wire::kPbrxd, wire::kPbtxd, wire::kPbf}))
    judge_watchdog(scene, found), judge_unended(scene, found);
}

ClaimList watchdog_claims() { return {&kWatchdog, &kBrFalls}; }

}  // namespace dsdpv1::calibrate
