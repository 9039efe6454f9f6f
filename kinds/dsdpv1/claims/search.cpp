// S1, S9, S10, P3: the baud search, and the pins that show the states.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinds/dsdpv1/claims/found.hpp"
#include "model/dsdpv1/chip.hpp"

namespace dsdpv1::calibrate {
namespace {

const Claim kLocks = {"S1", "a right SD1, SD2 or SD3 ends the search", {wire::kPbrxd, wire::kBr}};
const Claim kDecided = {
    "S10", "BR rises at the decision of a telegram, 1 bit time after it", {wire::kPbrxd, wire::kBr}};
const Claim kSilent = {
    "S9", "the telegram that ends the search is not answered", {wire::kPbrxd, wire::kPbtxd, wire::kBr}};
const Claim kFoundFirst = {
    "P3", "an answer is sent only while BR and READY are high", {wire::kPbtxd, wire::kBr, wire::kReady}};
const Claim kExchange = {
    "P3", "outputs are taken, and inputs sent, only while PBF is low", {wire::kPbrxd, wire::kPbtxd, wire::kPbf}};

bool locks(const LineTelegram& telegram) {
  using Kind = bus::TelegramKind;
  const Kind kind = telegram.telegram.kind;
  return telegram.right && (kind == Kind::kSd1 || kind == Kind::kSd2 || kind == Kind::kSd3);
}

// --- windows of the search

/// The rate with index `baud` was found this many cycles after the begin of the search.
struct Lock {
  Tick at = 0;
  int baud = 0;
  Span cycles;
};

/// Cycles from the beginning of the search to the window of this rate.
double windows_before(int baud, double ms, double bits) {
  double sum = 0;
  for (int i = 0; i < baud; ++i) sum += std::max(ms * kCyclesPerMs, bits * TimeBase::nominal(bus::baud(i).bit));
  return sum;
}

std::optional<Tick> search_start(const Scene& scene, Tick found_at) {
  const Trace &br = scene.record[wire::kBr], &ready = scene.record[wire::kReady];
  const std::size_t fell = br.last(found_at - 1, false), rose = ready.last(found_at - 1, true);
  Tick start = -1;
  if (fell != Trace::kNone) start = br.edges[fell];
  if (rose != Trace::kNone) start = std::max(start, ready.edges[rose]);
  return start < 0 ? std::nullopt : std::optional<Tick>(start);
}

/// The telegram that ends the search at `at`: its last character is just before.
std::size_t telegram_ending(const Scene& scene, Tick at) {
  std::size_t last = Trace::kNone;
  for (std::size_t i = 0; i < scene.received.size() && scene.received[i].last_start <= at; ++i)
    if (locks(scene.received[i])) last = i;
  if (last == Trace::kNone) return last;
  const LineTelegram& telegram = scene.received[last];
  const double near = 2 * bus::kCharacterBits * telegram.bit();
  return scene.time.between(telegram.last_start, at).lo < near ? last : Trace::kNone;
}

/// The telegram that ends there was not read: the samples are too far apart, or the capture begins in it.
bool ends_unread(const Scene& scene, Tick at) {
  constexpr int kSlowest = bus::kBaudCount - 1;
  const auto near = [&](Tick edge, int baud) {
    return scene.time.between(edge, at).lo < 3 * bus::kCharacterBits * TimeBase::nominal(bus::baud(baud).bit);
  };
  if (scene.received.empty() || at < scene.received.front().start) {
    const Trace& line = scene.record[wire::kPbrxd];
    const std::size_t edges = line.count_until(at);
    return near(edges > 0 ? line.edges[edges - 1] : 0, scene.received.empty() ? kSlowest : scene.received.front().baud);
  }
  return std::any_of(scene.received.begin(), scene.received.end(), [&](const LineTelegram& telegram) {
    return !telegram.right && telegram.coarse(scene.time) && telegram.start < at &&
           near(telegram.last_edge, telegram.baud);
  });
}

void judge_decision(const Scene& scene, const LineTelegram& telegram, Tick at, Found& found) {
  const Span seen = scene.time.between(telegram.last_start, at), right = telegram.decision();
  if (overlap(seen, right))
    found.judge.holds(kDecided);
  else
    found.judge.fails(kDecided, at, fmt::format("{:+.1f} cycles from it", seen.middle() - right.middle()));
}

/// A telegram that lies, with its T_SYN, entirely in the window of its rate locks it; one that did not lock came too
/// early. This needs closely spaced telegrams during most of the search, and assumes the first round of the rates.
Lock lock_of(const Scene& scene, Tick start, std::size_t by) {
  const LineTelegram& telegram = scene.received[by];
  const double syn = bus::kSynBits * telegram.bit(), doubt = 8;
  Lock lock{telegram.start, telegram.baud, {0, scene.time.between(start, telegram.start).hi - syn + doubt}};
  std::optional<Tick> first, before;
  double widest = 0;
  for (std::size_t i = 0; i <= by; ++i) {
    const LineTelegram& each = scene.received[i];
    if (each.start < start || !locks(each) || each.baud != telegram.baud) continue;
    if (!first) first = each.start;
    if (before) widest = std::max(widest, TimeBase::nominal(each.start - *before));
    if (i < by) before = each.start;
  }
  const double all = TimeBase::nominal(telegram.start - start);
  const double silent = TimeBase::nominal(first.value_or(telegram.start) - start);
  const bool dense = before && silent * 2 < all && widest * 2 * (telegram.baud + 1) < all;
  if (dense) lock.cycles.lo = std::max(0.0, scene.time.between(start, *before).lo - syn - doubt);
  return lock;
}

std::vector<Lock> locks_of(const Scene& scene, Found& found) {
  std::vector<Lock> all;
  const Trace& br = scene.record[wire::kBr];
  for (std::size_t edge = br.next(0, true); edge < br.edges.size(); edge += 2) {
    const Tick at = br.edges[edge];
    const std::size_t by = telegram_ending(scene, at);
    if (by == Trace::kNone && ends_unread(scene, at)) {
      found.judge.coarse(kLocks);
      continue;
    }
    if (by == Trace::kNone) {
      found.judge.fails(kLocks, at, "BR rises without a telegram before it");
      continue;
    }
    found.judge.holds(kLocks);
    judge_decision(scene, scene.received[by], at, found);
    const auto start = search_start(scene, at);
    if (start && scene.received[by].baud > 0) all.push_back(lock_of(scene, *start, by));
  }
  return all;
}

/// The lowest and highest value of 1 .. most for which `fits` holds at some value of the other parameter.
struct Range {
  double lo = 0, hi = 0;
  bool any = false;

  void add(double value) {
    lo = any ? std::min(lo, value) : value;
    hi = any ? std::max(hi, value) : value;
    any = true;
  }
  void add(const Range& other) {
    if (!other.any) return;
    add(other.lo), add(other.hi);
  }
};

constexpr int kMostMs = 10'000, kLeastBits = 100, kMostBits = 100'000;

/// The bit times that fit all locks if the minimum time is `ms`; the sum of windows grows with either.
Range bits_for(const std::vector<Lock>& all, int ms) {
  int lo = kLeastBits, hi = kMostBits;
  for (const Lock& lock : all) {
    const auto sum = [&](int bits) { return windows_before(lock.baud, ms, bits); };
    int low = lo, high = hi + 1;
    while (low < high) {
      const int middle = (low + high) / 2;
      if (sum(middle) >= lock.cycles.lo)
        high = middle;
      else
        low = middle + 1;
    }
    lo = low;
    low = lo, high = hi + 1;
    while (low < high) {
      const int middle = (low + high) / 2;
      if (sum(middle) > lock.cycles.hi)
        high = middle;
      else
        low = middle + 1;
    }
    hi = low - 1;
  }
  Range range;
  if (lo <= hi) range.add(lo), range.add(hi);
  return range;
}

/// Values that fit all locks. Either time can explain much of the other, so if one is not needed it is taken to be the
/// default; both are left open only if neither is needed.
struct Windows {
  Range ms, bits;
};

Windows windows_of(const std::vector<Lock>& all) {
  const dsdpv1::Config usual;
  const auto usual_ms = static_cast<int>(usual.search_window_ms),
             usual_bits = static_cast<int>(usual.search_window_bits);
  Windows by_ms, by_bits, both;
  for (int ms = 1; ms <= kMostMs; ++ms) {
    const Range bits = bits_for(all, ms);
    if (!bits.any) continue;
    both.ms.add(ms), both.bits.add(bits);
    if (ms == usual_ms) by_bits.ms.add(ms), by_bits.bits.add(bits);
    if (bits.lo <= usual_bits && usual_bits <= bits.hi) by_ms.ms.add(ms), by_ms.bits.add(bits);
  }
  return by_ms.ms.any ? by_ms : by_bits.ms.any ? by_bits : both;
}

void set_window(Fit& fit, const Range& range, double least, double most, std::size_t count) {
  fit.at_most = range.lo <= least;
  fit.at_least = range.hi >= most;
  if (fit.at_most && fit.at_least) {
    fit.not_shown = "the other least time decides";
    return;
  }
  fit.estimate.count = count;
  fit.estimate.span = {range.lo, range.hi};
}

void fit_windows(const Scene& scene, Found& found) {
  std::vector<Lock> all = locks_of(scene, found);
  if (std::none_of(all.begin(), all.end(), [](const Lock& lock) { return lock.cycles.lo > 0; })) all.clear();
  Fit &ms_fit = found.fit(parameter::kSearchWindowMs), &bits_fit = found.fit(parameter::kSearchWindowBits);
  const Windows windows = all.empty() ? Windows{} : windows_of(all);
  if (!windows.ms.any) {
    ms_fit.not_shown = bits_fit.not_shown = all.empty() ? "no search with telegrams at 6M or slower during most of it"
                                                        : "the searches contradict each other";
    return;
  }
  set_window(ms_fit, windows.ms, 1, kMostMs, all.size());
  set_window(bits_fit, windows.bits, kLeastBits, kMostBits, all.size());
}

// --- other pins

void judge_pins(const Scene& scene, Found& found) {
  const Record& record = scene.record;
  const Tick about = scene.time.margin();
  if (record.sees({wire::kBr, wire::kReady}))
    for (const LineTelegram& sent : scene.sent)
      found.judge.judge(kFoundFirst,
                        !record[wire::kBr].low(sent.start - about, sent.start + about) &&
                            !record[wire::kReady].low(sent.start - about, sent.start + about),
                        sent.start, "an answer while BR or READY is low");
  if (!record.sees(wire::kPbf)) return;
  for (const Exchange& exchange : scene.exchanges) {
    if (exchange.repeats || !exchange.exchanged()) continue;  // S26
    const Tick at = exchange.request->end();
    found.judge.judge(kExchange, !record[wire::kPbf].high(at - about, exchange.answer->start), exchange.answer->start,
                      "a data exchange is answered while PBF is high");
  }
}

void judge_silence(const Scene& scene, Found& found) {
  const Trace& br = scene.record[wire::kBr];
  for (const Exchange& exchange : scene.exchanges) {
    const LineTelegram& request = *exchange.request;
    const std::size_t rise = br.next(request.last_start, true);
    if (rise == Trace::kNone || !request.right) continue;
    if (!overlap(scene.time.between(request.last_start, br.edges[rise]), request.decision())) continue;
    found.judge.judge(kSilent, exchange.answer == nullptr, br.edges[rise], "it is answered");
  }
}

}  // namespace

void measure_search(const Scene& scene, Found& found) {
  const Record& record = scene.record;
  if (record.sees({wire::kPbrxd, wire::kBr})) {
    fit_windows(scene, found);
    judge_silence(scene, found);
  }
  judge_pins(scene, found);
}

ClaimList search_claims() { return {&kLocks, &kDecided, &kSilent, &kFoundFirst, &kExchange}; }

}  // namespace dsdpv1::calibrate
