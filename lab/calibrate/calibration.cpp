#include "lab/calibrate/calibration.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <set>

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

/// The slowest rate whose samples contain all changes; 0 when none does.
double found_rate(const Record& record, double unit) {
  constexpr double kUnits = 8;
  for (const double rate : kRates) {
    const double period = kTicksPerSecond / (rate * 1e6);
    if (period > kUnits * (unit + 1) && on_grid(record, period, unit)) return rate * 1e6;
  }
  return 0;
}

struct Samples {
  double period = 0, jitter = 0;  ///< ns
  bool rate_found = false;        ///< found from the times
};

Samples samples_of(const Record& record, const Sampling& sampling) {
  Samples samples;
  double period = sampling.unit;
  if (sampling.rate) {
    period = kTicksPerSecond / *sampling.rate;
  } else if (const double rate = found_rate(record, sampling.unit); rate > 0) {
    period = kTicksPerSecond / rate;
    samples.rate_found = true;
  }
  samples.period = period / kTicksPerNs;
  samples.jitter = sampling.rate || samples.rate_found ? sampling.jitter_ns : 0;
  return samples;
}

TimeBase time_of(const Samples& samples) {
  constexpr auto kTicksPerCycle = static_cast<double>(bus::kTicksPerCycle);
  TimeBase time;
  time.period = std::max(samples.period * kTicksPerNs, 1.0) / kTicksPerCycle;
  time.jitter = samples.jitter * kTicksPerNs / kTicksPerCycle;
  return time;
}

// --- verdicts

/// Wires of a group are listed once, by its name, after the others.
std::string missing(const Record& record, const std::vector<Wire>& needs) {
  std::vector<std::string> names;
  std::set<std::string> groups;
  for (const Wire wire : needs) {
    const WireInfo& info = record.table[static_cast<std::size_t>(wire)];
    if (record.sees(wire)) continue;
    if (info.group == nullptr)
      names.push_back(info.name);
    else
      groups.insert(info.group);
  }
  names.insert(names.end(), groups.begin(), groups.end());
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

ParameterResult result_of(const ParameterRow& row, const tb::keys::Field& field, const Record& record, const Fit& fit) {
  ParameterResult result;
  result.row = &row;
  result.field = &field;
  result.fit = fit;
  const long long usual = std::strtoll(field.default_text.c_str(), nullptr, 10);
  result.usual = result.chosen = usual;
  if (fit.estimate.count == 0) {
    const std::string pins = missing(record, row.needs);
    result.words = !pins.empty() ? pins : fit.not_shown.empty() ? "did not occur" : fit.not_shown;
    return result;
  }
  const bool bounded = !fit.at_most && !fit.at_least;
  if (bounded) result.value = fit.estimate.whole();
  const tb::keys::Range range = field.type.range;
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
  else if (const std::string pins = missing(record, claim.needs); !pins.empty())
    result.words = pins;
  else
    result.words = result.tally.coarse > 0 ? "the samples are too far apart" : "did not occur";
  return result;
}

std::vector<ClaimResult> claim_results(const Claims& claims, const Record& record, const Judge& judge) {
  std::vector<ClaimResult> results;
  for (const Ruling& ruling : claims.rulings()) {
    if (ruling.hidden != nullptr) {
      results.push_back({ruling.id, "", Verdict::kNotShown, {}, ruling.hidden});
      continue;
    }
    for (const Claim* claim : claims.claims())
      if (claim->ruling == ruling.id) results.push_back(result_of(*claim, record, judge));
  }
  return results;
}

std::vector<std::string> wires_seen(const Record& record) {
  std::vector<std::string> wires;
  for (std::size_t i = 0; i < record.traces.size(); ++i)
    if (record.traces[i].seen) wires.push_back(record.table[i].name);
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

Result calibrate(const std::string& file, const Record& record, const Sampling& sampling, std::optional<int> station,
                 const tb::ChipKind& kind) {
  const Claims& claims = *kind.claims();
  const Samples samples = samples_of(record, sampling);
  Result result(claims.measure(record, {time_of(samples), sampling.clock_ppm, station}));
  result.file = file;
  result.end = record.end;
  result.table = &record.table;
  result.wires = wires_seen(record);
  result.sample_ns = samples.period;
  result.jitter_ns = samples.jitter;
  result.rate_found = samples.rate_found;
  for (std::size_t i = 0; i < claims.parameters().size(); ++i) {
    const ParameterRow& row = claims.parameters()[i];
    result.parameters.push_back(result_of(row, *kind.chip_keys().find(row.key), record, result.found.fits[i]));
  }
  result.claims = claim_results(claims, record, result.found.judge);
  return result;
}

}  // namespace dsdpv1::calibrate
