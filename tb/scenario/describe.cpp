// The scenario itself and the chip's parameters.
#include "tb/scenario/describe.hpp"

#include "bus/baud.hpp"

namespace tb::scenario {

std::vector<WordFor<int>> baud_words(bool searching) {
  std::vector<WordFor<int>> words;
  words.reserve(bus::kBaudCount + 1);
  for (int i = 0; i < bus::kBaudCount; ++i) words.push_back({i, bus::baud(i).name.data(), ""});
  if (searching) words.push_back({-1, "searching", "the chip looks for the baud rate"});
  return words;
}

const ObjectOf<ChipParameters>& chip_keys() {
  static const ObjectOf<ChipParameters> keys = [] {
    using C = ChipParameters;
    ObjectOf<C> o("chip", "The parameters of the chip that the rulings mark (p), for all slaves of the scenario.");
    o.integer("access_interval", &C::access_interval, {16, 4800}, "cycles",
              "From the start of one DPRAM access of the chip to the next (H1).");
    o.integer("ready_cycles", &C::ready_cycles, {1, 1000000}, "cycles",
              "From the release of RESET to B004 = 0xC5 (D1).");
    o.integer("rts_lead", &C::rts_lead, {0, 32}, "cycles", "PBRTS high before the first start bit (P2).");
    o.integer("rts_trail", &C::rts_trail, {0, 32}, "cycles", "PBRTS high after the last stop bit (P2).");
    o.integer("intr_low", &C::intr_low, {1, 10000}, "cycles", "How long INTR0 stays low (P7).");
    o.integer("intr_gap", &C::intr_gap, {1, 10000}, "cycles",
              "How long INTR0 stays high between two pulses at least (P7).");
    o.integer("search_window_ms", &C::search_window_ms, {1, 10000}, "ms",
              "Least time at one baud rate of the search (S1).");
    o.integer("search_window_bits", &C::search_window_bits, {100, 100000}, "bit times",
              "Least bit times at one baud rate of the search (S1).");
    o.integer("baud_control_ms", &C::baud_control_ms, {1, 60000}, "ms",
              "Silence after which the baud rate is searched again (S1).");
    return o;
  }();
  return keys;
}

const ObjectOf<Allow>& allow_keys() {
  static const ObjectOf<Allow> keys = [] {
    ObjectOf<Allow> o("allow", "A violation that is part of the scenario and does not fail the run.");
    o.name_of("event", &Allow::event, "Code of the event, as in the log and in docs/reasons.md, or id of a check.")
        .required = true;
    o.name_of("slave", &Allow::slave, "Only of this slave; left out: of any slave or of the bus.");
    return o;
  }();
  return keys;
}

namespace {

ObjectOf<Scenario> describe_scenario() {
  ObjectOf<Scenario> o("scenario", "A bus with its masters and slaves, what happens on it, and what is expected.");
  o.text("name", &Scenario::name, "What the scenario shows, one line.").required = true;
  o.word("baud", &Scenario::baud, baud_words(), "Baud rate of the masters; the chips find it themselves.").required =
      true;
  o.time("end", &Scenario::end, {bus::kTicksPerUs, kLongestTime}, "When the run ends.").required = true;
  o.object("chip", &Scenario::chip, chip_keys(), "Parameters of the chip other than its defaults.");
  o.list("masters", &Scenario::masters, master_keys(), {0, 4},
         "The DP masters class 1. Several at a time, and those beside masters of class 2, need `bus: {ring: true}`.");
  o.list("masters2", &Scenario::masters2, master2_keys(), {0, 4}, "The DP masters class 2.");
  o.list("slaves", &Scenario::slaves, slave_keys(), {1, 32}, "The chips, each with its user CPU.").required = true;
  o.list("script", &Scenario::script, action_keys(), kItems, "What happens during the run.");
  o.list("expect", &Scenario::expect, expectation_keys(), kItems, "What must be true, else the run fails (exit 1).");
  o.list("allow", &Scenario::allow, allow_keys(), kItems,
         "Violations that are expected. Every other one fails the run.");
  o.object("checks", &Scenario::checks, check_keys(), "Limits of the checks other than their defaults.");
  return o;
}

}  // namespace

const keys::Object& description() {
  static const ObjectOf<Scenario> keys = describe_scenario();
  return keys;
}

}  // namespace tb::scenario
