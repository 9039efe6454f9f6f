// Keys of conditions: for expectations and for actions that wait.
#include "tb/scenario/describe.hpp"

namespace dsdpv1::tb::scenario {
namespace {

template <class T>
void describe_condition(ObjectOf<T>& o) {
  using C = Condition;
  o.name_of("slave", &C::slave, "Name of the slave that the other keys are about.");
  o.word("dp_state", &C::dp_state,
         std::vector<WordFor<profibus::DpState>>{
             {profibus::DpState::kOffline, "offline", "not initialised"},
             {profibus::DpState::kWaitPrm, "wait_prm", "waits for Set_Prm, or for the user's verdict on it"},
             {profibus::DpState::kWaitCfg, "wait_cfg", "waits for Chk_Cfg, or for the user's verdict on it"},
             {profibus::DpState::kDataExch, "data_exch", "exchanges data"}},
         "State of the DP state machine.");
  o.word("baud", &C::baud, found_baud_words(), "Baud rate that the chip has found.");
  o.integer("station_address", &C::station_address, kAddresses, "", "The chip's present station address.");
  o.integer("data_exchanges", &C::data_exchanges, {0, 1'000'000'000}, "",
            "Least number of data exchanges, without repetitions.");
  o.integer("data_exchanges_at_most", &C::data_exchanges_at_most, {0, 1'000'000'000}, "",
            "Greatest number of data exchanges.");
  o.bytes("inputs", &C::inputs, {0, 244}, "The last inputs that its master has received.");
  o.bytes("outputs", &C::outputs, {0, 244}, "The last outputs that the user CPU has fetched.");
  o.name_of("event", &C::event, "Code of an event of the chip (docs/reasons.md) that has happened.");
  o.integer("count", &C::count, {0, 1'000'000'000}, "", "Least number of these events.");
  o.integer("count_at_most", &C::count_at_most, {0, 1'000'000'000}, "", "Greatest number of these events.");
  o.number("tsdr_min", &C::tsdr_min, {0, 100000}, "bit times", "No answer of the slave is earlier.");
  o.number("tsdr_max", &C::tsdr_max, {0, 100000}, "bit times", "No answer of the slave is later.");
  o.time("longest_wait_at_most", &C::longest_wait_at_most, kAnyTime,
         "The chip never waited longer for the user CPU to give back the memory that they share.");
  o.name_of("master", &C::master, "Name of the master whose answers `reply` is about (default: the first one).");
  o.name_of("connection", &C::connection, "Name of the connection that `connection_state` or a C2 service is about.");
  o.word("connection_state", &C::connection_state, connection_state_words(), "Its state at the class 2 master.");
  o.word("reply_of", &C::reply_of,
         std::vector<WordFor<ActionKind>>{{ActionKind::kReadInputs, "read_inputs", ""},
                                          {ActionKind::kReadOutputs, "read_outputs", ""},
                                          {ActionKind::kGetCfg, "get_cfg", ""},
                                          {ActionKind::kSlaveDiag, "slave_diag", ""},
                                          {ActionKind::kSetSlaveAddress, "set_slave_address", ""},
                                          {ActionKind::kC1Read, "c1_read", ""},
                                          {ActionKind::kC1Write, "c1_write", ""},
                                          {ActionKind::kC2Read, "c2_read", ""},
                                          {ActionKind::kC2Write, "c2_write", ""},
                                          {ActionKind::kC2Transport, "c2_transport", ""}},
         "The service whose last answer `reply` and `outcome` are about.");
  o.bytes("reply", &C::reply, {0, 244},
          "Data of the last answer of that service; of a refused acyclic one: Error_Decode, Error_Code_1 and "
          "Error_Code_2.");
  o.word("outcome", &C::outcome,
         std::vector<WordFor<bus::AcyclicOutcome>>{
             {bus::AcyclicOutcome::kPositive, "positive", ""},
             {bus::AcyclicOutcome::kNegative, "negative", "an error answer (tables 27, 32)"},
             {bus::AcyclicOutcome::kTimeout, "timeout", "acknowledged, never answered"},
             {bus::AcyclicOutcome::kRefused, "refused", "RS, RR or UE"},
             {bus::AcyclicOutcome::kNoAnswer, "no_answer", "no station answers"},
             {bus::AcyclicOutcome::kWrongAnswer, "wrong_answer", "an answer to another request"},
             {bus::AcyclicOutcome::kLost, "lost", "data exchange was left, or the connection ended"}},
         "Result of the last acyclic service.");
  o.at_least_one = {{"dp_state", "baud", "station_address", "data_exchanges", "data_exchanges_at_most", "inputs",
                     "outputs", "event", "tsdr_min", "tsdr_max", "longest_wait_at_most", "reply", "outcome",
                     "connection_state"}};
}

}  // namespace

const ObjectOf<When>& when_keys() {
  static const ObjectOf<When> keys = [] {
    ObjectOf<When> o("when", "A condition; all keys given must be true together.");
    describe_condition(o);
    o.time("after", &When::after, kAnyTime, "Delay after the condition has become true.");
    return o;
  }();
  return keys;
}

const ObjectOf<Expectation>& expectation_keys() {
  static const ObjectOf<Expectation> keys = [] {
    ObjectOf<Expectation> o(
        "expectation",
        "A condition that must be true at a time, by a time, or (with neither) at the end; all keys given together.");
    describe_condition(o);
    o.time("at", &Expectation::at, kAnyTime, "True exactly then.");
    o.time("by", &Expectation::by, kAnyTime, "True at some time until then.");
    o.at_most_one = {{"at", "by"}};
    return o;
  }();
  return keys;
}

}  // namespace dsdpv1::tb::scenario
