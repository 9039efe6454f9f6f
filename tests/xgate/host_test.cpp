// The host program of driver/xgate with the module, over UART and SPI, in both forms of errors and mailboxes.
#include <algorithm>

#include "driver/xgate/xgate.h"
#include "tests/xgate/module_bench.hpp"

namespace dsdpv1::xgate {
namespace {

struct Choice {
  Port port;
  ErrorForm errors;
  MailboxForm mailboxes;
};

class XgateHost : public testing::TestWithParam<Choice> {
 protected:
  XgateHost() {
    const xgate_port port = {this, &send, &receive};
    const xgate_application application = {this, &parameters, &request, &acknowledged};
    EXPECT_EQ(xgate_open(&host, &port, &application), XGATE_OK);
    host.settings.printed_errors = GetParam().errors == ErrorForm::kPrinted;
    host.settings.short_mailboxes = GetParam().mailboxes == MailboxForm::kShort;
  }
  static Config config() {
    Config config = ModuleBench::quick();
    config.port = GetParam().port;
    config.errors = GetParam().errors;
    config.mailboxes = GetParam().mailboxes;
    return config;
  }
  static xgate_config initialisation(const Bytes& cfg = ModuleBench::cfg(), std::uint8_t inputs = 3,
                                     std::uint8_t outputs = 3) {
    xgate_config given{kSlave, 0x0F01, inputs, outputs, 5, {1, 0, 0, 0, 0, 0, 10, 240, 240, 0x80, 0xFC, 1}, {}, 0};
    std::copy(cfg.begin(), cfg.end(), given.cfg);
    given.cfg_length = static_cast<std::uint8_t>(cfg.size());
    return given;
  }
  void to_exchange(const Bytes& cfg = ModuleBench::cfg(), std::uint8_t inputs = 3, std::uint8_t outputs = 3) {
    const xgate_config given = initialisation(cfg, inputs, outputs);
    ASSERT_EQ(xgate_initialise(&host, &given), XGATE_OK);
    bench.diagnosis();
    bench.set_prm(ModuleBench::prm());
    bench.service(62, cfg);
    ASSERT_TRUE(bench.exchanging());
  }
  /// The outputs, {} after an error.
  Bytes exchange(const Bytes& inputs = {1, 2, 3}) {
    std::uint8_t bytes[XGATE_MAX_DATA], length = 0;
    result =
        xgate_exchange(&host, inputs.data(), static_cast<std::uint8_t>(inputs.size()), bytes, sizeof bytes, &length);
    return {bytes, bytes + length};
  }
  void connect_c2() {
    bench.service(49, {0x57, 0, 0, 0, 0x00, 0x64, 1, 0, 0, 0, 0, 0, 0, 0}, 50);
    ASSERT_FALSE(bench.poll(48, 50).empty());
  }
  bool spi() const { return GetParam().port == Port::kSpi; }

  ModuleBench bench{config()};
  xgate_module host{};
  xgate_result result = XGATE_OK;
  std::vector<Bytes> parameters_seen, requests_seen;
  Bytes reply = {0x5E, 1, 2, 2, 7, 8};
  Bytes ids_seen;
  int late = 0;  ///< so many requests are answered later
  int acknowledgements = 0;
  int frames = 0;  ///< that the host has sent
  int damage = 0;  ///< of so many frames to come an answer's byte is changed
  int damaged_byte = 6;
  int damaged_command = -1;  ///< only answers to this one are changed
  bool cut = false;          ///< instead it is lost

 private:
  static XgateHost& self(void* context) { return *static_cast<XgateHost*>(context); }
  static void send(void* context, const std::uint8_t* bytes, std::uint16_t length) {
    XgateHost& test = self(context);
    if (length == 4 && bytes[0] == 0x7E) {
      ++test.frames;
      test.command_ = bytes[1];
    }
    test.received_ = 0;
    const Bytes sent(bytes, bytes + length);
    if (test.spi())
      test.bench.transfer(sent);
    else
      test.bench.put(sent);
  }
  static int receive(void* context, std::uint16_t ms) {
    XgateHost& test = self(context);
    const int byte = test.spi() ? test.bench.transfer(std::uint8_t{0}) : test.next(ms);
    if (byte < 0 || (byte == 0xFF && test.received_ == 0)) return byte;
    if (++test.received_ != test.damaged_byte || test.damage == 0) return byte;
    if (test.damaged_command >= 0 && test.command_ != test.damaged_command) return byte;
    --test.damage;
    return test.cut ? receive(context, ms) : byte ^ 0x02;
  }
  int next(int ms) {
    const Cycle end = bench.now + ms * profibus::kCyclesPerMs;
    while (taken_ == bench.heard.size() && bench.now < end) bench.run(kByte);
    if (taken_ == bench.heard.size()) return -1;
    bench.run(std::max<Cycle>(0, bench.begins[taken_] + kByte - bench.now));
    return bench.heard[taken_++];
  }
  static void parameters(void* context, const std::uint8_t* bytes, std::uint8_t length) {
    self(context).parameters_seen.emplace_back(bytes, bytes + length);
  }
  static std::uint8_t request(void* context, const std::uint8_t* pdu, std::uint8_t length, std::uint8_t* answer) {
    XgateHost& test = self(context);
    test.requests_seen.emplace_back(pdu, pdu + length);
    test.ids_seen.push_back(xgate_request_id(&test.host));
    if (test.late > 0 && test.late-- > 0) return 0;
    Bytes bytes = test.reply;
    bytes[0] = static_cast<std::uint8_t>(pdu[0] | (bytes[0] & 0x80));
    std::copy(bytes.begin(), bytes.end(), answer);
    return static_cast<std::uint8_t>(bytes.size());
  }
  static void acknowledged(void* context) { ++self(context).acknowledgements; }

  std::size_t taken_ = 0;
  int command_ = 0;   ///< that the host has sent last
  int received_ = 0;  ///< bytes of the present answer
};

TEST_P(XgateHost, ExchangesAndTakesParametersOnce) {
  to_exchange();
  bench.service(-1, {9, 8, 7});
  EXPECT_EQ(exchange(), Bytes({9, 8, 7}));
  EXPECT_EQ(parameters_seen, std::vector<Bytes>{ModuleBench::prm()});
  EXPECT_EQ(exchange({4, 5, 6}), Bytes({9, 8, 7}));
  EXPECT_EQ(parameters_seen.size(), 1U);
  EXPECT_FALSE(bench.int_low());
  EXPECT_EQ(bench.service(-1, {9, 8, 7}), Bytes({4, 5, 6}));
  EXPECT_EQ(xgate_read_cfg(&host), XGATE_OK);
  EXPECT_EQ(Bytes(host.answer.data, host.answer.data + host.answer.length), ModuleBench::cfg());
}

TEST_P(XgateHost, ParametersThatItCannotReadAreReadInTheNextExchange) {
  to_exchange();
  for (const int command : {0x21, 0x22}) {
    parameters_seen.clear();
    damaged_command = command;
    damage = 3;
    exchange();
    EXPECT_EQ(result, XGATE_ERR_SILENT);
    EXPECT_EQ(damage, 0) << "three times";
    EXPECT_FALSE(bench.int_low()) << "the module has taken 21";
    EXPECT_TRUE(parameters_seen.empty());
    for (int i = 0; i < 2; ++i) {
      exchange();
      EXPECT_EQ(result, XGATE_OK);
      EXPECT_EQ(parameters_seen, std::vector<Bytes>{ModuleBench::prm()});
    }
    bench.set_prm(ModuleBench::prm());
    bench.service(62, ModuleBench::cfg());
  }
}

TEST_P(XgateHost, ServesRequests) {
  to_exchange();
  bench.service(-1, {9, 8, 7});
  exchange();
  bench.service(51, {0x5E, 1, 2, 4}, 51);
  EXPECT_EQ(exchange(), Bytes({9, 8, 7}));
  EXPECT_EQ(requests_seen, std::vector<Bytes>({{0x5E, 1, 2, 4}}));
  EXPECT_EQ(bench.poll(51, 51), reply);
  reply = {0x80, 0x80, 0xB6, 0};
  bench.service(51, {0x5F, 1, 2, 1, 9}, 51);
  exchange();
  EXPECT_EQ(bench.poll(51, 51), Bytes({0xDF, 0x80, 0xB6, 0}));
  host.application.request = nullptr;
  bench.service(51, {0x5E, 1, 2, 1}, 51);
  exchange();
  EXPECT_EQ(bench.poll(51, 51), Bytes({0xDE, 0x80, 0xB0, 0}));
}

TEST_P(XgateHost, LongAnswersLeaveOneAfterTheOther) {
  to_exchange();
  exchange();
  connect_c2();
  bench.service(51, {0x5E, 1, 2, 240}, 51);
  bench.service(48, {0x5E, 1, 2, 240}, 50);
  reply = Bytes{0x5E, 1, 2, 240} + Bytes(240, 0x5A);
  frames = 0;
  EXPECT_EQ(exchange().size(), 3U);
  EXPECT_EQ(frames, 3) << "20, 30, 30";
  EXPECT_EQ(requests_seen.size(), 2U);
  EXPECT_EQ(bench.poll(51, 51), reply);
  EXPECT_EQ(bench.poll(48, 50), reply);
  bench.service(51, {0x5E, 1, 2, 240}, 51);
  bench.service(48, {0x5E, 1, 2, 240}, 50);
  reply[1] = 9;
  exchange();
  EXPECT_EQ(result, XGATE_ERR_MODULE);
  reply[1] = 1;
  exchange();
  EXPECT_EQ(result, XGATE_OK) << "nothing is left of the answers that were refused";
  EXPECT_EQ(bench.poll(51, 51), reply);
  EXPECT_EQ(bench.poll(48, 50), reply);
}

/// The request stays, data exchange continues by 21 (X24).
TEST_P(XgateHost, ARequestMayBeAnsweredLater) {
  to_exchange();
  bench.service(-1, {9, 8, 7});
  exchange();
  connect_c2();
  bench.service(51, {0x5E, 1, 2, 4}, 51);
  bench.service(48, {0x5E, 1, 2, 4}, 50);
  late = 3;
  for (int i = 0; i < 2; ++i) EXPECT_EQ(exchange(), Bytes({9, 8, 7}));
  EXPECT_EQ(ids_seen, Bytes({1, 2, 1, 2}));
  EXPECT_EQ(bench.poll(51, 51), Bytes()) << "late";
  EXPECT_EQ(bench.poll(48, 50), reply) << "the fourth";
  EXPECT_EQ(exchange(), Bytes({9, 8, 7}));
  EXPECT_EQ(bench.poll(51, 51), reply);
  EXPECT_EQ(xgate_request_id(nullptr), 0);
  EXPECT_EQ(xgate_request_id(&host), 0);
}

TEST_P(XgateHost, AnAnswerThatTheModuleRefusesIsAskedForAgain) {
  to_exchange();
  exchange();
  bench.service(51, {0x5E, 1, 2, 2}, 51);
  reply = {0x5E, 3, 2, 1, 7};
  exchange();
  EXPECT_EQ(result, XGATE_ERR_MODULE);
  EXPECT_EQ(host.error_class, 4);
  EXPECT_EQ(host.error_code, 2);
  reply = {0x5E, 1, 2, 2, 7, 8};
  exchange();
  EXPECT_EQ(result, XGATE_OK);
  EXPECT_EQ(bench.poll(51, 51), reply);
}

TEST_P(XgateHost, AlarmsAndDiagnosis) {
  to_exchange();
  exchange();
  const Bytes alarm = {0x04, 0x02, 7, 0x28}, channel = {0x80, 0x41, 0x21};
  ASSERT_EQ(xgate_diagnose(&host, alarm.data(), 4), XGATE_OK);
  EXPECT_EQ(bench.diagnosis(), Bytes({0x08, 0x04, 0, kMaster, 0x0F, 0x01}) + alarm);
  bench.service(51, Bytes{0x5C, 7, 0x02, 0x28}, 51);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(exchange().size(), 3U);
  EXPECT_EQ(acknowledgements, 1);
  EXPECT_FALSE(bench.int_low());
  ASSERT_EQ(xgate_diagnose(&host, alarm.data(), 4), XGATE_OK);
  bench.diagnosis();
  bench.service(50, Bytes{0x5C, 7, 0x02, 0x28}, 51);
  for (int i = 0; i < 3; ++i) exchange();
  EXPECT_EQ(acknowledgements, 2);
  ASSERT_EQ(xgate_diagnose(&host, channel.data(), 3), XGATE_OK);
  EXPECT_EQ(bench.diagnosis(), Bytes({0x08, 0x04, 0, kMaster, 0x0F, 0x01}) + channel);
  ASSERT_EQ(xgate_diagnose(&host, nullptr, 0), XGATE_OK);
  EXPECT_EQ(bench.diagnosis().size(), 6U);
  EXPECT_EQ(xgate_diagnose(&host, Bytes(255).data(), 255), XGATE_ERR_ARGUMENT);
}

TEST_P(XgateHost, ErrorsOfTheModule) {
  EXPECT_TRUE(exchange().empty());
  EXPECT_EQ(result, XGATE_ERR_MODULE);
  EXPECT_EQ(host.error_class, 3);
  EXPECT_EQ(host.error_code, 4);
  EXPECT_EQ(frames, 1) << "a repetition would not help";
  xgate_config given = initialisation();
  given.address = 127;
  EXPECT_EQ(xgate_initialise(&host, &given), XGATE_ERR_MODULE);
  EXPECT_EQ(host.error_class, 1);
  given.cfg_length = 25;
  EXPECT_EQ(xgate_initialise(&host, &given), XGATE_ERR_ARGUMENT);
}

TEST_P(XgateHost, DamagedAndLostBytesAreRepeated) {
  to_exchange();
  bench.service(-1, {9, 8, 7});
  exchange();
  for (const int place : {6, 3, -6}) {  // 3: a length that is too short; -6: it is lost
    damaged_byte = std::abs(place);
    cut = place < 0;
    damage = 2;
    frames = 0;
    EXPECT_EQ(exchange(), Bytes({9, 8, 7}));
    EXPECT_EQ(frames, 3);
    damage = 3;
    EXPECT_TRUE(exchange().empty());
    EXPECT_EQ(result, XGATE_ERR_SILENT);
    EXPECT_EQ(exchange(), Bytes({9, 8, 7}));
  }
  bench.reset(true);
  frames = 0;
  EXPECT_TRUE(exchange().empty());
  EXPECT_EQ(result, XGATE_ERR_SILENT);
  EXPECT_EQ(frames, 3);
}

/// The length 83H of an error in the printed form is also that of 131 outputs.
TEST_P(XgateHost, Outputs131) {
  to_exchange(Bytes(8, 0x2F) + Bytes{0x22, 0x10}, 1, 131);
  Bytes outputs(131);
  for (std::size_t i = 0; i < outputs.size(); ++i) outputs[i] = static_cast<std::uint8_t>(i + 9);
  outputs[3] = 0x7E ^ 0x20 ^ 0x83 ^ 0x11 ^ 9 ^ 10 ^ 11;  // as the XOR of an error
  bench.service(-1, outputs);
  EXPECT_EQ(exchange({1}), outputs);
  EXPECT_EQ(exchange({1}), outputs);
  EXPECT_TRUE(exchange({1, 2}).empty());
  EXPECT_EQ(result, XGATE_ERR_MODULE);
}

std::vector<Choice> choices() {
  std::vector<Choice> all;
  for (const Port port : {Port::kUart, Port::kSpi})
    for (const ErrorForm errors : {ErrorForm::kFlag, ErrorForm::kPrinted})
      for (const MailboxForm boxes : {MailboxForm::kSpecial, MailboxForm::kShort}) all.push_back({port, errors, boxes});
  return all;
}
INSTANTIATE_TEST_SUITE_P(EveryChoice, XgateHost, testing::ValuesIn(choices()));

TEST(XgateHostArguments, AreChecked) {
  xgate_module host{};
  const xgate_port none{};
  const xgate_application application{};
  EXPECT_EQ(xgate_open(nullptr, &none, &application), XGATE_ERR_ARGUMENT);
  EXPECT_EQ(xgate_open(&host, &none, &application), XGATE_ERR_ARGUMENT);
  EXPECT_EQ(xgate_command(nullptr, 1, nullptr, 0), XGATE_ERR_ARGUMENT);
  EXPECT_EQ(xgate_command(&host, 1, nullptr, 1), XGATE_ERR_ARGUMENT);
  EXPECT_EQ(xgate_initialise(&host, nullptr), XGATE_ERR_ARGUMENT);
  EXPECT_EQ(xgate_exchange(&host, nullptr, 0, nullptr, 0, nullptr), XGATE_ERR_ARGUMENT);
}

}  // namespace
}  // namespace dsdpv1::xgate
