#include "tb/report/result_fields.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "io/input/units.hpp"
#include "tb/bench/ruling_place.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/report/fields.hpp"

namespace dsdpv1::tb {
namespace {

constexpr const char* kSchema = "dsdpv1-sim result";  // the member "schema"
constexpr const char* kVersion = "1.4";               // "version": when it changes says docs/result.md

void pacing_fields(Fields& out, const Pacing& pacing) {
  const auto& [port, line, pace] = pacing;
  out.field("port", port, "place of the host: the pseudo-terminal, TCP port or serial port");
  out.field("telegrams_from_host", line.telegrams, "telegrams that came from it");
  out.field("bytes_from_host", line.sent_bytes, "bytes that came from it");
  out.field("bytes_to_host", line.heard_bytes, "bytes that went to it");
  out.field("held_back", line.held_back, "its telegrams that came before T_SYN or the slot time had ended");
  out.time("longest_held_back_ns", line.longest_held_back, "the longest delay");
  out.field("error_mean_us", pace.error_mean_us(), "real minus simulated time, on average");
  out.field("error_max_us", pace.error_max_us, "real minus simulated time at most");
  out.field("times_too_slow", pace.losses, "how often the computer was too slow");
  out.time("time_lost_ns", pace.lost, "simulated time given up because of that");
}

void slave_difference_fields(Fields& out, const LockstepDifference& difference) {
  out.field("slave", difference.slave, "at which");
  out.time("at_ns", difference.at, "when");
  difference_fields(out, difference);
}

void lockstep_fields(Fields& out, const LockstepResult& lockstep) {
  out.field("cycles", lockstep.cycles, "that were compared");
  out.field("pin_changes", lockstep.pin_changes, "that both sides made");
  out.field("dpram_images", lockstep.dpram_images, "of the DPRAM that were compared");
  out.object_or_null("difference", lockstep.difference, slave_difference_fields,
                     "the first difference; null: model and RTL are the same");
}

void master_fields(Fields& out, const MasterResult& master) {
  const bool waits = master.interval_given || master.min_slave_interval_us != 0;
  out.field("name", master.name, "of the scenario");
  out.field("address", master.address, "0 to 126");
  out.field("cycles", master.cycles, "data cycles");
  out.field("min_slave_interval_us", master.min_slave_interval_us, "least time of a data cycle");
  out.field("min_slave_interval_from", only_if(waits, master.interval_given ? "scenario" : "gsd"),
            R"("scenario", "gsd", or null when it is 0)");
}

/// A channel of MSAC_C2.
struct Channel {
  int sap = 0;
  profibus::RmEntry entry;
};

std::vector<Channel> channels_of(const profibus::RmRegistry& registry) {
  std::vector<Channel> channels;
  int sap = profibus::kC2FirstSap;
  for (const profibus::RmEntry& entry : registry) channels.push_back({sap--, entry});
  return channels;
}

void channel_fields(Fields& out, const Channel& channel) {
  const profibus::RmEntry& entry = channel.entry;
  out.field("sap", channel.sap, "of the channel");
  out.field("master", only_if(entry.in_use, entry.master), "address of the master that has it");
  out.field("in_use", entry.in_use, "a master has it");
  out.field("connected", entry.connected, "its connection is open");
  out.field("exchanging", entry.exchanging, "it has a request in progress");
}

void tsdr_fields(Fields& out, const Tsdr& tsdr) {
  out.field("answers", tsdr.answers, "how many were measured");
  out.field("min_bits", tsdr.min_bits, "bit times, the least");
  out.field("max_bits", tsdr.max_bits, "bit times, the most");
}

void handshake_fields(Fields& out, const SlaveResult& slave) {
  const user_cpu::HoldCounters& user = slave.user.port;
  out.field("chip_accesses", slave.status.accesses, "of the chip to the DPRAM");
  out.time("chip_longest_wait_ns", slave.status.longest_wait, "for the user to release it");
  out.field("user_holds", user.holds, "how often the user had the DPRAM");
  out.field("user_given_up", user.given_up, "how often the user gave up waiting for it");
  out.time("user_longest_wait_ns", user.longest_wait, "for the chip to give it");
  out.time("user_longest_hold_ns", user.longest_hold, "longest hold of the user");
}

void user_fields(Fields& out, const user_cpu::UserCounters& user) {
  const auto count = [&](const char* name, std::uint64_t user_cpu::ProgramCounters::*which, const char* doc) {
    out.field(name, user.program ? std::optional((*user.program).*which) : std::nullopt, doc);
  };
  using Counters = user_cpu::ProgramCounters;
  count("exchanges", &Counters::exchanges, "data exchanges that its program has seen; null: unknown");
  count("outputs_received", &Counters::outputs_received, "outputs that it has fetched");
  count("inputs_written", &Counters::inputs_written, "inputs that it has written");
  count("judgements", &Counters::judgements, "parameters and configurations that it has judged");
  count("driver_errors", &Counters::driver_errors, "errors that the driver has returned");
  out.field("bad_reads", user.cpu.bad_reads, "reads before the chip had put its data out");
}

void board_fields(Fields& out, const user_cpu::BoardReport& board) {
  out.field("instructions", board.instructions, "carried out");
  out.field("hclk_cycles", board.cycles, "of the processor's clock");
  out.field("hclk_hz", board.hclk_hz, "its rate at the end");
  out.field("hclk_source", board.hclk_source, "source of that clock");
  out.texts("notes", board.notes, "a line", "remarks on the firmware");
}

void socket_fields(Fields& out, const SocketUse& use) {
  out.field("accesses", use.accesses, "of its user through the socket, a byte each");
  out.field("failed", use.failed, "of these, without TLM_OK_RESPONSE");
  out.field("ahead", use.ahead, "of these, carried out ahead of simulation time");
  out.time("furthest_ahead_ns", use.furthest, "most that one was ahead when it ended");
  out.field("late_pins", use.late_pins, "changes of pins that its user moves, before accesses already carried out");
}

std::string hexadecimal(const bus::Bytes& bytes) { return bytes_text(bytes, bytes.size()); }

void slave_fields(Fields& out, const SlaveResult& slave) {
  const ChipStatus& status = slave.status;
  out.field("name", slave.name, "of the scenario");
  out.field("address", status.address, "0 to 126");
  out.word("dp_state", name(status.dp_state), {"OFFLINE", "WAIT_PRM", "WAIT_CFG", "DATA_EXCH"}, "at the end");
  out.field("baud", baud_text(status.baud), R"(the rate it has found: "12M" to "9.6k", or "searching")");
  out.field("master", only_if(status.master != 255, status.master), "address of the master that holds it");
  out.field("data_exchanges", status.data_exchanges, "how many the chip has had");
  out.field("outputs_overwritten", status.outputs_missed, "outputs that were replaced before the user fetched them");
  out.list("rm_registry", channels_of(status.c2), channel_fields, "a channel", "the resource manager of MSAC_C2");
  out.field("telegrams_received", status.telegrams_received, "for this station");
  out.field("telegrams_answered", status.telegrams_answered, "by this station");
  out.object_or_null("tsdr", slave.tsdr.answers == 0 ? nullptr : &slave.tsdr, tsdr_fields,
                     "from the end of a request to the start of the answer; null without an answer");
  out.object("handshake", slave, handshake_fields, "use of the DPRAM");
  out.object("user_cpu", slave.user, user_fields, "the user CPU and its program");
  out.object_if("socket", slave.socket, socket_fields, "of a chip in a SystemC platform");
  out.object_if("arm_board", slave.board, board_fields, "of a slave whose user_cpu has kind: arm");
  out.field("master_state", slave.master_state, "its state at its master; empty without one");
  out.field("master_reason", slave.master_reason, "the reason for that state");
  out.field("waits_for", slave.waits_for, "if not in data exchange: the chip's reason, and what to do; else empty");
  out.field("inputs", hexadecimal(slave.inputs), "at the end, bytes in hexadecimal");
  out.field("outputs", only_if(slave.outputs.has_value(), hexadecimal(slave.outputs.value_or(bus::Bytes()))),
            "at the end, bytes in hexadecimal; null: unknown");
}

void expectation_fields(Fields& out, const ExpectationResult& expectation) {
  out.field("text", expectation.text, "in words");
  out.field("line", expectation.line, "its line in the scenario");
  out.field("passed", only_if(!expectation.left_out, expectation.passed),
            "null: not judged, because firmware does not report it, or the script keeps the slave away");
  out.field("seen", expectation.seen, "what was seen");
  out.field("implied", expectation.implied, "by a master that has the slave: data exchange, to the end");
}

/// A class of margins, ticks.
struct Bin {
  Tick from = 0, to = 0;
  std::uint64_t count = 0;
};

std::vector<Bin> bins_of(const checks::Histogram& histogram) {
  using checks::Histogram;
  std::vector<Bin> bins;
  for (std::size_t bin = 0; bin < Histogram::kBins; ++bin)
    if (histogram.count(bin) != 0) bins.push_back({Histogram::from(bin), Histogram::to(bin), histogram.count(bin)});
  return bins;
}

void bin_fields(Fields& out, const Bin& bin) {
  out.time("from_ns", only_if(bin.from != -bus::kNever, bin.from), "null: without end");
  out.time("to_ns", only_if(bin.to != bus::kNever, bin.to), "null: without end");
  out.field("count", bin.count, "of margins in between");
}

void change_fields(Fields& out, const checks::PinChange& change) {
  const PinInfo pin = change.pin != nullptr ? *change.pin : PinInfo();
  out.time("at_ns", change.at, "when");
  out.field("pin", pin.name, "its name");
  out.field("level", level_text(pin, change.level), "its new level");
}

void place_fields(Fields& out, const user_cpu::Place& place) {
  out.field("file", place.file, "of the source, without folders; empty: not known");
  out.field("line", place.line, "of the file; 0: not known");
  out.field("function", place.function, "its name; empty: not known");
  out.field("pc", fmt::format("0x{:08X}", place.pc), "address of the instruction, of a process in its file");
  out.time("stayed_ns", place.stayed, "of an omission: how long the program was in the function meanwhile; else null");
}

constexpr const char* kWhere = "the user's act that caused it, in its program; null: not known";

void violation_fields(Fields& out, const checks::Violation& violation) {
  out.time("at_ns", violation.at, "when");
  out.time("margin_ns", violation.margin, "negative: distance beyond the limit");
  out.field("text", violation.text, "in words");
  out.list("history", violation.history, change_fields, "a change of a pin", "the pins before it");
  out.object_or_null("where", violation.where, place_fields, kWhere);
}

void check_fields(Fields& out, const CheckResult& check) {
  const checks::Rule rule = check.rule != nullptr ? *check.rule : checks::Rule();
  const bool limited = rule.bound != checks::Bound::kRule && check.limit.value != checks::kNoLimit;
  const bool counts = rule.bound == checks::Bound::kMost;
  out.field("id", rule.id, "of docs/checks.md");
  out.field("slave", check.slave, "at which");
  out.field("rule", rule.rule, "in words");
  out.field("clause", rule.clause, "its source");
  out.time("limit_ns", only_if(limited && !counts, check.limit.value), "null: the rule has none");
  out.field("limit_number", only_if(limited && counts, check.limit.value), "of a rule about a number; null: of others");
  out.field("count", check.record.count, "number of evaluations");
  out.field("violations", check.record.violations, "number of violations");
  out.field("allowed", check.allowed, "violations that the scenario allows");
  out.time("worst_margin_ns", check.record.worst_margin, "negative: violated");
  out.time("worst_value_ns", counts ? std::nullopt : check.record.worst_value, "the time measured there");
  out.field("worst_number", counts ? check.record.worst_value : std::nullopt, "of a rule about a number: the greatest");
  out.time("at_ns", check.record.at, "time of the worst margin");
  out.list("histogram", bins_of(check.record.histogram), bin_fields, "a class of margins that is not empty",
           "distribution of the margins");
  out.list("listed", check.listed, violation_fields, "a violation", "the first 20 violations");
}

void refused_fields(Fields& out, const Repeated& refused) {
  out.field("slave", refused.station, "at which");
  out.field("code", refused.code, "of docs/reasons.md");
  out.field("count", refused.count, "how often");
  out.time("first_ns", refused.first, "the first time");
  out.time("last_ns", refused.last, "the last time");
  out.field("text", refused.text, "in words, of the first time");
  out.object_or_null("where", refused.where, place_fields, "of the first time: as `checks[].listed[].where`");
}

void violated_fields(Fields& out, const Repeated& violated) {
  refused_fields(out, violated);
  out.field("place", violated.place, "the cell concerned; empty: none");
  out.field("allowed", violated.allowed, "the scenario allows it");
}

void event_fields(Fields& out, const Occurrence& event) {
  out.time("at_ns", event.at, "when");
  out.field("slave", event.station, "at which; \"bus\": the bus monitor");
  out.field("code", event.code, "of docs/reasons.md");
  out.word("severity", name(event.severity), {"info", "refusal", "violation"}, "kind of event");
  out.field("allowed", event.allowed, "a violation that the scenario allows");
  out.field("text", event.text, "in words");
  out.object_or_null("where", event.where, place_fields, kWhere);
}

void run_fields(Fields& out, const RunResult& result) {
  const auto chips = static_cast<Tick>(result.slaves.size());
  out.constant("schema", kSchema, "kind of this file");
  out.constant("version", kVersion, "version of its content");
  out.field("scenario", result.scenario, "its name");
  out.field("file", result.file, "path of its file");
  out.field("passed", verdict(result) == Verdict::kPassed, "`verdict` is passed");
  out.word("verdict", name(verdict(result)), {"passed", "failed", "nothing_judged", "interrupted"},
           "passed: all expectations were met, nothing was violated that is not allowed, no RTL differed; "
           "nothing_judged: no data exchange, and nothing was expected");
  out.field("verdict_text", words(result), "the last line of the table: the verdict, and what was not judged");
  out.field("interrupted", result.interrupted, "a signal ended it early");
  out.field("engine", result.engine, "step, skip, rtl, lockstep");
  out.field("view", result.view, "pins, tlm");
  out.time("simulated_ns", result.simulated, "simulated time");
  out.field("chip_cycles", result.simulated / profibus::kTicksPerCycle * chips, "of all chips together");
  out.field("wall_s", result.wall_s, "duration in real time");
  out.field("real_time_factor", result.real_time_factor(), "simulated time divided by that; 0: not measured");
  out.field("telegrams", result.telegrams, "on the line");
  out.field("wrong_telegrams", result.wrong_telegrams, "those with an error");
  out.field("violations", result.violations, "that the scenario does not allow; of checks in checks_mode fail only");
  out.word("checks_mode", name(result.checks_mode), {"fail", "report", "off"}, "effect of violations that checks find");
  out.field("violations_not_judged", violations_not_judged(result),
            "of checks in checks_mode report; of the host, without --strict");
  out.object_if("pacing", result.pacing, pacing_fields, "serve only: how well the run kept real time");
  out.object_if("lockstep", result.lockstep, lockstep_fields, "engine lockstep only: model and RTL side by side");
  out.list("masters", result.masters, master_fields, "a master of class 1", "of class 1");
  out.list("slaves", result.slaves, slave_fields, "a slave at the end of the run", "in the order of the scenario");
  out.list("expectations", result.expectations, expectation_fields, "an expectation",
           "in the order of the scenario, then the implied ones");
  out.list("checks", result.checks, check_fields, "a check on one slave", "empty in checks_mode off");
  out.list("refused", result.refused, refused_fields, "refusals with one reason", "by the first time");
  out.list("violated", result.violated, violated_fields, "violations of one kind at one place, without those of checks",
           "by the first time");
  out.list("events", result.occurrences, event_fields, "an event", "the first 10 000, in order of time");
  out.field("events_dropped", result.occurrences_dropped, "events beyond those");
}

Fields::Json described() { return Fields::described(run_fields, "the result of a run"); }

constexpr const char* kPage = R"(# The result of a run

Written by `dsdpv1-sim schema --result --markdown`, do not edit. `dsdpv1-sim run --result FILE` (and `serve`, and `regress` for the runs that it keeps) writes one JSON object.
`dsdpv1-sim schema --result` prints its JSON Schema (draft 2020-12):

```
dsdpv1-sim run scenarios/watchdog.yaml --result watchdog.json
dsdpv1-sim schema --result > result.schema.json
check-jsonschema --schemafile result.schema.json watchdog.json
```

## Version

`schema` names the kind of file, `version` its version; this page is about {version}. The schema is exact: it lists all members of a result of its version, and any other member is wrong.

- A new member, or a new word where a member has one of several, changes the second number. Programs that look up members by name need not change.
- Removing a member or changing its name, type, unit or meaning changes the first number.
- Texts (`text`, `seen`, `rule`, `notes`) are for people and may change with every version of the program; `code` and `id` do not.

Times that end in `_ns` are nanoseconds from the start of the run: whole numbers where they are whole. The results of a scenario with all engines and views are the same except `engine`, `view`, `wall_s` and `real_time_factor`.

## Members

)";

}  // namespace

void difference_fields(Fields& out, const LockstepDifference& difference) {
  std::vector<std::string> places;
  for (const std::string& ruling : difference.rulings) places.push_back(ruling_place(ruling));
  out.field("what", difference.what, "pin or cell of the DPRAM, and both values");
  out.field("last_telegram", difference.last_telegram, "on the line");
  out.field("last_access", difference.last_access, "of the user");
  out.field("dpram", difference.dpram, "the chip's last access");
  out.texts("events", difference.events, "with its code", "the model's last ones, at most three");
  out.texts("rulings", places, "a page in docs/ and an anchor", "those that decide the pin, then those of the events");
}

std::string result_json(const RunResult& result) { return json_file(Fields::written(result, run_fields)); }

std::string text_and_place(const nlohmann::json& entry) {
  const std::string text = entry.at("text");
  const nlohmann::json where = entry.value("where", nlohmann::json());
  if (where.is_null()) return text;
  user_cpu::Place place{where.at("file"), where.at("line"), where.at("function"),
                        static_cast<std::uint32_t>(std::stoul(where.at("pc").get<std::string>(), nullptr, 16))};
  if (const nlohmann::json& stayed = where.at("stayed_ns"); !stayed.is_null())
    place.stayed = std::llround(stayed.get<double>() * bus::kTicksPerNs);
  return with_place(text, place);
}

std::string result_schema() { return schema_file(kSchema, described()); }

std::string result_markdown() {
  std::string page = kPage;
  const std::string mark = "{version}";
  page.replace(page.find(mark), mark.size(), kVersion);
  return page + schema_table(described());
}

}  // namespace dsdpv1::tb
