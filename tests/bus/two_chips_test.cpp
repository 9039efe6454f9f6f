// One master of class 2 with channels to two chips on one line (7.3), each with a user CPU, in the bench.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tb/bench/bench.hpp"
#include "tb/bench/verdict.hpp"

namespace dsdpv1 {
namespace {

const std::string kScenario = R"(
name: A channel to each of two chips
baud: 12M
end: 60ms
chip: {search_window_ms: 2}
slaves:
  - name: left
    address: 5
    init: {ident: 0x0CC9, max_inputs: 2, max_outputs: 2, cfg: "31", dpv1: true}
    user_cpu: {cycle: 100us, dpv1: {objects: [{slot: 1, index: 1, data: "11 12 13"}, {slot: 1, index: 2, data: "00*3"}]}}
  - name: right
    address: 7
    init: {ident: 0x0CC9, max_inputs: 2, max_outputs: 2, cfg: "31", dpv1: true}
    user_cpu: {cycle: 130us, dpv1: {objects: [{slot: 1, index: 1, data: "21 22 23"}, {slot: 1, index: 2, data: "00*3"}]}}
masters:
  - {name: plc, address: 2, bus: {ring: true, highest_address: 6}, slaves: [{slave: left}, {slave: right}]}
masters2:
  - name: eng
    address: 1
    start: 1ms
    bus: {highest_address: 6}
    connections: [{name: to_left, slave: left, send_timeout: 4}, {name: to_right, slave: right, send_timeout: 4}]
script:
  - {when: {slave: right, dp_state: data_exch}, do: c2_connect, connection: to_left}
  - {when: {connection: to_left, connection_state: open}, do: c2_connect, connection: to_right}
  - {at: 40ms, do: c2_read, connection: to_left, slot: 1, index: 1, length: 3}
  - {at: 40ms, do: c2_read, connection: to_right, slot: 1, index: 1, length: 3}
  - {at: 44ms, do: c2_write, connection: to_left, slot: 1, index: 2, bytes: "A1 A2 A3"}
  - {at: 44ms, do: c2_read, connection: to_right, slot: 1, index: 2, length: 3}
  - {at: 48ms, do: c2_read, connection: to_left, slot: 1, index: 2, length: 3}
  - {at: 50ms, do: c2_abort, connection: to_left}
  - {at: 52ms, do: c2_read, connection: to_right, slot: 1, index: 1, length: 2}
expect:
  - {connection: to_left, connection_state: open, by: 40ms}
  - {connection: to_right, connection_state: open, by: 40ms}
  - {slave: left, event: C2_CONNECTED, count: 1}
  - {slave: right, event: C2_CONNECTED, count: 1}
  - {connection: to_left, reply_of: c2_read, reply: "11 12 13", by: 43ms}
  - {connection: to_right, reply_of: c2_read, reply: "21 22 23", by: 43ms}
  - {connection: to_right, reply_of: c2_read, reply: "00 00 00", by: 47ms}
  - {connection: to_left, reply_of: c2_read, reply: "A1 A2 A3", by: 49ms}
  - {slave: left, event: C2_MASTER_ABORT, count: 1}
  - {slave: right, event: C2_MASTER_ABORT, count: 0, count_at_most: 0}
  - {connection: to_left, connection_state: closed}
  - {connection: to_right, connection_state: open}
  - {connection: to_right, reply_of: c2_read, reply: "21 22", by: 55ms}
)";

TEST(OneClass2Master, HasAChannelToEachOfTwoChips) {
  const tb::scenario::Scenario scenario = tb::scenario::parse(kScenario, "two_chips.yaml");
  tb::Bench bench(scenario, {}, tb::make_pin_execution());
  const tb::RunResult result = bench.run([](tb::Tick) { return true; });
  for (const tb::ExpectationResult& each : result.expectations)
    EXPECT_TRUE(each.passed) << each.text << ": " << each.seen;
  EXPECT_EQ(result.expectations.size(), 15U) << "two of them implied";
  EXPECT_EQ(tb::verdict(result), tb::Verdict::kPassed) << tb::words(result);
}

}  // namespace
}  // namespace dsdpv1
