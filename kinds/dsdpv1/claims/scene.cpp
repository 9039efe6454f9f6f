#include "kinds/dsdpv1/claims/scene.hpp"

#include <algorithm>

namespace dsdpv1::calibrate {
namespace {

void find_accesses(Scene& scene) {
  const Trace& trace = scene.record[wire::kLReq].seen ? scene.record[wire::kLReq] : scene.record[wire::kLSta];
  for (std::size_t edge = trace.next(0, true); edge < trace.edges.size(); edge += 2) {
    const bool ends = edge + 1 < trace.edges.size();
    scene.accesses.push_back({trace.edges[edge], ends ? trace.edges[edge + 1] : bus::kNever, ends});
  }
}

/// The first edge to `level` at or after `from`; bus::kNever without one.
Tick edge_behind(const Trace& trace, Tick from, bool level) {
  const std::size_t edge = trace.next(from, level);
  return edge == Trace::kNone ? bus::kNever : trace.edges[edge];
}

/// P5, P11: CSR and the strobe are both low in an access. If CSR rises before WR nothing is written.
void find_user_accesses(Scene& scene, Wire strobe) {
  const Record& record = scene.record;
  const Trace &trace = record[strobe], &select = record[wire::kCsr];
  const Tick sample =
      std::max<Tick>(1, static_cast<Tick>(scene.time.period * static_cast<double>(bus::kTicksPerCycle)));
  for (std::size_t edge = trace.next(0, false); edge + 1 < trace.edges.size(); edge += 2) {
    const Tick fall = trace.edges[edge], rise = trace.edges[edge + 1];
    Tick start = select.at(fall) ? edge_behind(select, fall, false) : fall;
    for (; start < rise; start = edge_behind(select, start, false)) {
      const Tick end = std::min(rise, edge_behind(select, start + 1, true)), before = std::max(start, end - sample);
      if (strobe == wire::kRd || end == rise)
        scene.user.push_back({start, end, strobe == wire::kWr, address_at(record, before),
                              static_cast<std::uint8_t>(data_at(record, before))});
      start = end;
    }
  }
}

}  // namespace

bool Scene::user_lets(Tick from, Tick to) const {
  return (!record.sees(wire::kRReq) || record[wire::kRReq].low(from, to)) &&
         (!record.sees(wire::kRSta) || record[wire::kRSta].low(from, to));
}

Scene::Scene(const Record& all, const TimeBase& base, std::optional<int> station)
    : Conversation(conversation_of(all[wire::kPbrxd], all[wire::kPbtxd], all.end, base, station)),
      record(all),
      time(base) {
  find_accesses(*this);
  if (!record.sees(host_port())) return;
  find_user_accesses(*this, wire::kRd);
  find_user_accesses(*this, wire::kWr);
  std::sort(user.begin(), user.end(), [](const UserAccess& a, const UserAccess& b) { return a.end < b.end; });
}

}  // namespace dsdpv1::calibrate
