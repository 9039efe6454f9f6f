#include "kinds/dsdpv1/claims/scene.hpp"

#include <algorithm>
#include <set>

namespace dsdpv1::calibrate {
namespace {

Tick syn(const LineTelegram& telegram) { return bus::kSynBits * bus::baud(telegram.baud).bit; }

/// A telegram that the capture has only a part of at its end is none.
void leave_out_cut(std::vector<LineTelegram>& telegrams, const Trace& trace, Tick end) {
  if (!telegrams.empty() && !telegrams.back().right && trace.edges.back() + syn(telegrams.back()) > end)
    telegrams.pop_back();
}

void leave_out_before(std::vector<LineTelegram>& telegrams, Tick at) {
  const auto behind = std::find_if(telegrams.begin(), telegrams.end(),
                                   [&](const LineTelegram& telegram) { return telegram.start >= at; });
  telegrams.erase(telegrams.begin(), behind);
}

std::vector<LineTelegram>::const_iterator first_right(const std::vector<LineTelegram>& telegrams) {
  return std::find_if(
      telegrams.begin(), telegrams.end(), [](const LineTelegram& telegram) { return telegram.right; });
}

/// The first edge after T_SYN of idle: what begins before it may have begun before the capture.
Tick first_whole(const std::vector<LineTelegram>& telegrams, const Trace& trace) {
  if (telegrams.empty()) return 0;
  const auto right = first_right(telegrams);
  const Tick idle = syn(right != telegrams.end() ? *right : telegrams.front());
  Tick before = 0;
  for (std::size_t edge = 0; edge < trace.edges.size(); before = trace.edges[edge++])
    if (trace.level(edge) && trace.edges[edge] - before >= idle) return trace.edges[edge];
  return bus::kNever;
}

/// The capture may begin in a telegram, or between a request and its answer, and shows the rate with the first right
/// telegram on PBRXD: what comes before that does not count.
void leave_out_begun(Scene& scene) {
  const auto right = first_right(scene.received);
  scene.received.erase(scene.received.cbegin(), right);
  leave_out_before(scene.sent, scene.received.empty() ? first_whole(scene.sent, scene.record[wire::kPbtxd])
                                                      : scene.received.front().start);
}

/// What the chip hears of its own: PBRXD is the line, and its answers are on it.
void leave_out_own(std::vector<LineTelegram>& received, const std::vector<LineTelegram>& sent, const TimeBase& time) {
  const Tick about = time.margin() + 8 * bus::kTicksPerCycle;
  const auto own = [&](const LineTelegram& telegram) {
    const auto near = std::lower_bound(sent.begin(), sent.end(), telegram.start - about,
                                       [](const LineTelegram& each, Tick at) { return each.start < at; });
    return near != sent.end() && near->start <= telegram.start + about;
  };
  received.erase(std::remove_if(received.begin(), received.end(), own), received.end());
}

/// What is no telegram, and begins after the request's decision (S10).
bool comes_after(const LineTelegram& noise, const LineTelegram& request, const TimeBase& time) {
  return !noise.right &&
         noise.start > request.last_start + (bus::kCharacterBits + 1) * bus::baud(request.baud).bit - time.margin();
}

/// It comes before T_SYN, or is too short to be a request itself.
bool is_no_request(const LineTelegram& noise, const LineTelegram& request) {
  constexpr int kShorterThanAny = 5;  // characters
  const Tick bit = bus::baud(request.baud).bit;
  return noise.start < request.end() + syn(request) ||
         noise.last_edge < noise.start + kShorterThanAny * bus::kCharacterBits * bit;
}

/// Until when an answer to this request may begin: the line is used again. What is no telegram does not keep the chip
/// from answering; but what begins later than max_TSDR (S3) may be an answer to a wrong request.
Tick waits_until(const Scene& scene, std::size_t request) {
  const LineTelegram& asked = scene.received[request];
  Tick latest = bus::kNever;
  std::size_t next = request + 1;
  for (; asked.right && next < scene.received.size(); ++next) {
    const LineTelegram& noise = scene.received[next];
    if (!comes_after(noise, asked, scene.time)) break;
    if (is_no_request(noise, asked)) continue;
    if (noise.coarse(scene.time)) break;
    latest = asked.end() + asked.max_tsdr() + scene.time.margin();
  }
  return std::min(latest, next < scene.received.size() ? scene.received[next].start : bus::kNever);
}

/// Requests with the chip's answer, if there is one before the line is used again.
void pair_up(Scene& scene) {
  std::size_t sent = 0;
  for (std::size_t i = 0; i < scene.received.size(); ++i) {
    const LineTelegram& request = scene.received[i];
    const Tick until = waits_until(scene, i);
    for (; sent < scene.sent.size() && scene.sent[sent].start < request.start; ++sent)
      scene.unasked.push_back(&scene.sent[sent]);
    Exchange exchange{&request, nullptr};
    if (sent < scene.sent.size() && scene.sent[sent].start < until) exchange.answer = &scene.sent[sent++];
    for (; sent < scene.sent.size() && scene.sent[sent].start < until; ++sent)
      scene.unasked.push_back(&scene.sent[sent]);
    scene.exchanges.push_back(exchange);
  }
  for (; sent < scene.sent.size(); ++sent) scene.unasked.push_back(&scene.sent[sent]);
}

/// Of others' telegrams only those to a station that answers on PBTXD, to all, and what is none stay.
void keep_own(Scene& scene) {
  std::set<int> stations;
  if (scene.station) stations.insert(*scene.station);
  for (const Exchange& exchange : scene.exchanges)
    if (!scene.station && exchange.answer != nullptr && exchange.request->right)
      stations.insert(exchange.request->telegram.da);
  const auto other = [&](const Exchange& exchange) {
    const bus::Telegram& telegram = exchange.request->telegram;
    const bool ours = exchange.request->right && telegram.is_request() &&
                      (stations.count(telegram.da) != 0 || telegram.da == bus::kBroadcast);
    return exchange.answer == nullptr && !ours;
  };
  scene.exchanges.erase(std::remove_if(scene.exchanges.begin(), scene.exchanges.end(), other), scene.exchanges.end());
}

/// A low level of less than half a bit, perhaps, which ends no idle time (S10).
bool may_be_glitch(const LineTelegram& telegram, const TimeBase& time) {
  const double low = TimeBase::nominal(telegram.last_edge - telegram.start);
  return !telegram.right && low - time.doubt() < telegram.bit() / 2;
}

void measure_idle(Scene& scene) {
  std::optional<Tick> from, until;
  const auto take = [&](const std::vector<LineTelegram>& telegrams, std::size_t& next, Tick before) {
    for (; next < telegrams.size() && telegrams[next].start < before; ++next) {
      if (!may_be_glitch(telegrams[next], scene.time)) from = std::max(from.value_or(0), telegrams[next].idle_from());
      until = std::max(until.value_or(0), telegrams[next].idle_until());
    }
  };
  std::size_t received = 0, sent = 0;
  for (Exchange& exchange : scene.exchanges) {
    const LineTelegram& request = *exchange.request;
    take(scene.received, received, request.start);
    take(scene.sent, sent, request.start);
    if (from)
      exchange.idle = {TimeBase::nominal(request.start - *until) / request.bit(),
                       TimeBase::nominal(request.start - *from) / request.bit()};
  }
}

/// What the chip compares (S26), the FCS included.
bool same_frame(const LineTelegram& a, const LineTelegram& b) {
  const bus::Telegram &first = a.telegram, &second = b.telegram;
  const auto fcs = [](const LineTelegram& each) { return each.bytes[each.bytes.size() - 2]; };
  return first.sa == second.sa && first.fc == second.fc && first.dsap == second.dsap && first.ssap == second.ssap &&
         first.data.size() == second.data.size() && fcs(a) == fcs(b);
}

/// A request whose answer cannot be known from others than the one before; one that was not read, or was before the
/// capture, may be the one before.
void find_repetitions(Scene& scene) {
  const Exchange* before = nullptr;
  for (Exchange& exchange : scene.exchanges) {
    if (exchange.is_request() && (exchange.request->telegram.fc & bus::fc::kFcv) != 0) {
      exchange.same = before != nullptr && before->request->right && same_frame(*before->request, *exchange.request);
      exchange.repeats = exchange.same || before == nullptr || !before->request->right;
    }
    if (exchange.answer != nullptr) before = &exchange;
  }
}

void find_accesses(Scene& scene) {
  const Trace& trace = scene.record[wire::kLReq].seen ? scene.record[wire::kLReq] : scene.record[wire::kLSta];
  for (std::size_t edge = trace.next(0, true); edge < trace.edges.size(); edge += 2) {
    const bool ends = edge + 1 < trace.edges.size();
    scene.accesses.push_back({trace.edges[edge], ends ? trace.edges[edge + 1] : bus::kNever, ends});
  }
}

/// The first edge to `level` at or behind `from`; bus::kNever when there is none.
Tick edge_behind(const Trace& trace, Tick from, bool level) {
  const std::size_t edge = trace.next(from, level);
  return edge == Trace::kNone ? bus::kNever : trace.edges[edge];
}

/// P5, P11: an access is where CSR and the strobe are both low. Where CSR rises before WR nothing is written.
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

bool Exchange::is_srd(std::optional<std::uint8_t> dsap) const {
  const std::uint8_t function = request->telegram.function();
  return is_request() && (function == bus::fc::kSrdLow || function == bus::fc::kSrdHigh) &&
         request->telegram.dsap == dsap;
}

bool Exchange::acknowledged() const {
  return answer != nullptr && answer->right && answer->telegram.kind == bus::TelegramKind::kSc;
}

bool Exchange::refused(std::uint8_t fc) const {
  return answer != nullptr && answer->right && answer->telegram.kind == bus::TelegramKind::kSd1 &&
         answer->telegram.fc == fc;
}

bool Exchange::exchanged() const {
  return is_srd(std::nullopt) && answer != nullptr && answer->right && !refused(bus::fc::kRs) && !refused(bus::fc::kRr);
}

bool Scene::user_lets(Tick from, Tick to) const {
  return (!record.sees(wire::kRReq) || record[wire::kRReq].low(from, to)) &&
         (!record.sees(wire::kRSta) || record[wire::kRSta].low(from, to));
}

void fill(Scene& scene) {
  if (scene.record.sees(wire::kPbrxd)) scene.received = telegrams_received(scene.record[wire::kPbrxd], scene.time);
  if (scene.record.sees(wire::kPbtxd))
    scene.sent = telegrams_sent(scene.record[wire::kPbtxd], scene.time, scene.received);
  leave_out_cut(scene.received, scene.record[wire::kPbrxd], scene.record.end);
  leave_out_cut(scene.sent, scene.record[wire::kPbtxd], scene.record.end);
  leave_out_own(scene.received, scene.sent, scene.time);
  leave_out_begun(scene);
  if (!scene.received.empty() && scene.record.sees(wire::kPbtxd)) {
    pair_up(scene);
    keep_own(scene);
    measure_idle(scene);
    find_repetitions(scene);
  }
  find_accesses(scene);
  if (!scene.record.sees(host_port())) return;
  find_user_accesses(scene, wire::kRd);
  find_user_accesses(scene, wire::kWr);
  std::sort(scene.user.begin(), scene.user.end(),
            [](const UserAccess& a, const UserAccess& b) { return a.end < b.end; });
}

}  // namespace dsdpv1::calibrate
