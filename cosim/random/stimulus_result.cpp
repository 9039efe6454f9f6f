#include "cosim/random/stimulus_result.hpp"

#include <nlohmann/json.hpp>

#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1::cosim {
namespace {

using Json = nlohmann::ordered_json;

Json difference_of(const Difference& difference) {
  return {{"cycle", difference.at / profibus::kTicksPerCycle},
          {"time_ns", static_cast<double>(difference.at) / static_cast<double>(bus::kTicksPerNs)},
          {"what", difference.what},
          {"last_telegram", difference.last_telegram},
          {"last_access", difference.last_access},
          {"dpram", difference.dpram_accesses}};
}

Json case_of(const StimulusResult& result) {
  return {
      {"number", result.cases}, {"seed", result.case_seed}, {"stimulus", result.stimulus}, {"actions", result.actions}};
}

Json coverage_of(const Coverage& coverage) {
  Json telegrams = Json::object(), codes = Json::object();
  for (const auto& [name, count] : coverage.telegrams()) telegrams[name] = count;
  for (const profibus::Reason reason : dsdpv1::reasons()) codes[profibus::code(reason)] = coverage.count(reason);
  return {{"telegrams", telegrams}, {"codes", codes}};
}

/// Each group with its situations, those that did not occur, too.
Json situations_of(const StimulusResult& result) {
  Json groups = Json::object();
  for (const Situation& each : known_situations(result.side))
    groups[each.first][each.second] = result.situations.of(each);
  for (const auto& [each, times] : result.situations.counts()) groups[each.first][each.second] = times;
  return groups;
}

}  // namespace

std::string result_json(const StimulusResult& result) {
  const bool random = result.replayed.empty();
  Json json = {{"schema", kStimulusResultSchema}, {"version", kStimulusResultVersion}};
  json["verdict"] = result.difference ? "different" : "same";
  json["rtl"] = result.rtl.empty() ? Json() : Json(result.rtl);
  json["fault"] = result.fault == 0 ? Json() : Json(result.fault);
  json["seed"] = result.seed;
  json["replayed"] = random ? Json() : Json(result.replayed);
  json["cases"] = random ? Json(result.cases) : Json();
  json["cycles"] = result.counts.cycles;
  json["pin_changes"] = result.counts.pin_changes;
  json["dpram_images"] = result.counts.dpram_images;
  json["case"] = random && result.difference ? case_of(result) : Json();
  json["difference"] = result.difference ? difference_of(*result.difference) : Json();
  json["coverage"] = coverage_of(result.coverage);
  json["coverage"]["situations"] = random ? situations_of(result) : Json();
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dsdpv1::cosim
