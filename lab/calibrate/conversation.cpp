#include "lab/calibrate/conversation.hpp"

#include <algorithm>
#include <set>

namespace dsdpv1::calibrate {
namespace {

Tick syn(const LineTelegram& telegram) { return bus::kSynBits * bus::baud(telegram.baud).bit; }

/// Drops a telegram that the end of the capture cuts.
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

/// The first edge after T_SYN of idle: a telegram before it may have begun before the capture.
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
/// telegram that is received: earlier telegrams do not count.
void leave_out_begun(Conversation& all, const Trace& txd) {
  const auto right = first_right(all.received);
  all.received.erase(all.received.cbegin(), right);
  leave_out_before(all.sent, all.received.empty() ? first_whole(all.sent, txd) : all.received.front().start);
}

/// The station's echo: its RXD is the line, and its answers are on it.
void leave_out_own(std::vector<LineTelegram>& received, const std::vector<LineTelegram>& sent, const TimeBase& time) {
  const Tick about = time.margin() + 8 * bus::kTicksPerCycle;
  const auto own = [&](const LineTelegram& telegram) {
    const auto near = std::lower_bound(sent.begin(), sent.end(), telegram.start - about,
                                       [](const LineTelegram& each, Tick at) { return each.start < at; });
    return near != sent.end() && near->start <= telegram.start + about;
  };
  received.erase(std::remove_if(received.begin(), received.end(), own), received.end());
}

/// Not a telegram, and begins after the request's decision (S10).
bool comes_after(const LineTelegram& noise, const LineTelegram& request, const TimeBase& time) {
  return !noise.right &&
         noise.start > request.last_start + (bus::kCharacterBits + 1) * bus::baud(request.baud).bit - time.margin();
}

/// Begins before T_SYN, or is too short to be a request.
bool is_no_request(const LineTelegram& noise, const LineTelegram& request) {
  constexpr int kShorterThanAny = 5;  // characters
  const Tick bit = bus::baud(request.baud).bit;
  return noise.start < request.end() + syn(request) ||
         noise.last_edge < noise.start + kShorterThanAny * bus::kCharacterBits * bit;
}

/// The latest begin of an answer to this request: the next use of the line. Characters that form no telegram do not
/// keep the chip from answering. But an answer later than max_TSDR (S3) may belong to a wrong request.
Tick waits_until(const Conversation& all, const TimeBase& time, std::size_t request) {
  const LineTelegram& asked = all.received[request];
  Tick latest = bus::kNever;
  std::size_t next = request + 1;
  for (; asked.right && next < all.received.size(); ++next) {
    const LineTelegram& noise = all.received[next];
    if (!comes_after(noise, asked, time)) break;
    if (is_no_request(noise, asked)) continue;
    if (noise.coarse(time)) break;
    latest = asked.end() + asked.max_tsdr() + time.margin();
  }
  return std::min(latest, next < all.received.size() ? all.received[next].start : bus::kNever);
}

/// Requests with the chip's answer, if there is one before the line is used again.
void pair_up(Conversation& all, const TimeBase& time) {
  std::size_t sent = 0;
  for (std::size_t i = 0; i < all.received.size(); ++i) {
    const LineTelegram& request = all.received[i];
    const Tick until = waits_until(all, time, i);
    for (; sent < all.sent.size() && all.sent[sent].start < request.start; ++sent)
      all.unasked.push_back(&all.sent[sent]);
    Exchange exchange{&request, nullptr};
    if (sent < all.sent.size() && all.sent[sent].start < until) exchange.answer = &all.sent[sent++];
    for (; sent < all.sent.size() && all.sent[sent].start < until; ++sent) all.unasked.push_back(&all.sent[sent]);
    all.exchanges.push_back(exchange);
  }
  for (; sent < all.sent.size(); ++sent) all.unasked.push_back(&all.sent[sent]);
}

/// Keeps only telegrams to a station that answers on PBTXD, those to all, and characters that form no telegram.
void keep_own(Conversation& all, std::optional<int> address) {
  std::set<int> stations;
  if (address) stations.insert(*address);
  for (const Exchange& exchange : all.exchanges)
    if (!address && exchange.answer != nullptr && exchange.request->right)
      stations.insert(exchange.request->telegram.da);
  const auto other = [&](const Exchange& exchange) {
    const bus::Telegram& telegram = exchange.request->telegram;
    const bool ours = exchange.request->right && telegram.is_request() &&
                      (stations.count(telegram.da) != 0 || telegram.da == bus::kBroadcast);
    return exchange.answer == nullptr && !ours;
  };
  all.exchanges.erase(std::remove_if(all.exchanges.begin(), all.exchanges.end(), other), all.exchanges.end());
}

/// A low level that may be shorter than half a bit, which does not end idle time (S10).
bool may_be_glitch(const LineTelegram& telegram, const TimeBase& time) {
  const double low = TimeBase::nominal(telegram.last_edge - telegram.start);
  return !telegram.right && low - time.doubt() < telegram.bit() / 2;
}

void measure_idle(Conversation& all, const TimeBase& time) {
  std::optional<Tick> from, until;
  const auto take = [&](const std::vector<LineTelegram>& telegrams, std::size_t& next, Tick before) {
    for (; next < telegrams.size() && telegrams[next].start < before; ++next) {
      if (!may_be_glitch(telegrams[next], time)) from = std::max(from.value_or(0), telegrams[next].idle_from());
      until = std::max(until.value_or(0), telegrams[next].idle_until());
    }
  };
  std::size_t received = 0, sent = 0;
  for (Exchange& exchange : all.exchanges) {
    const LineTelegram& request = *exchange.request;
    take(all.received, received, request.start);
    take(all.sent, sent, request.start);
    if (from)
      exchange.idle = {TimeBase::nominal(request.start - *until) / request.bit(),
                       TimeBase::nominal(request.start - *from) / request.bit()};
  }
}

/// What S26 compares by content, including the FCS.
bool same_frame(const LineTelegram& a, const LineTelegram& b) {
  const bus::Telegram &first = a.telegram, &second = b.telegram;
  const auto fcs = [](const LineTelegram& each) { return each.bytes[each.bytes.size() - 2]; };
  return first.sa == second.sa && first.fc == second.fc && first.dsap == second.dsap && first.ssap == second.ssap &&
         first.data.size() == second.data.size() && fcs(a) == fcs(b);
}

/// What it compares by the letter: the one before is not forgotten, and FCB has not changed.
bool same_fcb(const LineTelegram& a, const LineTelegram& b) {
  const unsigned first = a.telegram.fc, second = b.telegram.fc;
  return a.telegram.sa == b.telegram.sa && (first & (bus::fc::kFcv | bus::fc::kFcb)) != 0 &&
         ((first ^ second) & bus::fc::kFcb) == 0;
}

/// A request whose answer depends on the one before, in either form of S26. That may be a request that was not read, or
/// one before the capture.
void find_repetitions(Conversation& all) {
  const Exchange* before = nullptr;
  for (Exchange& exchange : all.exchanges) {
    if (exchange.is_request() && (exchange.request->telegram.fc & bus::fc::kFcv) != 0) {
      exchange.same = before != nullptr && before->request->right && same_frame(*before->request, *exchange.request);
      exchange.repeats = before == nullptr || !before->request->right || same_fcb(*before->request, *exchange.request);
    }
    if (exchange.answer != nullptr) before = &exchange;
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

Conversation conversation_of(const Trace& rxd, const Trace& txd, Tick end, const TimeBase& time,
                             std::optional<int> address) {
  Conversation all;
  if (rxd.seen) all.received = telegrams_received(rxd, time);
  if (txd.seen) all.sent = telegrams_sent(txd, time, all.received);
  leave_out_cut(all.received, rxd, end);
  leave_out_cut(all.sent, txd, end);
  leave_out_own(all.received, all.sent, time);
  leave_out_begun(all, txd);
  if (all.received.empty() || !txd.seen) return all;
  pair_up(all, time);
  keep_own(all, address);
  measure_idle(all, time);
  find_repetitions(all);
  return all;
}

}  // namespace dsdpv1::calibrate
