// The report of a calibration, for people, programs and scenarios.
#include <fmt/format.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "bus/time_text.hpp"
#include "io/input/suggest.hpp"
#include "lab/calibrate/calibration.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::calibrate {
namespace {

double microseconds(Tick at) { return static_cast<double>(at) / static_cast<double>(bus::kTicksPerUs); }
double ppm(double ratio) { return (ratio - 1) * 1e6; }

std::string line(const std::string& heading, const std::string& what) {
  return fmt::format("{:<14} {}\n", heading, what);
}

/// A complete bus becomes one word, after the single wires.
std::string wires_text(const WireTable& table, std::vector<std::string> wires) {
  std::map<std::string, std::set<std::string>> buses;
  for (const WireInfo& wire : table)
    if (!wire.bus.empty()) buses[wire.bus].insert(wire.name);
  for (const auto& [bus, names] : buses) {
    const auto is_bus = [&names = names](const std::string& wire) { return names.count(wire) != 0; };
    if (static_cast<std::size_t>(std::count_if(wires.begin(), wires.end(), is_bus)) != names.size()) continue;
    wires.erase(std::remove_if(wires.begin(), wires.end(), is_bus), wires.end());
    wires.push_back(bus);
  }
  return tb::join(wires);
}

std::string ppm_text(const Estimate& clock) {
  if (clock.count == 0) return "not shown";
  return fmt::format("{:+.1f} to {:+.1f} ppm against the capture's", ppm(clock.span.lo), ppm(clock.span.hi));
}

/// Error and time of the worst instance, or a dash.
std::string worst_text(const std::vector<Outlier>& outliers) {
  if (outliers.empty()) return "-";
  return fmt::format("{:+.2f} at {}", outliers.front().by, bus::moment_text(outliers.front().at));
}

std::string parameter_table(const Result& result) {
  tb::TextTable table({"ruling", "parameter", "default", "measured", "unit", "verdict", "times", "others", "worst"});
  for (const ParameterResult& each : result.parameters) {
    const bool shown = each.verdict != Verdict::kNotShown;
    const Estimate& estimate = each.fit.estimate;
    table.add({each.row->ruling, each.row->key, std::to_string(each.usual), shown ? each.words : "-",
               each.field->type.unit, shown ? word(each.verdict) : std::string(word(each.verdict)) + ": " + each.words,
               std::to_string(estimate.count), std::to_string(estimate.outliers.size()),
               worst_text(estimate.outliers)});
  }
  return table.text();
}

std::string claim_text(const ClaimResult& claim) {
  if (claim.verdict == Verdict::kNotShown) return std::string(word(claim.verdict)) + ": " + claim.words;
  return word(claim.verdict);
}

std::string where_text(const ClaimResult& claim) {
  if (claim.tally.contradictions.empty()) return "-";
  const Contradiction& first = claim.tally.contradictions.front();
  return fmt::format("{}: {}", bus::moment_text(first.at), first.how);
}

std::string claim_table(const Result& result, bool all) {
  tb::TextTable table({"ruling", "claim", "verdict", "times", "against", "first"});
  for (const ClaimResult& claim : result.claims)
    if (!claim.says.empty() && (all || claim.verdict != Verdict::kNotShown))
      table.add({claim.ruling, claim.says, claim_text(claim), std::to_string(claim.tally.holds),
                 std::to_string(claim.tally.fails), where_text(claim)});
  return table.text();
}

/// The rulings without a claim, by reason.
std::string hidden_text(const Result& result) {
  std::map<std::string, std::vector<std::string>> by_reason;
  for (const ClaimResult& claim : result.claims)
    if (claim.says.empty()) by_reason[claim.words].push_back(claim.ruling);
  std::string text;
  for (const auto& [reason, ids] : by_reason) text += "not shown, " + reason + ": " + tb::join(ids) + "\n";
  return text + "\n";
}

/// Counts each ruling once: contradicted by any claim, else confirmed by one, else not shown.
std::array<std::size_t, 3> counted(const Result& result) {
  std::array<std::size_t, 3> counts{};
  for (std::size_t i = 0; i < result.claims.size();) {
    const std::string& ruling = result.claims[i].ruling;
    Verdict verdict = Verdict::kNotShown;
    for (; i < result.claims.size() && result.claims[i].ruling == ruling; ++i) {
      const Verdict now = result.claims[i].verdict;
      if (now == Verdict::kContradicted || verdict == Verdict::kNotShown) verdict = now;
    }
    ++counts.at(static_cast<std::size_t>(verdict));
  }
  return counts;
}

std::string summary(const Result& result) {
  const auto [confirmed, contradicted, hidden] = counted(result);
  std::size_t other = 0;
  for (const ParameterResult& each : result.parameters)
    if (each.verdict == Verdict::kContradicted) ++other;
  return fmt::format(
      "{} rulings confirmed, {} contradicted, {} not shown; {} of {} parameters differ from their default", confirmed,
      contradicted, hidden, other, result.parameters.size());
}

nlohmann::ordered_json clock_json(const Estimate& clock) {
  if (clock.count == 0) return nullptr;
  return {{"ppm_lo", ppm(clock.span.lo)}, {"ppm_hi", ppm(clock.span.hi)}};
}

nlohmann::ordered_json parameter_json(const ParameterResult& each) {
  nlohmann::ordered_json json = {
      {"parameter", each.row->key},    {"ruling", each.row->ruling},        {"default", each.usual},
      {"unit", each.field->type.unit}, {"measured_by", each.row->measured}, {"verdict", word(each.verdict)}};
  if (each.verdict == Verdict::kNotShown) {
    json["why"] = each.words;
    return json;
  }
  json["lo"] = each.fit.at_most ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(each.fit.estimate.span.lo);
  json["hi"] = each.fit.at_least ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(each.fit.estimate.span.hi);
  json["value"] = each.value ? nlohmann::ordered_json(*each.value) : nlohmann::ordered_json(nullptr);
  json["by_mean"] = each.fit.estimate.by_mean;
  json["times"] = each.fit.estimate.count;
  json["others"] = nlohmann::ordered_json::array();
  for (const Outlier& outlier : each.fit.estimate.outliers) {
    if (json["others"].size() >= kMostTold) break;
    json["others"].push_back({{"us", microseconds(outlier.at)}, {"by", outlier.by}});
  }
  return json;
}

nlohmann::ordered_json claim_json(const ClaimResult& claim) {
  nlohmann::ordered_json json = {{"ruling", claim.ruling},
                                 {"claim", claim.says},
                                 {"verdict", word(claim.verdict)},
                                 {"times", claim.tally.holds},
                                 {"against", claim.tally.fails}};
  if (claim.verdict == Verdict::kNotShown) json["why"] = claim.words;
  json["contradictions"] = nlohmann::ordered_json::array();
  for (const Contradiction& each : claim.tally.contradictions)
    json["contradictions"].push_back({{"us", microseconds(each.at)}, {"how", each.how}});
  return json;
}

}  // namespace

std::string text(const Result& result, bool all) {
  std::string text =
      line("capture", fmt::format("{}: {} pins, {}", result.file, result.wires.size(), bus::moment_text(result.end)));
  text += line("pins", wires_text(*result.table, result.wires));
  text += line("samples", fmt::format("every {:.3f} ns{}, jitter up to {:.1f} ns", result.sample_ns,
                                      result.rate_found ? " (by the times of the changes)" : "", result.jitter_ns));
  text += line("chip's clock", ppm_text(result.found.clock));
  text += line("master's clock", ppm_text(result.found.master_clock));
  text += line("seen",
               fmt::format("{} requests, {} answers, {} accesses of the chip, {} of the user", result.found.requests,
                           result.found.answers, result.found.accesses, result.found.user_accesses));
  text += "\n" + parameter_table(result) + "\n" + claim_table(result, all) + "\n" + (all ? hidden_text(result) : "") +
          summary(result) + "\n";
  return text;
}

std::string json(const Result& result) {
  nlohmann::ordered_json json = {{"file", result.file},
                                 {"agrees", result.agrees()},
                                 {"sample_ns", result.sample_ns},
                                 {"jitter_ns", result.jitter_ns},
                                 {"pins", result.wires}};
  json["chip_clock"] = clock_json(result.found.clock);
  json["master_clock"] = clock_json(result.found.master_clock);
  json["parameters"] = nlohmann::ordered_json::array();
  for (const ParameterResult& each : result.parameters) json["parameters"].push_back(parameter_json(each));
  json["rulings"] = nlohmann::ordered_json::array();
  for (const ClaimResult& claim : result.claims) json["rulings"].push_back(claim_json(claim));
  return json.dump(2) + "\n";
}

std::string chip_block(const Result& result) {
  std::string text = "# The parameters of the chip as dsdpv1-sim calibrate has measured them, for a scenario.\nchip:\n";
  bool any = false;
  for (const ParameterResult& each : result.parameters) {
    const bool shown = each.verdict != Verdict::kNotShown;
    any = any || shown;
    text += fmt::format("  {}{}: {}  # {} {}\n", shown ? "" : "# ", each.row->key, each.chosen, each.row->ruling,
                        shown ? "measured: " + each.words : "not shown: " + each.words);
  }
  return any ? text : text + "  {}\n";
}

}  // namespace dsdpv1::calibrate
