// Each command right, wrong and too early, in both forms of errors (4.5.1, 4.5.2).
#include "tests/xgate/module_bench.hpp"

namespace dsdpv1::xgate {
namespace {

class XgateCommand : public testing::TestWithParam<ErrorForm> {
 protected:
  static Config config() {
    Config config = ModuleBench::quick();
    config.errors = GetParam();
    return config;
  }
  void expect(std::uint8_t command, const Bytes& data, const Bytes& answer) {
    EXPECT_EQ(bench.ask(command, data), answer) << testing::PrintToString(data);
  }
  void expect(std::uint8_t command, const Bytes& data, Error error) {
    EXPECT_EQ(bench.ask(command, data), bench.wrong(command, error)) << testing::PrintToString(data);
  }
  void expect_done(std::uint8_t command, const Bytes& data) { expect(command, data, frame(command, {})); }

  ModuleBench bench{config()};
};

TEST_P(XgateCommand, UnknownOnesAndLengths) {
  const std::vector<std::vector<int>> lengths = {{0x01, 1},  {0x02, 13}, {0x03, 3},  {0x12, 1},  {0x13, 2},
                                                 {0x15, 2},  {0x16, 2},  {0x22, 0},  {0x23, 0},  {0x24, 0},
                                                 {0x20, -1}, {0x21, -1}, {0x30, -1}, {0x31, -1}, {0x04, -1}};
  for (int command = 0; command < 256; ++command) {
    const auto code = static_cast<std::uint8_t>(command);
    const auto row = std::find_if(lengths.begin(), lengths.end(), [&](const auto& each) { return each[0] == command; });
    if (row == lengths.end()) {
      expect(code, {}, error::kCommand);
      continue;
    }
    for (const int size : {(*row)[1] - 1, (*row)[1] + 1})
      if (size >= 0 && (*row)[1] >= 0) expect(code, Bytes(static_cast<std::size_t>(size)), error::kTooFew);
  }
  expect(0x03, Bytes(13), error::kTooFew);  // the table's length, which the example does not have (X13)
}

TEST_P(XgateCommand, Device) {
  expect(0x01, {1}, frame(0x01, {0x01, 0x00}));
  expect(0x01, {2}, frame(0x01, {0x01, 0x00}));
  expect(0x01, {3}, frame(0x01, {0x00, 0x01}));
  expect(0x01, {4}, frame(0x01, {0x00, 0x01}));
  expect(0x01, {8}, frame(0x01, Bytes(12)));
  expect(0x01, {9}, frame(0x01, {'X', 'G', 'a', 't', 'e', '-', 'D', 'P', 'S', '1', '0', 0}));
  for (const std::uint8_t what : Bytes{0, 5, 7, 10}) expect(0x01, {what}, error::kParameter);
  expect(0x02, Bytes{1} + Bytes(12), error::kParameter);
  const Bytes serial = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  expect_done(0x02, Bytes{8} + serial);
  expect_done(0x02, Bytes{9} + Bytes(12, 'x'));
  bench.reset(true);
  bench.run(10);
  bench.reset(false);
  bench.run(2000);
  expect(0x01, {8}, frame(0x01, serial));  // X27: over /Rst
  expect(0x01, {9}, frame(0x01, Bytes(12, 'x')));
}

TEST_P(XgateCommand, Special) {
  for (const std::uint8_t special : Bytes{0x10, 0x01, 0x12, 0x21, 0x33, 0x00})
    EXPECT_EQ(bench.ask(0x01, {1}, special), bench.wrong(0x01, error::kTooFew)) << int{special};  // X19
  for (const std::uint8_t special : Bytes{0x91, 0x51, 0x1D}) EXPECT_EQ(bench.ask(0x01, {1}, special).size(), 7U);
}

TEST_P(XgateCommand, DamagedXor) {
  for (const std::uint8_t command : Bytes{0x01, 0x20, 0x77, 0x04}) {
    Bytes sent = frame(command, {1, 2});
    sent.back() ^= 1;
    const Error expected = command == 0x04 ? Error{1, 1} : Error{2, 4};  // tables 4.11 and 4.12
    EXPECT_EQ(bench.send(sent), bench.wrong(command, expected));
  }
}

TEST_P(XgateCommand, TooEarly) {
  for (const std::uint8_t command : Bytes{0x20, 0x21, 0x30, 0x31}) expect(command, {1, 2, 3}, error::kNotConnected);
  for (const std::uint8_t command : Bytes{0x22, 0x23, 0x24}) expect(command, {}, error::kResource);
  for (const std::uint8_t step : Bytes{1, 2, 3}) expect(0x13, {1, step}, error::kResource);
  expect_done(0x04, ModuleBench::initialisation());
  expect(0x23, {}, frame(0x23, ModuleBench::cfg()));  // from 04 on (4.5.1, 12 and 13)
  expect(0x24, {}, frame(0x24, {3, 3}));
  expect(0x20, {1, 2, 3}, error::kNotConnected);
  expect(0x13, {1, 3}, error::kNotConnected);
  bench.diagnosis();  // the first telegram: the rate is found
  expect(0x20, {1, 2, 3}, error::kExchange);
  expect(0x13, {1, 3}, error::kExchange);
  expect(0x22, {}, error::kResource);
  bench.set_prm(ModuleBench::prm());
  expect(0x22, {}, frame(0x22, ModuleBench::prm()));
  expect(0x20, {1, 2, 3}, error::kExchange);
  bench.service(62, ModuleBench::cfg());
  expect(0x23, {}, frame(0x23, {0x50, 0x60, 0x10, 0x20}));
  expect(0x24, {}, frame(0x24, {3, 3}));
  expect_done(0x13, {1, 3});
  expect(0x04, ModuleBench::initialisation(), error::kResource);
  expect(0x20, {1, 2}, error::kTooFew);
  expect(0x21, {1, 2, 3, 4}, error::kTooFew);
  expect(0x30, {}, error::kTooFew);
  expect(0x31, {}, error::kTooFew);
  expect(0x20, {1, 2, 3}, frame(0x21, {0, 0, 0}));
}

TEST_P(XgateCommand, ConfigurationOfTheHostUntilItIsGivenUp) {
  Bytes data = ModuleBench::initialisation();
  data[4] = 4;  // 50 61 10 20: 3 inputs, 5 outputs
  expect(0x04, data, error::kIoLength);
  expect(0x23, {}, error::kResource);
  data[4] = 3;
  data[5] = 5;
  data[20] = 0x61;
  expect_done(0x04, data);
  bench.diagnosis();
  bench.set_prm(ModuleBench::prm());
  bench.service(62, ModuleBench::cfg());  // another one: Cfg_Fault
  for (const std::uint8_t mode : Bytes{0, 1}) {
    expect_done(0x12, {mode});
    expect(0x23, {}, frame(0x23, {0x50, 0x61, 0x10, 0x20}));
    expect(0x24, {}, frame(0x24, {5, 3}));
  }
  expect_done(0x12, {0});
  expect_done(0x13, {0, 1});
  for (const std::uint8_t command : Bytes{0x23, 0x24}) expect(command, {}, error::kResource);
}

TEST_P(XgateCommand, InitialisationWrong) {
  expect(0x04, {127, 0, 0, 0}, error::kAddress);
  expect(0x04, {1, 0, 0}, error::kTooFew);
  Bytes data = ModuleBench::initialisation();
  data[4] = 9;
  expect(0x04, data, error::kIoLength);
  EXPECT_EQ(bench.module->state(), ModuleState::kReady);
  expect(0x13, {1, 1}, error::kResource);
}

TEST_P(XgateCommand, ParametersAndConfigurationThatDiffer) {
  expect_done(0x04, ModuleBench::initialisation());
  bench.diagnosis();
  bench.set_prm({0x80, 0, 0, 1});
  expect(0x20, {1, 2, 3}, error::kParametersDiffer);
  expect(0x20, {1, 2, 3}, error::kParametersDiffer);
  EXPECT_EQ(bench.diagnosis()[0] & 0x40, 0x40) << "Prm_Fault";
  bench.set_prm(ModuleBench::prm());
  expect(0x20, {1, 2, 3}, error::kExchange);
  bench.service(62, {0x50, 0x60, 0x20, 0x10});
  expect(0x20, {1, 2, 3}, error::kConfigurationDiffers);
  EXPECT_EQ(bench.diagnosis()[0] & 0x04, 0x04) << "Cfg_Fault";
  bench.set_prm(ModuleBench::prm());
  bench.service(62, ModuleBench::cfg());
  expect(0x20, {1, 2, 3}, frame(0x21, {0, 0, 0}));
}

TEST_P(XgateCommand, Modes) {
  bench.to_exchange();
  expect(0x12, {3}, error::kParameter);
  expect_done(0x12, {1});
  expect(0x20, {1, 2, 3}, error::kNotConnected);
  expect(0x04, ModuleBench::initialisation(), error::kResource);
  expect(0x13, {1, 1}, error::kResource);
  EXPECT_TRUE(bench.diagnosis().empty()) << "silent";
  expect_done(0x12, {0});
  bench.diagnosis();  // its rate is found
  EXPECT_FALSE(bench.diagnosis().empty());
  expect_done(0x12, {2});
  expect_done(0x12, {2});
  expect(0x12, {0}, error::kResource);
  expect(0x12, {1}, error::kResource);
  EXPECT_TRUE(bench.diagnosis().empty());
  expect(0x01, {1}, frame(0x01, {1, 0}));  // frames are served
}

TEST_P(XgateCommand, SleepBeforeInitialisation) {
  expect_done(0x12, {0});
  expect_done(0x12, {1});
  expect_done(0x12, {0});
  EXPECT_EQ(bench.module->state(), ModuleState::kReady);
}

TEST_P(XgateCommand, Steps) {
  bench.to_exchange();
  for (const Bytes& data : {Bytes{2, 1}, Bytes{0, 0}, Bytes{1, 4}}) expect(0x13, data, error::kParameter);
  expect_done(0x13, {1, 2});
  EXPECT_EQ(bench.module->bus().state(), profibus::DpState::kWaitPrm);
  bench.set_prm(ModuleBench::prm());
  bench.service(62, ModuleBench::cfg());
  EXPECT_TRUE(bench.exchanging());
  expect_done(0x13, {1, 1});
  expect(0x20, {1, 2, 3}, error::kNotConnected);  // the search begins again
  bench.diagnosis();
  bench.set_prm(ModuleBench::prm());
  bench.service(62, ModuleBench::cfg());
  EXPECT_TRUE(bench.exchanging());
  expect_done(0x13, {0, 1});
  EXPECT_TRUE(bench.diagnosis().empty()) << "silent until 04";
  expect(0x13, {1, 1}, error::kResource);
  bench.to_exchange();
}

TEST_P(XgateCommand, StepAnsweredAsTheExample) {
  Config other = config();
  other.step_answer = StepAnswer::kExample;
  ModuleBench example(other);
  EXPECT_EQ(example.ask(0x13, {1, 2}), example.wrong(0x13, error::kResource));
  example.to_exchange();
  EXPECT_EQ(example.send({0x7E, 0x13, 0x02, 0x11, 0x01, 0x02, 0x7D}), Bytes({0x7E, 0x04, 0x00, 0x11, 0x6B}));
}

TEST_P(XgateCommand, LightsAndWatchdog) {
  expect_done(0x15, {0b01'01'01'01, 0});
  for (int pin = kFirstLed; pin < kFirstLed + kLeds; ++pin) EXPECT_EQ(bench.levels[static_cast<std::size_t>(pin)], 1);
  bench.reset(true);
  EXPECT_EQ(bench.levels[kFirstLed], 0) << "in self-control again";
  bench.reset(false);
  bench.run(2'000);
  expect_done(0x15, {0, 0});
  for (int pin = kFirstLed; pin < kFirstLed + kLeds; ++pin) EXPECT_EQ(bench.levels[static_cast<std::size_t>(pin)], 0);
  expect(0x16, {0x80, 0}, error::kTime);
  expect_done(0x16, {0x80, 0xFF});
  expect_done(0x16, {0, 0});
}

TEST_P(XgateCommand, Rates) {
  for (const std::uint32_t rate : {0U, 1199U, 3'000'001U, 0xFFFFFFU})
    expect(0x03,
           {static_cast<std::uint8_t>(rate & 0xFF), static_cast<std::uint8_t>(rate >> 8 & 0xFF),
            static_cast<std::uint8_t>(rate >> 16)},
           error::kRate);
  EXPECT_EQ(bench.send({0x7E, 0x03, 0x03, 0x11, 0x00, 0x4B, 0x00, 0x24}), Bytes({0x7E, 0x03, 0x00, 0x11, 0x6C}));
  EXPECT_EQ(bench.module->rate(), 3'000'000U) << "the answer has the old rate";
  bench.run(499);
  EXPECT_EQ(bench.module->rate(), 3'000'000U);
  bench.run(1);
  EXPECT_EQ(bench.module->rate(), 19'200U);
  bench.byte_time = 25'000;
  bench.begins.clear();
  expect(0x01, {1}, frame(0x01, {1, 0}));
  ASSERT_EQ(bench.begins.size(), 7U);
  EXPECT_EQ(bench.begins[6] - bench.begins[0], 6 * 25'000);
}

INSTANTIATE_TEST_SUITE_P(Both, XgateCommand, testing::Values(ErrorForm::kFlag, ErrorForm::kPrinted));

}  // namespace
}  // namespace dsdpv1::xgate
