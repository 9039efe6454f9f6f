#include "cosim/random/stimulus_result.hpp"

#include <map>

#include "cosim/random/ruling_coverage.hpp"
#include "tb/report/fields.hpp"
#include "tb/report/result_fields.hpp"

namespace dsdpv1::cosim {
namespace {

using tb::Fields;
using tb::only_if;
using Json = Fields::Json;

constexpr const char* kSchema = "dsdpv1-sim rtl-random";

bool is_random(const StimulusResult& result) { return result.replayed.empty(); }

void case_fields(Fields& out, const StimulusResult& result) {
  out.field("number", result.cases, "its number, from 1");
  out.field("seed", result.case_seed, "from which alone it is generated");
  out.field("stimulus", result.stimulus, "the file of the shortened case");
  out.field("actions", result.actions, "in that file");
}

void timed_difference_fields(Fields& out, const Difference& difference) {
  const double ns = static_cast<double>(difference.at) / static_cast<double>(bus::kTicksPerNs);
  out.field("cycle", difference.at / profibus::kTicksPerCycle, "of 48 MHz, when");
  out.field("time_ns", ns, "when");
  tb::difference_fields(out, difference);
}

Json telegrams_of(const Coverage& coverage) {
  Json telegrams = Json::object();
  for (const auto& [name, count] : coverage.telegrams()) telegrams[name] = count;
  return telegrams;
}

Json codes_of(const StimulusResult& result) {
  Json codes = Json::object();
  for (const profibus::Reason reason : result.kind->reasons())
    codes[profibus::code(reason)] = result.coverage.count(reason);
  return codes;
}

/// Each group with its situations, including those that did not occur.
Json situations_of(const StimulusResult& result) {
  Json groups = Json::object();
  for (const Situation& each : result.known) groups[each.first][each.second] = result.situations.of(each);
  for (const auto& [each, times] : result.situations.counts()) groups[each.first][each.second] = times;
  return groups;
}

/// The rulings of the events and situations that occurred.
Json rulings_of(const StimulusResult& result) {
  Seen seen{{}, result.situations, result.mode};
  for (const profibus::Reason reason : result.kind->reasons())
    seen.codes[profibus::code(reason)] = result.coverage.count(reason);
  RulingCoverage coverage(*result.kind, result.documents);
  coverage.add(0, seen);
  std::map<std::string, std::uint64_t> counts;
  for (const RulingCoverage::Ruling& each : coverage.rulings())
    if (each.count() != 0) counts[each.name] = each.count();
  Json rulings = Json::object();
  for (const auto& [name, times] : counts) rulings[name] = times;
  return rulings;
}

void coverage_fields(Fields& out, const StimulusResult& result) {
  out.counts("telegrams", telegrams_of(result.coverage), "how many", "each kind, with its count");
  out.counts("codes", codes_of(result), "how often", "each code of docs/reasons.md, with its count");
  out.counts("rulings", rulings_of(result), "how often",
             "each ruling that an event names or that decides a situation, with their count");
  out.groups("situations", is_random(result) ? situations_of(result) : Json(), "how often",
             "each situation, with its count",
             "each group: states, services, events, situations at the host port; null: `--replay`");
}

void stimulus_fields(Fields& out, const StimulusResult& result) {
  const bool random = is_random(result);
  out.constant("schema", kSchema, "what this file is");
  out.constant("version", "1.2", "of the contents");
  out.word("verdict", result.difference ? "different" : "same", {"same", "different"}, "model and RTL");
  out.field("chip", result.kind->name(), "its kind, as in scenarios");
  out.field("rtl", only_if(!result.rtl.empty(), result.rtl), "the folder of `--rtl`; null: the reference RTL");
  out.field("fault", only_if(result.fault != 0, result.fault), "the number of `--fault`; null: none");
  out.field("seed", result.seed, "of the random cases, and of the reference RTL's initial values");
  out.field("replayed", only_if(!random, result.replayed), "the stimulus of `--replay`; null: random cases");
  out.field("cases", only_if(random, result.cases),
            "random cases, up to and including the one that differs; null: `--replay`");
  out.field("cycles", result.counts.cycles, "compared and equal");
  out.field("pin_changes", result.counts.pin_changes, "compared and equal");
  out.field("dpram_images", result.counts.dpram_images, "compared and equal");
  out.object_or_null("case", random && result.difference ? &result : nullptr, case_fields,
                     "the random case that differs; null: none, or `--replay`");
  out.object_or_null("difference", result.difference, timed_difference_fields,
                     "the first difference when the stimulus file is played; null: none");
  out.object("coverage", result, coverage_fields, "what occurred");
}

Json described() {
  return Fields::described(stimulus_fields, "what came of random cases, or of a stimulus that was played");
}

}  // namespace

std::string result_json(const StimulusResult& result) {
  return tb::json_file(Fields::written(result, stimulus_fields));
}

std::string stimulus_result_schema() { return tb::schema_file(kSchema, described()); }

std::string stimulus_result_table() { return tb::schema_table(described()); }

}  // namespace dsdpv1::cosim
