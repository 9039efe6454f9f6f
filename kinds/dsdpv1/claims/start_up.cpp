// Start-up accesses (H6), and with them the resets of a capture without RESET.
#include <algorithm>

#include "kinds/dsdpv1/claims/scene.hpp"

namespace dsdpv1::calibrate {
namespace {

/// Cycles. Before the first initialisation no access takes more than 1235: the user's blocks at full length, which are
/// read and dropped. Later it may take 2424, with the blocks for the user (micro-architecture, 9).
constexpr double kLonger = 1500, kLongest = 2424;
/// Cycles without an access that no interval of a scenario can explain.
constexpr double kSilence = 10'000;

/// The begin of the previous access, or of the capture.
Tick before(const Scene& scene, std::size_t i) { return i == 0 ? 0 : scene.accesses[i - 1].start; }

/// The evidence of RESET, if any.
std::optional<bool> released_before(const Scene& scene, std::size_t i) {
  const Trace& reset = scene.record[wire::kReset];
  if (!reset.seen) return std::nullopt;
  const std::size_t rose = reset.last(scene.accesses[i].start, true);
  if (rose != Trace::kNone && reset.edges[rose] > before(scene, i)) return true;
  return i == 0 ? std::nullopt : std::optional<bool>(false);
}

/// The outputs have their reset levels until the first initialisation.
bool may_be_uninitialised(const Scene& scene, const ChipAccess& access) {
  const Tick from = access.start + scene.time.margin(), to = access.end - scene.time.margin();
  const auto is = [&](Wire wire, bool level) {
    const Trace& trace = scene.record[wire];
    return !trace.seen || (level ? trace.high(from, to) : trace.low(from, to));
  };
  return is(wire::kReady, false) && is(wire::kBr, false) && is(wire::kPbf, true) && is(wire::kPbrts, false);
}

/// The chip made no access for long, although the user did not hold it off.
bool was_silent(const Scene& scene, std::size_t i) {
  const Tick from = i == 0 ? 0 : scene.accesses[i - 1].end, to = scene.accesses[i].start;
  return scene.sees_user() && !scene.may_miss_accesses() && scene.time.between(from, to).lo > kSilence &&
         scene.user_lets(from, to);
}

/// The length given by H6; with long samples the gap of one cycle after it is missed, and it merges with the next
/// access.
bool has_right_length(const Scene& scene, const Span& length) {
  return length.contains(kStartUpAccess) || (scene.time.doubt() >= 1 && length.contains(kStartUpWithNext));
}

/// No access in operation is so long, but two may merge if the samples hide the gap of one cycle.
bool is_too_long(const Scene& scene, const Span& length) { return scene.time.doubt() < 1 && length.lo > kLongest; }

bool is_start_up(const Scene& scene, std::size_t i) {
  const ChipAccess& access = scene.accesses[i];
  if (const std::optional<bool> released = released_before(scene, i)) return *released;
  if (!access.whole) return false;
  const Span length = scene.time.between(access.start, access.end);
  if (length.hi <= kLonger) return false;
  if (was_silent(scene, i)) return true;
  return may_be_uninitialised(scene, access) &&
         (scene.record.sees(wire::kReady) || is_too_long(scene, length) || has_right_length(scene, length));
}

/// READY falls only in a reset; the chip is back at its next access.
void find_falls_of_ready(Scene& scene) {
  const Trace& ready = scene.record[wire::kReady];
  for (std::size_t edge = ready.next(0, false); edge < ready.edges.size(); edge += 2) {
    const Tick fall = ready.edges[edge];
    const auto next = std::upper_bound(scene.accesses.begin(), scene.accesses.end(), fall,
                                       [](Tick at, const ChipAccess& access) { return at < access.start; });
    const Tick rise = edge + 1 < ready.edges.size() ? ready.edges[edge + 1] : scene.record.end;
    scene.resets.push_back({fall - scene.time.margin(), next == scene.accesses.end() ? rise : next->start});
  }
}

}  // namespace

void find_resets(Scene& scene) {
  for (std::size_t i = 0; i < scene.accesses.size(); ++i) scene.accesses[i].start_up = is_start_up(scene, i);
  if (scene.record.sees(wire::kReset)) return;
  for (std::size_t i = 0; i < scene.accesses.size(); ++i)
    if (scene.accesses[i].start_up) scene.resets.push_back({before(scene, i), scene.accesses[i].start});
  find_falls_of_ready(scene);
}

bool Scene::in_reset(Tick from, Tick to) const {
  if (record.sees(wire::kReset)) return !record[wire::kReset].high(from, to);
  return std::any_of(resets.begin(), resets.end(),
                     [&](const Reset& reset) { return reset.from <= to && from < reset.to; });
}

bool Scene::may_hide_reset(Tick from, Tick to) const {
  const bool shown = record.sees(wire::kReset) || record.sees(wire::kReady) || record.sees(wire::kLReq);
  return !shown && !record[wire::kBr].high(from, to) && !record[wire::kPbf].low(from, to);
}

}  // namespace dsdpv1::calibrate
