#include "tb/report/result_json.hpp"

#include <nlohmann/json.hpp>

#include "bus/time.hpp"
#include "io/input/units.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/report/result_schema.hpp"

namespace dsdpv1::tb {
namespace {

using Json = nlohmann::ordered_json;

/// Nanoseconds as a number: whole where they are whole.
Json nanoseconds_of(Tick tick) {
  if (tick % bus::kTicksPerNs == 0) return tick / bus::kTicksPerNs;
  return static_cast<double>(tick) / static_cast<double>(bus::kTicksPerNs);
}

Json tsdr_of(const SlaveResult& slave) {
  if (slave.tsdr.answers == 0) return nullptr;
  return {{"answers", slave.tsdr.answers}, {"min_bits", slave.tsdr.min_bits}, {"max_bits", slave.tsdr.max_bits}};
}

Json handshake_of(const SlaveResult& slave) {
  return {{"chip_accesses", slave.status.accesses},
          {"chip_longest_wait_ns", nanoseconds_of(slave.status.longest_wait)},
          {"user_holds", slave.user.port.holds},
          {"user_given_up", slave.user.port.given_up},
          {"user_longest_wait_ns", nanoseconds_of(slave.user.port.longest_wait)},
          {"user_longest_hold_ns", nanoseconds_of(slave.user.port.longest_hold)}};
}

Json user_of(const SlaveResult& slave) {
  using Counters = user_cpu::ProgramCounters;
  const std::optional<Counters>& program = slave.user.program;
  const auto count = [&program](std::uint64_t Counters::*which) { return program ? Json((*program).*which) : Json(); };
  return {
      {"exchanges", count(&Counters::exchanges)},           {"outputs_received", count(&Counters::outputs_received)},
      {"inputs_written", count(&Counters::inputs_written)}, {"judgements", count(&Counters::judgements)},
      {"driver_errors", count(&Counters::driver_errors)},   {"bad_reads", slave.user.cpu.bad_reads}};
}

Json board_of(const user_cpu::BoardReport& board) {
  return {{"instructions", board.instructions},
          {"hclk_cycles", board.cycles},
          {"hclk_hz", board.hclk_hz},
          {"hclk_source", board.hclk_source},
          {"notes", board.notes}};
}

Json registry_of(const profibus::RmRegistry& registry) {
  Json rows = Json::array();
  int sap = profibus::kC2FirstSap;
  for (const profibus::RmEntry& entry : registry)
    rows.push_back({{"sap", sap--},
                    {"master", entry.in_use ? Json(entry.master) : Json(nullptr)},
                    {"in_use", entry.in_use},
                    {"connected", entry.connected},
                    {"exchanging", entry.exchanging}});
  return rows;
}

Json slave_of(const SlaveResult& slave) {
  Json json;
  json["name"] = slave.name;
  json["address"] = slave.status.address;
  json["dp_state"] = name(slave.status.dp_state);
  json["baud"] = baud_text(slave.status.baud);
  json["master"] = slave.status.master == 255 ? Json(nullptr) : Json(slave.status.master);
  json["data_exchanges"] = slave.status.data_exchanges;
  json["outputs_overwritten"] = slave.status.outputs_missed;
  json["rm_registry"] = registry_of(slave.status.c2);
  json["telegrams_received"] = slave.status.telegrams_received;
  json["telegrams_answered"] = slave.status.telegrams_answered;
  json["tsdr"] = tsdr_of(slave);
  json["handshake"] = handshake_of(slave);
  json["user_cpu"] = user_of(slave);
  if (slave.board) json["arm_board"] = board_of(*slave.board);
  json["master_state"] = slave.master_state;
  json["master_reason"] = slave.master_reason;
  json["waits_for"] = slave.waits_for;
  json["inputs"] = bytes_text(slave.inputs, slave.inputs.size());
  json["outputs"] = slave.outputs ? Json(bytes_text(*slave.outputs, slave.outputs->size())) : Json();
  return json;
}

Json pacing_of(const Pacing& pacing) {
  return {{"port", pacing.port},
          {"telegrams_from_host", pacing.telegrams_from_host},
          {"bytes_from_host", pacing.bytes_from_host},
          {"bytes_to_host", pacing.bytes_to_host},
          {"held_back", pacing.held_back},
          {"longest_held_back_ns", nanoseconds_of(pacing.longest_held_back)},
          {"error_mean_us", pacing.error_mean_us},
          {"error_max_us", pacing.error_max_us},
          {"times_too_slow", pacing.losses},
          {"time_lost_ns", nanoseconds_of(pacing.lost)}};
}

Json lockstep_of(const LockstepResult& lockstep) {
  Json json = {{"cycles", lockstep.cycles},
               {"pin_changes", lockstep.pin_changes},
               {"dpram_images", lockstep.dpram_images},
               {"difference", nullptr}};
  if (const std::optional<LockstepResult::Difference>& found = lockstep.difference)
    json["difference"] = {{"slave", found->slave},
                          {"at_ns", nanoseconds_of(found->at)},
                          {"what", found->what},
                          {"last_telegram", found->last_telegram},
                          {"last_access", found->last_access},
                          {"dpram", found->dpram}};
  return json;
}

Json history_of(const checks::Violation& violation) {
  Json changes = Json::array();
  for (const checks::PinChange& change : violation.history)
    changes.push_back({{"at_ns", nanoseconds_of(change.at)},
                       {"pin", change.pin->name},
                       {"level", level_text(*change.pin, change.level)}});
  return changes;
}

Json histogram_of(const checks::Histogram& histogram) {
  Json bins = Json::array();
  for (std::size_t bin = 0; bin < checks::Histogram::kBins; ++bin) {
    if (histogram.count(bin) == 0) continue;
    const Tick from = checks::Histogram::from(bin), to = checks::Histogram::to(bin);
    bins.push_back({{"from_ns", from == -bus::kNever ? Json(nullptr) : nanoseconds_of(from)},
                    {"to_ns", to == bus::kNever ? Json(nullptr) : nanoseconds_of(to)},
                    {"count", histogram.count(bin)}});
  }
  return bins;
}

Json check_of(const CheckResult& result) {
  const checks::Rule& rule = *result.rule;
  const auto time = [](const std::optional<Tick>& tick) { return tick ? nanoseconds_of(*tick) : Json(nullptr); };
  const bool limited = rule.bound != checks::Bound::kRule && result.limit.value != checks::kNoLimit;
  Json json = {{"id", rule.id},
               {"slave", result.slave},
               {"rule", rule.rule},
               {"clause", rule.clause},
               {"limit_ns", limited ? nanoseconds_of(result.limit.value) : Json(nullptr)},
               {"count", result.record.count},
               {"violations", result.record.violations},
               {"allowed", result.allowed},
               {"worst_margin_ns", time(result.record.worst_margin)},
               {"worst_value_ns", time(result.record.worst_value)},
               {"at_ns", time(result.record.at)},
               {"histogram", histogram_of(result.record.histogram)},
               {"listed", Json::array()}};
  for (const checks::Violation& each : result.listed)
    json["listed"].push_back({{"at_ns", nanoseconds_of(each.at)},
                              {"margin_ns", time(each.margin)},
                              {"text", each.text},
                              {"history", history_of(each)}});
  return json;
}

Json event_of(const Occurrence& occurrence) {
  return {{"at_ns", nanoseconds_of(occurrence.at)}, {"slave", occurrence.station},   {"code", occurrence.code},
          {"severity", name(occurrence.severity)},  {"allowed", occurrence.allowed}, {"text", occurrence.text}};
}

Json master_of(const MasterResult& master) {
  const Json of_slaves = master.min_slave_interval_us == 0 ? Json(nullptr) : Json("gsd");
  return {{"name", master.name},
          {"address", master.address},
          {"cycles", master.cycles},
          {"min_slave_interval_us", master.min_slave_interval_us},
          {"min_slave_interval_from", master.interval_given ? Json("scenario") : of_slaves}};
}

Json refused_of(const Repeated& refused) {
  return {{"slave", refused.station},
          {"code", refused.code},
          {"count", refused.count},
          {"first_ns", nanoseconds_of(refused.first)},
          {"last_ns", nanoseconds_of(refused.last)},
          {"text", refused.text}};
}

Json violated_of(const Repeated& violated) {
  Json json = refused_of(violated);
  json["place"] = violated.place;
  json["allowed"] = violated.allowed;
  return json;
}

}  // namespace

std::string result_json(const RunResult& result) {
  Json json = {{"schema", kResultSchema}, {"version", kResultVersion}};
  json["scenario"] = result.scenario;
  json["file"] = result.file;
  json["passed"] = verdict(result) == Verdict::kPassed;
  json["verdict"] = name(verdict(result));
  json["verdict_text"] = words(result);
  json["interrupted"] = result.interrupted;
  json["engine"] = result.engine;
  json["view"] = result.view;
  json["simulated_ns"] = nanoseconds_of(result.simulated);
  json["chip_cycles"] = result.simulated / profibus::kTicksPerCycle * static_cast<Tick>(result.slaves.size());
  json["wall_s"] = result.wall_s;
  json["real_time_factor"] = result.real_time_factor();
  json["telegrams"] = result.telegrams;
  json["wrong_telegrams"] = result.wrong_telegrams;
  json["violations"] = result.violations;
  json["checks_mode"] = name(result.checks_mode);
  json["violations_not_judged"] = violations_not_judged(result);
  if (result.pacing) json["pacing"] = pacing_of(*result.pacing);
  if (result.lockstep) json["lockstep"] = lockstep_of(*result.lockstep);
  json["masters"] = Json::array();
  for (const MasterResult& master : result.masters) json["masters"].push_back(master_of(master));
  json["slaves"] = Json::array();
  for (const SlaveResult& slave : result.slaves) json["slaves"].push_back(slave_of(slave));
  json["expectations"] = Json::array();
  for (const ExpectationResult& each : result.expectations) {
    json["expectations"].push_back({{"text", each.text},
                                    {"line", each.line},
                                    {"passed", each.left_out ? Json() : Json(each.passed)},
                                    {"seen", each.seen},
                                    {"implied", each.implied}});
  }
  json["checks"] = Json::array();
  for (const CheckResult& each : result.checks) json["checks"].push_back(check_of(each));
  json["refused"] = Json::array();
  for (const Repeated& each : result.refused) json["refused"].push_back(refused_of(each));
  json["violated"] = Json::array();
  for (const Repeated& each : result.violated) json["violated"].push_back(violated_of(each));
  json["events"] = Json::array();
  for (const Occurrence& each : result.occurrences) json["events"].push_back(event_of(each));
  json["events_dropped"] = result.occurrences_dropped;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dsdpv1::tb
