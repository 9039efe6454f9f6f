// Data exchange: flags, /INT, requests of C1 and C2, diagnosis and alarms (4.4, 4.5.1).
#include "tests/xgate/module_bench.hpp"

namespace dsdpv1::xgate {
namespace {

class XgateExchange : public testing::Test {
 protected:
  void SetUp() override { bench.to_exchange(); }

  Bytes exchange() { return bench.ask(0x20, {1, 2, 3}); }
  void expect(std::uint8_t command, const Bytes& data, Error error) {
    EXPECT_EQ(bench.ask(command, data), bench.wrong(command, error)) << testing::PrintToString(data);
  }
  void know() { ASSERT_EQ(bench.ask(0x21, {1, 2, 3}).at(1), 0x21); }
  Bytes initiate() {
    const Bytes now = bench.service(49, {0x57, 0, 0, 0, 0x00, 0x64, 1, 0, 0, 0, 0, 0, 0, 0}, 50);
    EXPECT_EQ(now, Bytes({0x56, 48, 0x00, 0x64})) << "1 s, as asked";
    return bench.poll(48, 50);
  }

  ModuleBench bench;
  const Bytes outputs = frame(0x20, {9, 9, 9});
};

TEST_F(XgateExchange, InputsAndOutputs) {
  know();
  bench.service(-1, {9, 9, 9});
  EXPECT_EQ(exchange(), outputs);
  EXPECT_EQ(bench.service(-1, {7, 8, 9}), Bytes({1, 2, 3}));
  EXPECT_EQ(exchange(), frame(0x20, {7, 8, 9}));
}

TEST_F(XgateExchange, NewUserParametersUntilTheHostKnows) {
  EXPECT_TRUE(bench.int_low());
  bench.service(-1, {9, 9, 9});
  EXPECT_EQ(exchange(), frame(0x21, {9, 9, 9}));
  EXPECT_EQ(exchange(), frame(0x21, {9, 9, 9})) << "the host has not cleared it";
  EXPECT_TRUE(bench.int_low());
  EXPECT_EQ(bench.ask(0x21, {1, 2, 3}), frame(0x21, {9, 9, 9}));
  EXPECT_FALSE(bench.int_low());
  EXPECT_EQ(exchange(), outputs);
  bench.set_prm(ModuleBench::prm());
  EXPECT_TRUE(bench.int_low());
  EXPECT_EQ(bench.ask(0x22), frame(0x22, ModuleBench::prm()));
  EXPECT_TRUE(bench.int_low()) << "only 21 clears it (4.5.1, 10)";
  bench.service(62, ModuleBench::cfg());
  EXPECT_EQ(exchange().at(1), 0x21);
  know();
  EXPECT_FALSE(bench.int_low());
}

TEST_F(XgateExchange, LeavingIt) {
  know();
  bench.set_prm(ModuleBench::prm());
  expect(0x20, {1, 2, 3}, error::kExchange);
  bench.service(62, ModuleBench::cfg());
  EXPECT_EQ(exchange().at(1), 0x21);
  bench.run(610 * profibus::kCyclesPerMs);  // silence: the rate is searched again (S1)
  EXPECT_TRUE(bench.exchanging()) << "no watchdog";
}

TEST_F(XgateExchange, C1ReadAndWrite) {
  know();
  bench.service(51, {0x5E, 1, 2, 4}, 51);
  EXPECT_TRUE(bench.int_low());
  EXPECT_EQ(exchange(), frame(0x30, box(1, {0x5E, 1, 2, 4})));
  EXPECT_EQ(exchange(), frame(0x30, box(1, {0x5E, 1, 2, 4}))) << "still open (X24)";
  expect(0x20, {1}, error::kTooFew);
  EXPECT_TRUE(bench.int_low());
  for (const Bytes& answer : {Bytes{0x5E, 1, 3, 1, 7}, Bytes{0x5F, 1, 2, 1}, Bytes{0x5E, 1, 2, 5, 1, 2, 3, 4, 5},
                              Bytes{0x5E, 1, 2, 4, 1, 2, 3}, Bytes{0xDE, 0x80, 0xB0}, Bytes{0xDF, 0x80, 0xB0, 0}})
    expect(0x30, box(1, answer), error::kParameter);
  expect(0x30, box(2, {0x5E, 1, 2, 4, 1, 2, 3, 4}), error::kParameter);
  EXPECT_TRUE(bench.int_low());
  bench.service(-1, {9, 9, 9});
  EXPECT_EQ(bench.ask(0x30, box(1, {0x5E, 1, 2, 4, 1, 2, 3, 4})), outputs);
  EXPECT_FALSE(bench.int_low());
  EXPECT_EQ(bench.poll(51, 51), Bytes({0x5E, 1, 2, 4, 1, 2, 3, 4}));
  bench.service(51, {0x5F, 1, 2, 2, 8, 9}, 51);
  EXPECT_EQ(exchange(), frame(0x30, box(1, {0x5F, 1, 2, 2, 8, 9})));
  EXPECT_EQ(bench.ask(0x30, box(1, {0xDF, 0x80, 0xB6, 5})), outputs);
  EXPECT_EQ(bench.poll(51, 51), Bytes({0xDF, 0x80, 0xB6, 5}));
  expect(0x30, box(1, {0x5F, 1, 2, 2}), error::kParameter);  // none is open
}

TEST_F(XgateExchange, AnAnswerNeedsARequestThatTheHostHasSeen) {
  bench.service(51, {0x5E, 1, 2, 1}, 51);
  expect(0x30, box(1, {0x5E, 1, 2, 1, 7}), error::kParameter);
  EXPECT_EQ(exchange().at(1), 0x30) << "before 21 (X24)";
  bench.ask(0x13, {1, 2});
  bench.set_prm(ModuleBench::prm());
  bench.service(62, ModuleBench::cfg());
  bench.service(51, {0x5E, 1, 2, 1}, 51);
  expect(0x30, box(1, {0x5E, 1, 2, 1, 7}), error::kParameter);  // it belongs to the request before
}

TEST_F(XgateExchange, LengthsOfCommand04) {
  know();
  const auto falls = [&] {
    return std::count_if(bench.changes.begin(), bench.changes.end(),
                         [](const Change& change) { return change.pin == kInt && change.level == 0; });
  };
  const auto before = falls();
  bench.service(51, Bytes{0x5F, 1, 2, 21} + Bytes(21), 51);
  EXPECT_EQ(falls(), before) << "C1 length is 20: the host does not hear of it";
  EXPECT_EQ(bench.poll(51, 51), Bytes({0xDF, 0x80, 0xB1, 0}));
  bench.service(51, Bytes{0x5F, 1, 2, 20} + Bytes(20), 51);
  EXPECT_TRUE(bench.int_low());
}

TEST_F(XgateExchange, C2OfTheModuleAndOfTheHost) {
  know();
  EXPECT_EQ(initiate(), Bytes({0x57, 30, 1, 0, 0, 0, 0x12, 0x34, 0, 0})) << "of 4.2.2";
  bench.service(48, {0x51, 1, 2, 1, 0x33}, 50);
  expect(0x30, box(2, {0x51, 1, 2, 1, 6}), error::kParameter);  // the host has not seen it
  EXPECT_EQ(exchange(), frame(0x30, box(2, {0x51, 1, 2, 1, 0x33})));
  bench.service(51, {0x5E, 3, 4, 1}, 51);
  EXPECT_EQ(exchange(), frame(0x30, box(2, {0x51, 1, 2, 1, 0x33}) + box(1, {0x5E, 3, 4, 1}))) << "oldest first";
  bench.service(-1, {9, 9, 9});
  expect(0x30, box(1, {0x5E, 3, 4, 1, 5}) + box(2, {0x51, 9, 2, 2, 6, 7}),
         error::kParameter);  // nothing of it is taken
  EXPECT_EQ(bench.ask(0x30, box(1, {0x5E, 3, 4, 1, 5}) + box(2, {0x51, 1, 2, 2, 6, 7})), outputs);
  EXPECT_EQ(bench.poll(51, 51), Bytes({0x5E, 3, 4, 1, 5}));
  EXPECT_EQ(bench.poll(48, 50), Bytes({0x51, 1, 2, 2, 6, 7}));
  bench.service(48, Bytes{0x5F, 1, 2, 31} + Bytes(31), 50);
  EXPECT_EQ(bench.poll(48, 50), Bytes({0xDF, 0x80, 0xB1, 0})) << "C2 length is 30";
  bench.service(48, {0x5E, 1, 2, 1}, 50);
  EXPECT_TRUE(bench.int_low());
  bench.service(48, {0x58, 0, 0x12, 0}, 50);
  EXPECT_FALSE(bench.int_low()) << "the master's abort takes the request away";
  EXPECT_EQ(exchange(), outputs);
}

TEST_F(XgateExchange, SleepDropsRequests) {
  know();
  initiate();
  bench.service(48, {0x5E, 1, 2, 1}, 50);
  EXPECT_TRUE(bench.int_low());
  EXPECT_EQ(bench.ask(0x12, {1}), frame(0x12, {}));
  EXPECT_FALSE(bench.int_low());
  EXPECT_EQ(bench.ask(0x12, {0}), frame(0x12, {}));
  bench.diagnosis();
  bench.service(48, {}, 50);
  EXPECT_NE(bench.answered, Bytes{0xE5}) << "the channel is free";
}

TEST_F(XgateExchange, C2RequestThatTheHostAnswersTooLate) {
  know();
  initiate();
  bench.service(48, {0x5E, 1, 2, 1}, 50);
  EXPECT_EQ(exchange().at(1), 0x30);
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(bench.int_low());
    bench.run(251 * profibus::kCyclesPerMs);
    if (i < 3) EXPECT_TRUE(bench.service(48, {}, 50).empty());
  }
  EXPECT_FALSE(bench.int_low()) << "Send_Timeout was 1 s";
  expect(0x30, box(2, {0x5E, 1, 2, 1, 7}), error::kParameter);
  EXPECT_EQ(exchange().at(1), 0x20);
  EXPECT_EQ(bench.service(48, {}, 50), Bytes({0x58, 0, 0x13})) << "the abort";
}

TEST_F(XgateExchange, C2TimeoutIsAtLeastTheHosts) {
  ASSERT_EQ(bench.ask(0x13, {0, 1}), frame(0x13, {}));
  Bytes data = ModuleBench::initialisation();
  data[13] = 40;
  ASSERT_EQ(bench.ask(0x04, data), frame(0x04, {}));
  bench.diagnosis();
  EXPECT_EQ(bench.service(49, {0x57, 0, 0, 0, 0x00, 0x64, 1, 0, 0, 0, 0, 0, 0, 0}, 50), Bytes({0x56, 48, 0x01, 0x90}))
      << "4 s (X20)";
}

TEST_F(XgateExchange, WithoutReadAndWrite) {
  ASSERT_EQ(bench.ask(0x13, {0, 1}), frame(0x13, {}));
  Bytes data = ModuleBench::initialisation();
  data[7] = 0;
  ASSERT_EQ(bench.ask(0x04, data), frame(0x04, {}));
  bench.diagnosis();
  bench.set_prm(ModuleBench::prm());
  bench.service(62, ModuleBench::cfg());
  bench.service(51, {0x5E, 1, 2, 4}, 51);
  EXPECT_EQ(bench.poll(51, 51), Bytes({0xDE, 0x80, 0xA9, 0}));
}

// --- diagnosis and alarms --------------------------------------------------------------------------------------------

TEST_F(XgateExchange, Diagnosis) {
  bench.service(-1, {9, 9, 9});
  EXPECT_EQ(bench.ask(0x31, box(3, {0x80, 0x41, 0x21})), outputs);
  EXPECT_EQ(bench.diagnosis(), Bytes({0x08, 0x04, 0, kMaster, 0x0F, 0x01, 0x80, 0x41, 0x21})) << "Ext_Diag";
  EXPECT_EQ(bench.ask(0x31, box(3, {0x04, 0x81, 0, 1})), outputs);
  EXPECT_EQ(bench.diagnosis(), Bytes({0x00, 0x04, 0, kMaster, 0x0F, 0x01, 0x04, 0x81, 0, 1})) << "a status";
  EXPECT_EQ(bench.ask(0x31, box(3, {})), outputs);
  EXPECT_EQ(bench.diagnosis().size(), 6U) << "none";
  expect(0x31, box(3, {0x42}), error::kParameter);
  expect(0x31, {1, 2, 3}, error::kParameter);
  expect(0x31, box(3, {}) + box(3, {}), error::kParameter);
}

TEST_F(XgateExchange, AlarmIsAcknowledgedUntilTheHostSaysSo) {
  know();
  bench.service(-1, {9, 9, 9});
  EXPECT_EQ(bench.ask(0x31, box(4, {0x05, 0x02, 7, 0x29, 0xAB})), outputs);
  EXPECT_EQ(bench.diagnosis(), Bytes({0x08, 0x04, 0, kMaster, 0x0F, 0x01, 0x05, 0x02, 7, 0x29, 0xAB}));
  EXPECT_FALSE(bench.int_low());
  bench.service(51, {0x5C, 7, 0x02, 0x29}, 51);
  EXPECT_EQ(bench.poll(51, 51), Bytes({0x5C, 7, 0x02, 0x29})) << "the module answers it (4.4.4)";
  EXPECT_TRUE(bench.int_low());
  EXPECT_EQ(exchange(), frame(0x20, {9, 9, 9}, 0x51));
  EXPECT_EQ(bench.ask(0x99), frame(0x99, {4, 1, 0}, 0xD1)) << "an error has it, too";
  EXPECT_TRUE(bench.int_low());
  EXPECT_EQ(bench.ask(0x20, {1, 2, 3}, 0x51), outputs);
  EXPECT_FALSE(bench.int_low());
}

TEST_F(XgateExchange, AlarmsHaveLimits) {
  know();
  bench.service(-1, {9, 9, 9});
  const auto raise = [&](std::uint8_t type, std::uint8_t specifier) {
    const Bytes answer = bench.ask(0x31, box(4, {0x04, type, 0, specifier}));
    bench.diagnosis();
    return answer;
  };
  EXPECT_EQ(raise(1, 1 << 3), outputs);
  EXPECT_EQ(raise(2, 2 << 3), outputs);
  EXPECT_EQ(raise(3, 3 << 3), bench.wrong(0x31, error::kResource)) << "2 to the power of 1 are open";
  bench.service(50, {0x5C, 0, 1, 1 << 3}, 51);
  EXPECT_EQ(bench.ask(0x31, box(4, {0x04, 3, 0, 3 << 3}), 0x51), outputs) << "SAP 50 as well";
  expect(0x31, box(4, {0x04, 1, 0, 4 << 3}), error::kResource);
}

/// `both`: the host's Type_Enable_Alarm and DPV1_Status_2 of Set_Prm.
TEST_F(XgateExchange, AlarmsNeedBothSides) {
  const auto answer = [&](std::uint8_t host, std::uint8_t master) {
    bench.ask(0x13, {0, 1});
    Bytes data = ModuleBench::initialisation();
    data[17] = host;
    EXPECT_EQ(bench.ask(0x04, data), frame(0x04, {}));
    bench.diagnosis();
    bench.set_prm({0x80, master, 0x05, 0, 0});
    bench.service(62, ModuleBench::cfg());
    return bench.ask(0x31, box(4, {0x04, 0x02, 0, 0}));
  };
  EXPECT_EQ(answer(0x40, 0xBC), bench.wrong(0x31, error::kResource));
  EXPECT_EQ(answer(0xBC, 0x40), bench.wrong(0x31, error::kResource));
  EXPECT_EQ(answer(0x40, 0x40), frame(0x20, {0, 0, 0}));
}

// --- the master's configuration --------------------------------------------------------------------------------------

TEST_F(XgateExchange, AnyConfigurationIsReadFirst) {
  ModuleBench any;
  ASSERT_EQ(any.send({0x7E, 0x04, 0x04, 0x11, 0x06, 0x01, 0x0F, 0x00, 0x67}), Bytes({0x7E, 0x04, 0x00, 0x11, 0x6B}));
  any.diagnosis();
  any.set_prm({});
  for (const std::uint8_t command : Bytes{0x23, 0x24})
    EXPECT_EQ(any.ask(command), any.wrong(command, error::kResource)) << "the master has not sent any";
  Bytes cfg;
  for (int i = 0; i < 30; ++i) cfg = cfg + Bytes{0x10, 0x20};  // more than 24 identifiers (4.7.3)
  any.service(62, cfg);
  ASSERT_TRUE(any.exchanging());
  EXPECT_EQ(any.ask(0x20, Bytes(30)), any.wrong(0x20, error::kExchange));
  EXPECT_EQ(any.ask(0x24), frame(0x24, {30, 30}));
  EXPECT_EQ(any.ask(0x20, Bytes(30)), any.wrong(0x20, error::kExchange));
  EXPECT_EQ(any.ask(0x23), frame(0x23, cfg));
  EXPECT_EQ(any.ask(0x20, Bytes(30)), frame(0x21, Bytes(30)));
  EXPECT_EQ(any.ask(0x20, Bytes(29)), any.wrong(0x20, error::kTooFew));
  any.ask(0x13, {1, 2});
  any.set_prm({});
  any.service(62, {0x10, 0x20});
  EXPECT_EQ(any.ask(0x20, {1}), any.wrong(0x20, error::kExchange)) << "another configuration";
  EXPECT_EQ(any.ask(0x23), frame(0x23, {0x10, 0x20}));
  EXPECT_EQ(any.ask(0x20, {1}), frame(0x21, {0}));
  any.ask(0x13, {1, 2});
  any.set_prm({});
  any.service(62, {0x40});
  EXPECT_EQ(any.diagnosis()[0] & 0x04, 0x04) << "not decodable";
}

TEST_F(XgateExchange, ConfigurationMayDifferIfBothSaySo) {
  const auto exchanges = [&](std::uint8_t host, std::uint8_t master) {
    bench.ask(0x13, {0, 1});
    Bytes data = ModuleBench::initialisation();
    data[16] = host;
    EXPECT_EQ(bench.ask(0x04, data), frame(0x04, {}));
    bench.diagnosis();
    bench.set_prm({0x80, master, 0, 0, 0});
    bench.service(62, {0x11, 0x20});
    return bench.exchanging();
  };
  EXPECT_FALSE(exchanges(0x80, 0x01));
  EXPECT_FALSE(exchanges(0x81, 0x00));
  EXPECT_TRUE(exchanges(0x81, 0x01));
  EXPECT_EQ(bench.ask(0x24), frame(0x24, {1, 2}));
  EXPECT_EQ(bench.ask(0x20, {1, 2}), frame(0x21, {0}));
}

TEST_F(XgateExchange, FailSafeIsTheHosts) {
  bench.ask(0x13, {1, 2});
  bench.set_prm({0xC0, 0, 0, 0, 0});
  EXPECT_EQ(bench.diagnosis()[0] & 0x50, 0x50) << "Prm_Fault, Not_Supported";
  Bytes data = ModuleBench::initialisation();
  data[16] = 0x82;
  ASSERT_EQ(bench.ask(0x04, data), frame(0x04, {}));
  bench.diagnosis();
  bench.set_prm({0xC0, 0, 0, 0, 0});
  EXPECT_EQ(bench.diagnosis()[0] & 0x50, 0);
}

}  // namespace
}  // namespace dsdpv1::xgate
