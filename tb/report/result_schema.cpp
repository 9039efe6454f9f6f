#include "tb/report/result_schema.hpp"

#include "tb/report/schema_words.hpp"

namespace dsdpv1::tb {
namespace {

using namespace schema;  // NOLINT(google-build-using-namespace): its words alone

Json pacing() {
  return object({{"port", text("where the host was: the pseudo-terminal, TCP port or serial port")},
                 {"telegrams_from_host", count("telegrams that came from it")},
                 {"bytes_from_host", count("bytes that came from it")},
                 {"bytes_to_host", count("bytes that went to it")},
                 {"held_back", count("its telegrams that came before T_SYN or the slot time had ended")},
                 {"longest_held_back_ns", number("for how long at most")},
                 {"error_mean_us", number("real minus simulated time, on average")},
                 {"error_max_us", number("real minus simulated time at most")},
                 {"times_too_slow", count("how often the computer was too slow")},
                 {"time_lost_ns", number("simulated time given up because of that")}},
                "serve only: how well real time was kept");
}

Json master() {
  return object({{"name", text("of the scenario")},
                 {"address", count("0 to 126")},
                 {"cycles", count("data cycles")},
                 {"min_slave_interval_us", count("the time that a data cycle takes at least")},
                 {"min_slave_interval_from",
                  or_null({{"type", "string"}, {"description", R"("scenario", "gsd", or null when it is 0)"}})}},
                "a master of class 1");
}

Json registry() {
  return list(object({{"sap", count("of the channel")},
                      {"master", or_null(count("address of the master that has it"))},
                      {"in_use", boolean("a master has it")},
                      {"connected", boolean("its connection stands")},
                      {"exchanging", boolean("a request of it is under way")}},
                     "a channel"),
              "the resource manager of MSAC_C2");
}

Json tsdr() {
  return or_null(object({{"answers", count("how many were measured")},
                         {"min_bits", number("bit times, the least")},
                         {"max_bits", number("bit times, the most")}},
                        "from the end of a request to the start of the answer; null without an answer"));
}

Json handshake() {
  return object({{"chip_accesses", count("of the chip to the DPRAM")},
                 {"chip_longest_wait_ns", number("for the user to give it back")},
                 {"user_holds", count("how often the user had the DPRAM")},
                 {"user_given_up", count("how often the user gave up waiting for it")},
                 {"user_longest_wait_ns", number("for the chip to give it")},
                 {"user_longest_hold_ns", number("how long the user had it at most")}},
                "who has the DPRAM");
}

Json user_cpu() {
  return object({{"exchanges", or_null(count("data exchanges that its program has seen; null: it does not tell"))},
                 {"outputs_received", or_null(count("outputs that it has fetched"))},
                 {"inputs_written", or_null(count("inputs that it has written"))},
                 {"judgements", or_null(count("parameters and configurations that it has judged"))},
                 {"driver_errors", or_null(count("errors that the driver has returned"))},
                 {"bad_reads", count("reads before the chip had put its data out")}},
                "the user CPU and its program");
}

Json arm_board() {
  return object({{"instructions", count("carried out")},
                 {"hclk_cycles", count("of the processor's clock")},
                 {"hclk_hz", count("its rate at the end")},
                 {"hclk_source", text("where that comes from")},
                 {"notes", list(text("a line"), "what was noticed of the firmware")}},
                "of a slave whose user_cpu has kind: arm");
}

Json slave() {
  return object(
      {{"name", text("of the scenario")},
       {"address", count("0 to 126")},
       {"dp_state", one_of({"OFFLINE", "WAIT_PRM", "WAIT_CFG", "DATA_EXCH"}, "at the end")},
       {"baud", text(R"(the rate it has found: "12M" to "9.6k", or "searching")")},
       {"master", or_null(count("the one that has it, by address"))},
       {"data_exchanges", count("how many the chip has had")},
       {"outputs_overwritten", count("outputs that newer ones replaced before the user had fetched them")},
       {"rm_registry", registry()},
       {"telegrams_received", count("for this station")},
       {"telegrams_answered", count("by this station")},
       {"tsdr", tsdr()},
       {"handshake", handshake()},
       {"user_cpu", user_cpu()},
       {"arm_board", arm_board(), false},
       {"master_state", text("what its master makes of it; empty without one")},
       {"master_reason", text("and why")},
       {"waits_for",
        text("not in data exchange: what stands in the way, as its chip has said, and what to do; else empty")},
       {"inputs", text("at the end, bytes in hexadecimal")},
       {"outputs", or_null(text("at the end, bytes in hexadecimal; null: its program does not tell"))}},
      "a slave at the end of the run");
}

Json lockstep() {
  const Json difference = object({{"slave", text("at which")},
                                  {"at_ns", number("when")},
                                  {"what", text("pin or cell of the DPRAM, and both values")},
                                  {"last_telegram", text("on the line")},
                                  {"last_access", text("of the user CPU")},
                                  {"dpram", text("the chip's last access")}},
                                 "the first difference; null: model and RTL are the same");
  return object({{"cycles", count("that were compared")},
                 {"pin_changes", count("that both sides made")},
                 {"dpram_images", count("of the DPRAM that were compared")},
                 {"difference", or_null(difference)}},
                "engine lockstep only: model and RTL side by side");
}

Json expectation() {
  return object(
      {{"text", text("in words")},
       {"line", count("where it stands in the scenario")},
       {"passed",
        or_null(boolean("null: not judged, since firmware does not tell, or the script keeps the slave away"))},
       {"seen", text("what was seen")},
       {"implied", boolean("by a master that has the slave: data exchange, to the end")}},
      "an expectation");
}

Json violation() {
  const Json change = object({{"at_ns", number("when")}, {"pin", text("its name")}, {"level", text("its new level")}},
                             "a change of a pin");
  return object({{"at_ns", number("when")},
                 {"margin_ns", or_null(number("negative: by how much the limit was missed"))},
                 {"text", text("in words")},
                 {"history", list(change, "the pins before it")}},
                "a violation");
}

Json histogram() {
  return list(object({{"from_ns", or_null(number("null: without end"))},
                      {"to_ns", or_null(number("null: without end"))},
                      {"count", count("of margins in between")}},
                     "a class of margins that is not empty"),
              "how the margins are spread");
}

Json check() {
  return object({{"id", text("of docs/checks.md")},
                 {"slave", text("at which")},
                 {"rule", text("in words")},
                 {"clause", text("where it comes from")},
                 {"limit_ns", or_null(number("null: the rule has none"))},
                 {"count", count("how often it was looked at")},
                 {"violations", count("how often it did not hold")},
                 {"allowed", count("violations that the scenario allows")},
                 {"worst_margin_ns", or_null(number("negative: violated"))},
                 {"worst_value_ns", or_null(number("the time that was measured there"))},
                 {"at_ns", or_null(number("when that was"))},
                 {"histogram", histogram()},
                 {"listed", list(violation(), "the first 20 violations")}},
                "a check on one slave");
}

std::vector<Member> repeated() {
  return {{"slave", text("at which")},          {"code", text("of docs/reasons.md")},
          {"count", count("how often")},        {"first_ns", number("the first time")},
          {"last_ns", number("the last time")}, {"text", text("in words, of the first time")}};
}

Json refused() { return object(repeated(), "what was refused for one reason"); }

Json violated() {
  std::vector<Member> members = repeated();
  members.push_back({"place", text("the cell that it is about; empty: none")});
  members.push_back({"allowed", boolean("the scenario allows it")});
  return object(members, "what was violated in one way at one place, those of checks apart");
}

Json event() {
  return object({{"at_ns", number("when")},
                 {"slave", text("at which; \"bus\": the bus monitor")},
                 {"code", text("of docs/reasons.md")},
                 {"severity", one_of({"info", "refusal", "violation"}, "what it is")},
                 {"allowed", boolean("a violation that the scenario allows")},
                 {"text", text("in words")}},
                "something that happened");
}

Json root() {
  return object(
      {{"schema", constant(kResultSchema, "what this file is")},
       {"version", constant(kResultVersion, "of what it holds")},
       {"scenario", text("its name")},
       {"file", text("where it was read")},
       {"passed", boolean("`verdict` is passed")},
       {"verdict",
        one_of({"passed", "failed", "nothing_judged", "interrupted"},
               "passed: all expectations were met, nothing was violated that is not allowed, no RTL differed; "
               "nothing_judged: no data exchange, and nothing was expected")},
       {"verdict_text", text("the last line of the table: the verdict, and what was not judged")},
       {"interrupted", boolean("it was ended by a signal before its time")},
       {"engine", text("step, skip, rtl, lockstep")},
       {"view", text("pins, tlm")},
       {"simulated_ns", number("simulated time")},
       {"chip_cycles", count("of all chips together")},
       {"wall_s", number("how long it took")},
       {"real_time_factor", number("simulated time over that; 0: not measured")},
       {"telegrams", count("on the line")},
       {"wrong_telegrams", count("of them with an error")},
       {"violations", count("that the scenario does not allow; of checks in checks_mode fail only")},
       {"checks_mode", one_of({"fail", "report", "off"}, "what comes of violations that checks find")},
       {"violations_not_judged", count("of checks in checks_mode report")},
       {"pacing", pacing(), false},
       {"lockstep", lockstep(), false},
       {"masters", list(master(), "of class 1")},
       {"slaves", list(slave(), "in the order of the scenario")},
       {"expectations", list(expectation(), "in the order of the scenario, then the implied ones")},
       {"checks", list(check(), "empty in checks_mode off")},
       {"refused", list(refused(), "by the first time")},
       {"violated", list(violated(), "by the first time")},
       {"events", list(event(), "the first 10 000, in order of time")},
       {"events_dropped", count("events beyond those")}},
      "the result of a run");
}

constexpr const char* kPage = R"(# The result of a run

Written by `dsdpv1-sim schema --result --markdown`, do not edit. `dsdpv1-sim run --result FILE` (and `serve`, and `regress` for the runs that it keeps) writes one JSON object.
`dsdpv1-sim schema --result` prints its JSON Schema (draft 2020-12):

```
dsdpv1-sim run scenarios/watchdog.yaml --result watchdog.json
dsdpv1-sim schema --result > result.schema.json
check-jsonschema --schemafile result.schema.json watchdog.json
```

## Version

`schema` says what the file is, `version` which version of it; this page is about {version}. The schema is exact: it names all that a result of its version
has, and a member that it does not name is wrong.

- A new member, or a new word where a member has one of several, changes the second number. Programs that look up members by name need not change.
- A member that goes, gets another name, type, unit or meaning changes the first number.
- Texts (`text`, `seen`, `rule`, `notes`) are for people and may change with every version of the program; `code` and `id` do not.

Times that end in `_ns` are nanoseconds from the start of the run: whole numbers where they are whole. The results of a scenario with all engines
and views are the same, but for `engine`, `view`, `wall_s` and `real_time_factor`.

## Members

| member | type | what |
|---|---|---|
)";

}  // namespace

std::string result_schema() { return schema::document(kResultSchema, root()); }

std::string result_markdown() {
  std::string page = kPage;
  const std::string mark = "{version}";
  page.replace(page.find(mark), mark.size(), kResultVersion);
  return page + schema::rows(root());
}

}  // namespace dsdpv1::tb
