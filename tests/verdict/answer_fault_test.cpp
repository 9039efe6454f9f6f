// The script's answer_fault: what a master, which does not know of it, and the monitor see of a slave whose answers
// reach the line like this. The chip notices nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tb/bench/bench.hpp"
#include "tb/bench/verdict.hpp"

namespace dsdpv1 {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr tb::Tick kFrom = 4 * bus::kTicksPerMs;  ///< the fault

class Line : public tb::Observer {
 public:
  void telegram(const tb::HeardTelegram& heard) override {
    if (heard.now > kFrom) telegrams.push_back(heard.telegram);
  }
  void flag(const bus::Flag& flag) override {
    if (flag.at > kFrom) flags.push_back(std::string(bus::name(flag.kind)) + ": " + flag.text);
  }
  /// Of answers.
  std::vector<int> of_answers(const std::function<int(const bus::WireTelegram&)>& value) const {
    std::vector<int> values;
    for (const bus::WireTelegram& each : telegrams)
      if (each.right() && each.decoded.telegram.is_response()) values.push_back(value(each));
    return values;
  }
  std::vector<bus::WireTelegram> telegrams;
  std::vector<std::string> flags;
};

struct Shown {
  const char* name;
  const char* keys;         ///< of the action
  const char* flag;         ///< of the monitor; empty: none
  std::size_t count;        ///< of flags
  bool repeats;             ///< the master asks again
  const char* action = "";  ///< of the master meanwhile
};

const Shown kFaults[] = {
    {"Silent", "fault: silent, times: 2", "unanswered: station 5 did not answer", 2, true},
    {"Fcs", "fault: fcs, times: 2", "telegram error: wrong FCS", 2, true},
    {"Ed", "fault: ed, times: 2", "telegram error: end delimiter is not 16", 2, true},
    {"Parity", "fault: parity, times: 2", "character error: wrong parity in byte 68", 2, true},
    {"Late", "fault: late, times: 2, for: 70us", "TSDR late: station 5 answered after 8", 2, false},
    {"Sa", "fault: sa, times: 2", "unexpected answer: answer of station 4 instead of 5", 2, true},
    {"Da", "fault: da, times: 2", "", 0, true},
    {"Sap", "fault: sap", "", 0, true, "  - {at: 4.5ms, do: slave_diag, slave: io}\n"},
    {"Doubled", "fault: doubled, times: 2", "unexpected answer: answer of station 5", 2, false},
    {"Cut", "fault: cut, times: 2", "telegram error: ", 2, true},
};

class AnswerFaults : public testing::TestWithParam<Shown> {};

TEST_P(AnswerFaults, AreSeenByAMasterThatDoesNotKnowOfThem) {
  const Shown& given = GetParam();
  const tb::scenario::Scenario scenario = tb::scenario::parse(
      std::string(
          "name: x\nbaud: 12M\nend: 8ms\nslaves:\n  - {name: io, address: 5, init: {ident: 0x0CC9, max_inputs: "
          "2, max_outputs: 2, cfg: \"31\"}}\nmasters:\n  - {name: plc, address: 2, slaves: [{slave: io, outputs: "
          "\"01 02\"}]}\nscript:\n  - {at: 4ms, do: answer_fault, slave: io, ") +
          given.keys + "}\n" + given.action +
          "allow:\n  - {event: BUS_TELEGRAM_ERROR}\n  - {event: BUS_CHARACTER_ERROR}\n  - {event: BUS_TSDR_LATE}\n  - "
          "{event: BUS_UNEXPECTED_ANSWER}\n  - {event: BUS_T_SYN_VIOLATED}\n",
      "x.yaml");
  tb::Bench bench(scenario, {}, tb::make_pin_execution());
  Line line;
  bench.add_observer(line);
  const tb::RunResult result = bench.run([](tb::Tick) { return true; });
  EXPECT_EQ(tb::verdict(result), tb::Verdict::kPassed) << tb::words(result);
  std::size_t flags = 0;
  for (const std::string& flag : line.flags) flags += *given.flag != '\0' && flag.find(given.flag) == 0 ? 1 : 0;
  EXPECT_EQ(flags, given.count) << testing::PrintToString(line.flags);
  bool repeated = false;
  const bus::WireTelegram* before = nullptr;
  for (const bus::WireTelegram& each : line.telegrams) {
    if (!each.right() || !each.decoded.telegram.is_request() || each.decoded.telegram.da % 128 != 5) continue;
    repeated = repeated || (before != nullptr && before->decoded.bytes == each.decoded.bytes);
    before = &each;
  }
  EXPECT_EQ(repeated, given.repeats);
  if (given.name == std::string("Da"))
    EXPECT_THAT(line.of_answers([](const auto& each) { return each.decoded.telegram.da; }), Contains(3).Times(2));
  if (given.name == std::string("Sap"))
    EXPECT_THAT(line.of_answers([](const auto& each) { return each.decoded.telegram.ssap.value_or(0); }),
                Contains(61).Times(1));
  const auto& last = line.telegrams.back();
  EXPECT_TRUE(last.right()) << "all is well again";
  EXPECT_EQ(result.slaves[0].status.dp_state, profibus::DpState::kDataExch);
}

INSTANTIATE_TEST_SUITE_P(All, AnswerFaults, testing::ValuesIn(kFaults),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace dsdpv1
