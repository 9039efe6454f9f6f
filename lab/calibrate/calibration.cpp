#include "lab/calibrate/calibration.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "io/input/suggest.hpp"

namespace dsdpv1::calibrate {
namespace {

constexpr double kTicksPerNs = static_cast<double>(bus::kTicksPerNs),
                 kTicksPerSecond = static_cast<double>(bus::kTicksPerSecond);

// --- the sample rate

/// Rates of common analysers, MS/s, the slowest first.
constexpr std::array<double, 34> kRates = {1,  2,  3,   4,   5,   6,   6.25, 8,   10,  12, 12.5, 15,
                                           16, 20, 24,  25,  30,  32,  40,   48,  50,  60, 62.5, 64,
                                           80, 96, 100, 120, 125, 150, 160,  192, 200, 250};

bool on_grid(const Record& record, double period, double unit) {
  constexpr std::size_t kEnough = 5000;
  std::size_t looked = 0;
  for (const Trace& trace : record.traces)
    for (std::size_t i = 0; i < std::min(trace.edges.size(), kEnough); ++i, ++looked) {
      const auto at = static_cast<double>(trace.edges[i]);
      if (std::abs(at - std::round(at / period) * period) > unit + 1) return false;
    }
  return looked > 20;
}

/// The slowest rate on whose samples all changes are; 0 when there is none.
double found_rate(const Record& record, double unit) {
  constexpr double kUnits = 8;
  for (const double rate : kRates) {
    const double period = kTicksPerSecond / (rate * 1e6);
    if (period > kUnits * (unit + 1) && on_grid(record, period, unit)) return rate * 1e6;
  }
  return 0;
}

TimeBase time_of(const Record& record, const Sampling& sampling, Result& result) {
  double period = sampling.unit;
  if (sampling.rate) {
    period = kTicksPerSecond / *sampling.rate;
  } else if (const double rate = found_rate(record, sampling.unit); rate > 0) {
    period = kTicksPerSecond / rate;
    result.rate_found = true;
  }
  const bool sampled = sampling.rate || result.rate_found;
  result.sample_ns = period / kTicksPerNs;
  result.jitter_ns = sampled ? sampling.jitter_ns : 0;
  TimeBase time;
  time.period = std::max(period, 1.0) / static_cast<double>(bus::kTicksPerCycle);
  time.jitter = result.jitter_ns * kTicksPerNs / static_cast<double>(bus::kTicksPerCycle);
  return time;
}

// --- verdicts

std::string missing(const Record& record, const std::vector<Wire>& needs, bool accesses) {
  std::vector<std::string> names;
  for (const Wire wire : needs)
    if (!record.sees(wire)) names.push_back(name(wire));
  if (accesses && !record.sees_accesses()) names.emplace_back("pins of the host port");
  return names.empty() ? "" : "not in the capture: " + tb::join(names);
}

std::string span_text(const Fit& fit) {
  const long long lo = std::llround(std::ceil(fit.estimate.span.lo)),
                  hi = std::llround(std::floor(fit.estimate.span.hi));
  if (fit.at_most) return fmt::format("at most {}", hi);
  if (fit.at_least) return fmt::format("at least {}", lo);
  if (lo > hi) return fmt::format("{:.2f} to {:.2f}", fit.estimate.span.lo, fit.estimate.span.hi);
  return lo == hi ? fmt::format("{}", lo) : fmt::format("{} to {}", lo, hi);
}

ParameterResult result_of(const ParameterRow& row, const Record& record, const Fit& fit) {
  ParameterResult result;
  result.row = &row;
  result.fit = fit;
  const long long usual = default_of(row);
  result.chosen = usual;
  if (fit.estimate.count == 0) {
    const std::string pins = missing(record, row.needs, false);
    result.words = !pins.empty() ? pins : fit.not_shown.empty() ? "did not occur" : fit.not_shown;
    return result;
  }
  const bool bounded = !fit.at_most && !fit.at_least;
  if (bounded) result.value = fit.estimate.whole();
  const tb::keys::Range range = field_of(row).type.range;
  const bool fits = fit.estimate.span.contains(static_cast<double>(usual));
  result.verdict = !fits ? Verdict::kContradicted : bounded ? Verdict::kConfirmed : Verdict::kNotContradicted;
  if (!fits) {
    const double wanted = fit.at_most    ? fit.estimate.span.hi
                          : fit.at_least ? fit.estimate.span.lo
                                         : fit.estimate.span.middle();
    result.chosen = result.value.value_or(std::llround(fit.at_most    ? std::floor(wanted)
                                                       : fit.at_least ? std::ceil(wanted)
                                                                      : wanted));
  }
  result.chosen = std::min<long long>(std::max<long long>(result.chosen, range.min), range.max);
  result.words = span_text(fit);
  return result;
}

ClaimResult result_of(const Claim& claim, const Record& record, const Judge& judge) {
  ClaimResult result;
  result.ruling = claim.ruling;
  result.says = claim.says;
  result.tally = judge.tally(claim);
  if (result.tally.fails > 0)
    result.verdict = Verdict::kContradicted;
  else if (result.tally.holds > 0)
    result.verdict = Verdict::kConfirmed;
  else if (const std::string pins = missing(record, claim.needs, claim.accesses); !pins.empty())
    result.words = pins;
  else
    result.words = result.tally.coarse > 0 ? "the samples are too far apart" : "did not occur";
  return result;
}

std::vector<ClaimResult> claim_results(const Record& record, const Judge& judge) {
  std::vector<ClaimResult> results;
  const Claims claims = all_claims();
  for (const Ruling& ruling : rulings()) {
    if (ruling.hidden != nullptr) {
      results.push_back({ruling.id, "", Verdict::kNotShown, {}, ruling.hidden});
      continue;
    }
    for (const Claim* claim : claims)
      if (claim->ruling == ruling.id) results.push_back(result_of(*claim, record, judge));
  }
  return results;
}

std::vector<std::string> wires_of(const Record& record) {
  std::vector<std::string> wires;
  for (std::size_t i = 0; i < kWireCount; ++i)
    if (record.traces.at(i).seen) wires.push_back(name(static_cast<Wire>(i)));
  return wires;
}

}  // namespace

const char* word(Verdict verdict) {
  switch (verdict) {
    case Verdict::kConfirmed: return "confirmed";
    case Verdict::kContradicted: return "CONTRADICTED";
    case Verdict::kNotContradicted: return "not contradicted";
    case Verdict::kNotShown: break;
  }
  return "not shown";
}

bool Result::agrees() const {
  const auto wrong = [](const auto& each) { return each.verdict == Verdict::kContradicted; };
  return std::none_of(parameters.begin(), parameters.end(), wrong) && std::none_of(claims.begin(), claims.end(), wrong);
}

Result calibrate(const std::string& file, const Record& record, const Sampling& sampling, std::optional<int> station) {
  Result result;
  result.file = file;
  result.end = record.end;
  result.wires = wires_of(record);
  Scene scene{record, time_of(record, sampling, result), station};
  fill(scene);
  Found& found = result.found;
  measure_clock(scene, sampling.clock_ppm, found);
  find_resets(scene);
  measure_access(scene, found);
  measure_ready(scene, found);
  measure_interrupt(scene, found);
  measure_answers(scene, found);
  measure_tsdr(scene, found);
  measure_search(scene, found);
  measure_watchdog(scene, found);
  measure_telegrams(scene, found);
  measure_user(scene, found);
  measure_reset(scene, found);
  result.requests = scene.exchanges.size();
  result.answers = scene.sent.size();
  result.accesses = scene.accesses.size();
  result.user_accesses = scene.user.size();
  for (const ParameterRow& row : parameters())
    result.parameters.push_back(result_of(row, record, found.fit(row.parameter)));
  result.claims = claim_results(record, found.judge);
  return result;
}

}  // namespace dsdpv1::calibrate
