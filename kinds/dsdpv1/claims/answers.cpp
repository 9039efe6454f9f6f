// P2, S2, S3: PBTXD and PBRTS of the chip's answers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bus/wire/uart.hpp"
#include "kinds/dsdpv1/claims/found.hpp"

namespace dsdpv1::calibrate {
namespace {

const Claim kLead = {"P2", "PBRTS rises the same time before each answer", {wire::kPbtxd, wire::kPbrts}};
const Claim kTrail = {"P2", "PBRTS falls the same time after each answer", {wire::kPbtxd, wire::kPbrts}};
const Claim kDriven = {"P2", "PBTXD is low only while PBRTS is high", {wire::kPbtxd, wire::kPbrts}};
const Claim kBits = {"S2", "every edge of an answer is a whole number of bit times from its start", {wire::kPbtxd}};
const Claim kAnswered = {"S3", "a right request to the station is answered", {wire::kPbrxd, wire::kPbtxd}};
const Claim kAsked = {"S3", "nothing is sent without a request", {wire::kPbrxd, wire::kPbtxd}};
const Claim kSyn = {
    "S3", "a request after less than 33 bit times of idle is not answered", {wire::kPbrxd, wire::kPbtxd}};

// --- PBRTS

struct Driver {
  std::vector<Instance> leads, trails;
};

/// PBRTS around answer `i`: its rise after the beginning of the previous answer, its fall before the next one.
void measure_driver(const Scene& scene, std::size_t i, Driver& driver, Found& found) {
  const Trace& rts = scene.record[wire::kPbrts];
  const LineTelegram& sent = scene.sent[i];
  const Tick begun = sent.start + scene.time.margin(), before = i > 0 ? scene.sent[i - 1].start : -1,
             next = i + 1 < scene.sent.size() ? scene.sent[i + 1].start : scene.record.end;
  if (!rts.at(begun)) return;
  if (const std::size_t rise = rts.last(begun, true); rise != Trace::kNone && rts.edges[rise] > before) {
    const Tick up = rts.edges[rise];
    driver.leads.push_back({sent.start, scene.time.between(up, sent.start), scene.time.best(up, sent.start)});
  }
  const double length = static_cast<double>(sent.bytes.size()) * bus::kCharacterBits * sent.bit();
  const std::size_t fall = rts.next(begun, false);
  if (fall != Trace::kNone && rts.edges[fall] < next) {
    const Tick down = rts.edges[fall];
    driver.trails.push_back(
        {sent.start, scene.time.between(sent.start, down) + -length, scene.time.best(sent.start, down) - length});
  } else if (i + 1 < scene.sent.size()) {
    found.judge.fails(kTrail, sent.end(), "PBRTS is high until the next answer");
  }
}

void fit_driver(const Scene& scene, Found& found) {
  Driver driver;
  for (std::size_t i = 0; i < scene.sent.size(); ++i)
    if (scene.sent[i].right) measure_driver(scene, i, driver, found);
  const auto fit = [&](Parameter parameter, const Claim& claim, std::vector<Instance>& instances) {
    Fit& to = found.fit(parameter);
    to.estimate = estimate(instances, &scene.time);
    if (to.estimate.span.hi >= 0) to.estimate.span.lo = std::max(to.estimate.span.lo, 0.0);
    if (to.estimate.count == 0) to.not_shown = "no answer with an edge of PBRTS beside it";
    for (const Outlier& outlier : to.estimate.outliers)
      found.judge.fails(claim, outlier.at, fmt::format("{:+.1f} cycles from the others", outlier.by));
    for (std::size_t i = to.estimate.outliers.size(); i < to.estimate.count; ++i) found.judge.holds(claim);
  };
  fit(parameter::kRtsLead, kLead, driver.leads);
  fit(parameter::kRtsTrail, kTrail, driver.trails);
}

void judge_driven(const Scene& scene, Found& found) {
  const Trace &txd = scene.record[wire::kPbtxd], &rts = scene.record[wire::kPbrts];
  for (std::size_t edge = txd.next(0, false); edge < txd.edges.size(); edge += 2) {
    const Tick at = txd.edges[edge], about = scene.time.margin();
    found.judge.judge(kDriven, !rts.low(at - about, at + about), at, "PBTXD falls while PBRTS is low");
  }
}

// --- bits

/// A telegram's level changes must match its bits.
void judge_bits(const Scene& scene, const LineTelegram& sent, Found& found) {
  const Trace& txd = scene.record[wire::kPbtxd];
  std::size_t edge = txd.count_until(sent.start);
  bool level = false;
  for (std::size_t i = 1; i < sent.bytes.size() * bus::kCharacterBits; ++i) {
    const bool bit =
        (bus::Character::of(sent.bytes[i / bus::kCharacterBits]).bits >> i % bus::kCharacterBits & 1U) != 0;
    if (bit == level) continue;
    level = bit;
    if (edge >= txd.edges.size()) return;
    const Span at = scene.time.between(sent.start, txd.edges[edge]);
    const double right = static_cast<double>(i) * sent.bit();
    if (!at.contains(right)) {
      const double by = at.lo > right ? at.lo - right : at.hi - right;
      found.judge.fails(kBits, txd.edges[edge], fmt::format("an edge {:+.1f} cycles from its place", by));
      return;
    }
    ++edge;
  }
  found.judge.holds(kBits);
}

/// A reset or a new initialisation cuts an answer; without BR any broken answer may have been cut so.
bool is_cut(const Scene& scene, const LineTelegram& sent) {
  const Tick from = sent.last_edge - scene.time.margin(), to = sent.idle_until() + scene.time.margin();
  const auto falls = [&](Wire wire) {
    const Trace& trace = scene.record[wire];
    const std::size_t fall = trace.next(std::max(from, sent.start), false);
    return trace.seen && fall != Trace::kNone && trace.edges[fall] <= to;
  };
  return falls(wire::kReset) || falls(wire::kBr) || (!scene.record.sees(wire::kBr) && sent.breaks_off());
}

// --- answered or not

constexpr Tick kLongestSilence = 50 * bus::kTicksPerMs;

bool wants_answer(const Exchange& exchange) {
  return exchange.request->right && exchange.request->telegram.wants_answer() &&
         exchange.request->telegram.sa < bus::kBroadcast;
}

/// The capture could not read the characters at the time of the answer: the next answer may be this one.
bool answer_may_be_another(const Scene& scene, const LineTelegram& request) {
  const auto next = std::upper_bound(scene.received.begin(), scene.received.end(), request.start,
                                     [](Tick at, const LineTelegram& each) { return at < each.start; });
  return next != scene.received.end() && !next->right && next->coarse(scene.time) &&
         next->start < request.end() + request.max_tsdr();
}

/// Whether the exchanges before and after show that the chip answers requests like this one. A request with a gap may
/// be void. Without BR a request may have ended a search (S1, S9): after a silence, or after a new initialisation,
/// which ends DATA_EXCH.
bool chip_listens(const Scene& scene, std::size_t i) {
  const auto& all = scene.exchanges;
  const LineTelegram& request = *all[i].request;
  const auto same = [&](const Exchange& other) {
    return other.answer != nullptr && other.request->telegram.da == request.telegram.da &&
           other.request->baud == request.baud;
  };
  std::size_t before = i, behind = i + 1;
  while (before > 0 && !wants_answer(all[before - 1])) --before;
  while (behind < all.size() && !wants_answer(all[behind])) ++behind;
  if (request.gap || before == 0 || behind >= all.size() || !same(all[before - 1]) || !same(all[behind])) return false;
  const Tick from = request.start, to = request.end();
  const bool found = scene.record.sees(wire::kBr)
                         ? scene.record[wire::kBr].high(from, to)
                         : all[behind].exchanged() && request.start - all[before - 1].answer->end() < kLongestSilence;
  return !scene.in_reset(from, to) && found &&
         (!scene.record.sees(wire::kReady) || scene.record[wire::kReady].high(from, to));
}

void judge_answered(const Scene& scene, Found& found) {
  constexpr double kSynDoubt = 0.5;
  for (std::size_t i = 0; i < scene.exchanges.size(); ++i) {
    const Exchange& exchange = scene.exchanges[i];
    if (!wants_answer(exchange)) continue;
    const double doubt = kSynDoubt + scene.time.doubt() / exchange.request->bit();
    const bool soon = exchange.idle && exchange.idle->hi < bus::kSynBits - doubt,
               late = exchange.idle && exchange.idle->lo > bus::kSynBits + doubt;
    if (soon)
      found.judge.judge(kSyn, exchange.answer == nullptr, exchange.request->start,
                        "a request after too little idle is answered");
    if (!late) continue;
    if (exchange.answer != nullptr)
      found.judge.holds(kAnswered);
    else if (chip_listens(scene, i) && !answer_may_be_another(scene, *exchange.request))
      found.judge.fails(kAnswered, exchange.request->end(),
                        "a request is not answered, those before and behind it are");
  }
}

/// An answer needs a valid request to the station that expects one.
void judge_asked(const Scene& scene, Found& found) {
  for (const LineTelegram* sent : scene.unasked) found.judge.fails(kAsked, sent->start, "no request before it");
  for (const Exchange& exchange : scene.exchanges) {
    if (exchange.answer == nullptr) continue;
    if (!exchange.request->right && exchange.request->coarse(scene.time)) {
      found.judge.coarse(kAsked);
      continue;
    }
    const bool asked = exchange.request->right && exchange.request->telegram.wants_answer();
    found.judge.judge(kAsked, asked, exchange.answer->start, "what is before it is no request that wants an answer");
  }
}

}  // namespace

void measure_answers(const Scene& scene, Found& found) {
  if (scene.record.sees({wire::kPbtxd, wire::kPbrts})) fit_driver(scene, found), judge_driven(scene, found);
  for (const LineTelegram& sent : scene.sent)
    if (sent.right)
      judge_bits(scene, sent, found);
    else if (sent.coarse(scene.time))
      found.judge.coarse(kBits);
    else if (!is_cut(scene, sent))
      found.judge.fails(kBits, sent.start, "what is sent is no right telegram");
  judge_answered(scene, found);
  judge_asked(scene, found);
}

ClaimList answer_claims() { return {&kLead, &kTrail, &kDriven, &kBits, &kAnswered, &kAsked, &kSyn}; }

}  // namespace dsdpv1::calibrate
