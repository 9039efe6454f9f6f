#include "kinds/dsdpv1/claims/reads.hpp"

#include <algorithm>

namespace dsdpv1::calibrate {
namespace {

bool may_be_in_reset(const Scene& scene, const UserAccess& read) {
  const Tick from = read.start - scene.time.ticks(3) - scene.time.margin();
  return scene.in_reset(from, read.end) || scene.may_hide_reset(from, read.end);
}

bool before_start_up(const Scene& scene, const UserAccess& read) {
  const Trace& reset = scene.record[wire::kReset];
  const std::size_t rose = reset.last(read.start, true);
  if (rose == Trace::kNone || !scene.record.sees(wire::kLReq)) return false;
  const auto next = std::lower_bound(scene.accesses.begin(), scene.accesses.end(), read.end,
                                     [](const ChipAccess& access, Tick at) { return access.start < at; });
  return next == scene.accesses.begin() || std::prev(next)->start < reset.edges[rose];
}

bool has_dpram(const Scene& scene, const UserAccess& read) {
  const auto is = [&scene](Wire wire, bool level, Tick from, Tick to) {
    const Trace& trace = scene.record[wire];
    return !trace.seen || (level ? trace.high(from, to) : trace.low(from, to));
  };
  const Tick from = read.start - scene.time.margin(), to = read.start + scene.time.margin();
  return is(wire::kRReq, true, read.start, read.end) && is(wire::kRSta, true, read.start, read.end) &&
         is(wire::kLReq, false, from, to) && is(wire::kLSta, false, from, to);
}

/// A write takes effect at the third edge of CLK after WR rose, a read samples at the first.
bool in_flight(const Scene& scene, const UserAccess& read) {
  constexpr double kEffect = 3;
  const auto by_end = [](const UserAccess& access, Tick at) { return access.end < at; };
  auto each = std::lower_bound(scene.user.begin(), scene.user.end(), read.end, by_end);
  while (each != scene.user.begin()) {
    --each;
    if (scene.time.between(each->end, read.start).lo >= kEffect) return false;
    if (each->write && each->address == read.address) return true;
  }
  return false;
}

}  // namespace

std::optional<Standing> standing_data(const Scene& scene, const UserAccess& read) {
  constexpr double kDelay = 1.5;  // cycles
  const Standing standing{read.start + scene.time.ticks(kDelay + scene.time.doubt()),
                          read.end - scene.time.ticks(scene.time.doubt())};
  return standing.from < standing.to ? std::optional<Standing>(standing) : std::nullopt;
}

bool may_miss_writes(const Scene& scene) {
  const double longer = 2 * scene.time.period;
  return scene.may_miss_accesses() || std::any_of(scene.user.begin(), scene.user.end(), [&](const UserAccess& access) {
           return TimeBase::nominal(access.end - access.start) < longer;
         });
}

bool is_known(const Scene& scene, const UserAccess& read) {
  return !may_be_in_reset(scene, read) && !before_start_up(scene, read) && has_dpram(scene, read) &&
         !in_flight(scene, read);
}

}  // namespace dsdpv1::calibrate
