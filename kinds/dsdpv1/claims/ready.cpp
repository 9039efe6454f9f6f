// D1: when B004 is written.
#include <algorithm>

#include "kinds/dsdpv1/claims/found.hpp"
#include "kinds/dsdpv1/claims/reads.hpp"

namespace dsdpv1::calibrate {
namespace {

/// Indexes of the start-up accesses.
std::vector<std::size_t> start_ups(const Scene& scene) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < scene.accesses.size(); ++i)
    if (scene.accesses[i].whole && scene.is_start_up(scene.accesses[i])) found.push_back(i);
  return found;
}

/// Cycles to an access from cycle R of the start-up before it.
class SinceRelease {
 public:
  /// R is 2 to 3 cycles after RESET rose; without RESET it is the begin of the start-up access, if the user made no
  /// request before the chip looked.
  static std::optional<SinceRelease> of(const Scene& scene, const ChipAccess& start_up) {
    const Trace& reset = scene.record[wire::kReset];
    const std::size_t rose = reset.last(start_up.start, true);
    if (reset.seen && rose != Trace::kNone) return SinceRelease{scene, reset.edges[rose], {2, 3}};
    const Tick before = start_up.start - scene.time.ticks(4) - scene.time.margin();
    if (scene.sees_user() && scene.user_lets(before, before)) return SinceRelease{scene, start_up.start, {0, 0}};
    return std::nullopt;
  }
  Span operator()(const ChipAccess& access) const {
    const Span since = scene_.time.between(from_, access.start);
    return {since.lo - behind_.hi, since.hi - behind_.lo};
  }

 private:
  SinceRelease(const Scene& scene, Tick from, Span behind) : scene_(scene), from_(from), behind_(behind) {}

  const Scene& scene_;
  Tick from_;
  Span behind_;  ///< R is so many cycles after it
};

/// The access that wrote B004 according to the user's reads, unless the user wrote there (P6).
void bound_by_reads(const Scene& scene, std::size_t start_up, std::size_t until, const SinceRelease& since,
                    Span& bound) {
  constexpr std::uint32_t kB004 = 4;
  const Tick from = scene.accesses[start_up].start,
             to = until < scene.accesses.size() ? scene.accesses[until].start : bus::kNever;
  for (const UserAccess& access : scene.user) {
    if (access.address != kB004 || access.end < from || access.start > to) continue;
    if (access.write) return;
    const std::optional<Standing> standing = standing_data(scene, access);
    if (!standing || !is_known(scene, access)) continue;
    const std::uint32_t data = data_at(scene.record, standing->to);
    std::size_t before = start_up;
    while (before + 1 < scene.accesses.size() && scene.accesses[before + 1].start < access.start) ++before;
    if (before == start_up) continue;
    if (data == 0) bound.lo = std::max(bound.lo, since(scene.accesses[before]).lo);
    if (data == 0xC5) bound.hi = std::min(bound.hi, since(scene.accesses[before]).hi);
  }
}

/// ... and by length: the first access after the one that writes B012 that takes a cycle more than an empty one, as
/// long as the user has written nothing.
void bound_by_length(const Scene& scene, std::size_t start_up, std::size_t until, const SinceRelease& since,
                     Span& bound) {
  const Span empty{kEmptyAccess, kEmptyAccess}, one_byte{kEmptyAccess + 1, kEmptyAccess + 1};
  for (std::size_t i = start_up + 2; i < until && scene.accesses[i].whole; ++i) {
    const Span length = scene.time.between(scene.accesses[i].start, scene.accesses[i].end);
    if (overlap(length, empty) && overlap(length, one_byte)) return;  // too coarse to decide
    if (overlap(length, empty)) continue;
    if (!overlap(length, one_byte)) return;
    bound.lo = std::max(bound.lo, since(scene.accesses[i - 1]).lo);
    bound.hi = std::min(bound.hi, since(scene.accesses[i]).hi);
    return;
  }
}

}  // namespace

void measure_ready(const Scene& scene, Found& found) {
  constexpr double kFar = 1e12;
  Fit& fit = found.fit(parameter::kReadyCycles);
  if (scene.may_miss_accesses()) {
    fit.not_shown = kTooCoarse;
    return;
  }
  std::vector<Instance> instances;
  const std::vector<std::size_t> starts = start_ups(scene);
  bool any_release = false;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const std::size_t until = i + 1 < starts.size() ? starts[i + 1] : scene.accesses.size();
    const std::optional<SinceRelease> since = SinceRelease::of(scene, scene.accesses[starts[i]]);
    if (!since) continue;
    any_release = true;
    Span bound{0, kFar};
    if (!may_miss_writes(scene)) bound_by_reads(scene, starts[i], until, *since, bound);
    bound_by_length(scene, starts[i], until, *since, bound);
    if (bound.lo > 0 && bound.hi < kFar) instances.push_back({scene.accesses[starts[i]].start, bound, bound.middle()});
  }
  fit.estimate = estimate(instances);
  if (fit.estimate.count != 0) return;
  fit.not_shown = starts.empty() ? "no start-up access"
                  : any_release  ? "the access that writes B004 is not to be told from others"
                                 : "no RESET, and no start-up access that certainly did not wait";
}

}  // namespace dsdpv1::calibrate
