// The checks of the host: a right one violates none, and each rule is found broken by a fault planted for it.
#include "kinds/xgate/checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "kinds/xgate/kind.hpp"
#include "kinds/xgate/pins.hpp"

namespace dsdpv1::xgate {
namespace {

using bus::Tick;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;
using Bytes = std::vector<std::uint8_t>;
constexpr Tick kUs = bus::kTicksPerUs, kMs = bus::kTicksPerMs;

Bytes frame(std::uint8_t command, std::uint8_t special, const Bytes& data) {
  Bytes bytes = {0x7E, command, static_cast<std::uint8_t>(data.size()), special};
  bytes.insert(bytes.end(), data.begin(), data.end());
  std::uint8_t sum = 0;
  for (const std::uint8_t byte : bytes) sum ^= byte;
  bytes.push_back(sum);
  return bytes;
}

const Bytes kRequest1 = {1, 4, 0, 0x5E, 1, 2, 8, 0x55}, kRequest2 = {2, 4, 0, 0x5E, 1, 3, 8, 0x54};
const Bytes kAnswer1 = {1, 5, 0, 0x5E, 1, 2, 1, 9, 0x55}, kAnswer2 = {2, 5, 0, 0x5E, 1, 3, 1, 9, 0x54};
Bytes both(Bytes first, const Bytes& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Host and module at the pins, byte by byte: 100 kbit/s by UART, 1 Mbit/s by SPI.
class Line {
 public:
  explicit Line(Port port = Port::kUart, std::uint32_t rate = 100'000) : config_(config(port, rate)), rate_(rate) {
    checks_.on_violation([this](const checks::Violation& violation) {
      said_[xgate_checks::rules().at(violation.check.index).id] += violation.text + "\n";
    });
    pin(kit::kReset, 0);
    pin(kit::kReset, 1);
    pass(11 * kMs);
  }

  void pin(kit::PinNumber number, kit::Level level) { checks_.pin(now_, number, level); }
  void pass(Tick time) { now_ += time; }
  void set_rate(std::uint32_t rate) { rate_ = rate; }

  void uart(kit::PinNumber wire, std::uint8_t byte, std::uint32_t rate, bool stop = true) {
    const Tick bit = bus::kTicksPerSecond / rate;
    unsigned bits = byte * 2U | (stop ? 0x200U : 0U);
    for (int i = 0; i < 10; ++i, bits >>= 1U, pass(bit)) level(wire, bits & 1U);
    level(wire, 1);
  }
  /// Bits of a byte by SPI, in mode 0.
  void spi(std::uint8_t mosi, std::uint8_t miso, int bits = 8, Tick half = 500 * bus::kTicksPerNs) {
    for (int i = 7; i > 7 - bits; --i) {
      level(kMosi, mosi >> i & 1U);
      level(kMiso, miso >> i & 1U);
      pass(half);
      pin(kSck, 1);
      pass(half);
      pin(kSck, 0);
    }
  }
  void select(bool on) {
    pass(kUs);
    pin(kNss, on ? 0 : 1);
    pass(kUs);
  }

  void host(const Bytes& bytes) {
    if (config_.port == Port::kUart) {
      for (const std::uint8_t byte : bytes) uart(kHostRxd, byte, rate_);
      return;
    }
    select(true);
    for (const std::uint8_t byte : bytes) spi(byte, 0xFF);
    select(false);
  }
  void module(const Bytes& bytes) {
    pass(500 * kUs);
    if (config_.port == Port::kUart) {
      for (const std::uint8_t byte : bytes) uart(kHostTxd, byte, rate_);
      return;
    }
    select(true);
    spi(0xFF, 0xFF);
    for (const std::uint8_t byte : bytes) spi(0xFF, byte);
    select(false);
  }
  /// A command and its answer.
  void exchange(std::uint8_t command, std::uint8_t answer, const Bytes& data = {}, std::uint8_t special = 0x11,
                std::uint8_t flags = 0x11) {
    host(frame(command, special, {1, 2}));
    module(frame(answer, flags, data));
    pass(100 * kUs);
  }

  /// Command 30, with a right answer or error 4/2.
  void answer_requests(const Bytes& answers, bool right = true) {
    host(frame(0x30, 0x11, answers));
    module(right ? frame(0x20, 0x11, {3}) : frame(0x20, 0x91, {4, 2, 0}));
    pass(100 * kUs);
  }

  /// The rules that were broken, each with what is said.
  std::map<std::string, std::string> finish() {
    pass(5 * kMs);
    checks_.finish(now_);
    return said_;
  }
  std::uint64_t count(xgate_checks::Check check) const { return checks_.record(check).count; }
  const checks::ChipChecks& checks() const { return checks_; }

 private:
  static Config config(Port port, std::uint32_t rate) {
    Config config;
    config.port = port;
    config.rate = rate;
    return config;
  }
  void level(kit::PinNumber wire, unsigned level) {
    if (levels_[wire] == static_cast<int>(level)) return;
    levels_[wire] = static_cast<int>(level);
    pin(wire, static_cast<kit::Level>(level));
  }

  const Config config_;
  std::uint32_t rate_;
  Tick now_ = 0;
  std::map<kit::PinNumber, int> levels_ = {{kHostRxd, 1}, {kHostTxd, 1}};
  std::map<std::string, std::string> said_;
  xgate_checks::Checks checks_{checks::Limits(xgate_checks::rules()), kind().pins(), config_, 0};
};

void use(Line& line) {
  line.pin(kInt, 0);
  line.exchange(0x20, 0x21, {3});
  line.exchange(0x21, 0x21, {3});
  line.exchange(0x22, 0x22, {0, 0, 0, 9});
  line.exchange(0x20, 0x30, kRequest1);
  line.answer_requests(kAnswer1);
  line.pin(kInt, 1);
  line.exchange(0x31, 0x20, {3}, 0x11, 0x51);
  line.exchange(0x20, 0x20, {3}, 0x51);
  line.exchange(0x04, 0x04, {1, 4, 0}, 0x11, 0x91);
}

TEST(XgateChecks, FindNothingWithARightHostByUart) {
  Line line;
  use(line);
  EXPECT_THAT(line.finish(), IsEmpty());
  using xgate_checks::Check;
  for (const Check each :
       {Check::kLineRate, Check::kLineStop, Check::kFrameGap, Check::kFrameForm, Check::kAnswerAwaited,
        Check::kResetAwaited, Check::kIntServed, Check::kQueueAnswered, Check::kParametersTaken, Check::kAlarmCleared})
    EXPECT_GT(line.count(each), 0U) << xgate_checks::rules().at(static_cast<std::size_t>(each)).id;
  EXPECT_FALSE(line.checks().applies(Check::kSckPeriod));
}

TEST(XgateChecks, FindNothingWithARightHostBySpi) {
  Line line(Port::kSpi);
  use(line);
  EXPECT_THAT(line.finish(), IsEmpty());
  using xgate_checks::Check;
  for (const Check each : {Check::kSckPeriod, Check::kNssBytes, Check::kFrameGap, Check::kFrameForm,
                           Check::kResetAwaited, Check::kIntServed, Check::kQueueAnswered})
    EXPECT_GT(line.count(each), 0U) << xgate_checks::rules().at(static_cast<std::size_t>(each)).id;
  EXPECT_FALSE(line.checks().applies(Check::kAnswerAwaited));
}

/// A fault of the host, the rule that it breaks alone, and a word of what is said.
struct Planted {
  const char* id;
  Port port;
  void (*fault)(Line&);
  const char* said;
};

const Planted kPlanted[] = {
    {"LINE_RATE", Port::kUart,
     [](Line& line) {
       line.set_rate(95'000);  // 5 %: still heard right
       line.host({0x7E});
       line.set_rate(100'000);
       line.host({0x20, 0x00, 0x11, 0x4F});
     },
     "an edge in the byte"},
    {"LINE_STOP", Port::kUart,
     [](Line& line) {
       line.exchange(0x20, 0x20);
       line.uart(kHostRxd, 0x00, 100'000, false);
     },
     "the stop bit is low"},
    {"SCK_PERIOD", Port::kSpi,
     [](Line& line) {
       line.select(true);
       line.spi(0xFF, 0xFF, 8, 80 * bus::kTicksPerNs);
       line.select(false);
     },
     "160.000 ns"},
    {"NSS_BYTES", Port::kSpi,
     [](Line& line) {
       line.select(true);
       line.spi(0x7E, 0xFF, 5);
       line.select(false);
     },
     "after 5 bits of a byte"},
    {"FRAME_GAP", Port::kUart,
     [](Line& line) {
       line.host({0x7E, 0x20});
       line.pass(5 * kMs);
     },
     "no byte after 2 of a frame"},
    {"FRAME_FORM", Port::kUart,
     [](Line& line) {
       line.host({0x7E, 0x20, 0x00, 0x11, 0x00});
     },
     "command 20: wrong XOR"},
    {"FRAME_FORM", Port::kSpi, [](Line& line) { line.host(frame(0x20, 0x21, {})); }, "not segment 1 of 1"},
    {"FRAME_FORM", Port::kUart, [](Line& line) { line.host({0x20}); }, "20 outside of a frame"},
    {"ANSWER_AWAITED", Port::kUart,
     [](Line& line) {
       line.host(frame(0x20, 0x11, {1}));
       line.host({0x7E, 0x20});
       line.module(frame(0x20, 0x11, {3}));
     },
     "the end of the answer"},
    {"RESET_AWAITED", Port::kUart,
     [](Line& line) {
       line.pin(kit::kReset, 0);
       line.pass(kMs);
       line.pin(kit::kReset, 1);
       line.pass(9 * kMs);
       line.host({0x7E});
     },
     "9.000 ms"},
    {"INT_SERVED", Port::kUart,
     [](Line& line) {
       line.pin(kInt, 0);
       line.pass(101 * kMs);
     },
     "it is low still"},
    {"QUEUE_ANSWERED", Port::kSpi,
     [](Line& line) {
       line.exchange(0x20, 0x30, kRequest1);
       line.pass(101 * kMs);
     },
     "no command 30 for the request with id 1"},
    {"QUEUE_ANSWERED", Port::kUart,  // the module refuses the answer
     [](Line& line) {
       line.exchange(0x20, 0x30, kRequest1);
       line.answer_requests(kAnswer1, false);
       line.pass(101 * kMs);
     },
     "no command 30 for the request with id 1"},
    {"QUEUE_ANSWERED", Port::kUart,  // one of two is answered again and again
     [](Line& line) {
       for (int turn = 0; turn < 6; ++turn) {
         line.exchange(0x20, 0x30, both(kRequest1, kRequest2));
         line.answer_requests(kAnswer1);
         line.pass(20 * kMs);
       }
     },
     "no command 30 for the request with id 2"},
    {"PARAMETERS_TAKEN", Port::kUart,
     [](Line& line) {
       line.exchange(0x20, 0x21, {1});
       line.pass(101 * kMs);
       line.exchange(0x21, 0x21, {1});
     },
     "no command 21"},
    {"ALARM_CLEARED", Port::kUart,
     [](Line& line) {
       line.exchange(0x20, 0x20, {1}, 0x11, 0x51);
       line.pass(101 * kMs);
     },
     "no command with special bit 6"},
};

TEST(XgateChecks, EachFindsTheFaultPlantedForItAndNothingElse) {
  std::set<std::string> found;
  for (const Planted& planted : kPlanted) {
    SCOPED_TRACE(planted.id);
    Line line(planted.port);
    planted.fault(line);
    const auto said = line.finish();
    ASSERT_EQ(said.size(), 1U) << testing::PrintToString(said);
    EXPECT_EQ(said.begin()->first, planted.id);
    EXPECT_THAT(said.begin()->second, HasSubstr(planted.said));
    found.insert(planted.id);
  }
  EXPECT_EQ(found.size(), xgate_checks::rules().size());
}

TEST(XgateChecks, FollowTheRateOfCommand03) {
  Line line;
  line.host(frame(0x03, 0x11, {0x00, 0x4B, 0x00}));  // 19 200 bit/s
  line.module(frame(0x03, 0x11, {}));
  line.pass(2 * kMs);
  line.set_rate(19'200);
  line.exchange(0x20, 0x20, {1});
  EXPECT_THAT(line.finish(), IsEmpty());
  EXPECT_EQ(line.count(xgate_checks::Check::kFrameForm), 2U);
}

TEST(XgateChecks, NeitherRequestsNorParametersOutliveDataExchange) {
  Line line;
  line.exchange(0x20, 0x30, kRequest1);
  line.exchange(0x20, 0x21, {1});
  line.exchange(0x20, 0x20, {3, 3, 0}, 0x11, 0x91);
  line.pass(200 * kMs);
  EXPECT_THAT(line.finish(), IsEmpty());
}

TEST(XgateChecks, RequestsThatTheMasterWithdrawsNeedNoAnswer) {
  Line line;
  line.exchange(0x20, 0x30, both(kRequest1, kRequest2));
  line.exchange(0x20, 0x30, kRequest2);
  line.answer_requests(kAnswer2);
  line.pass(200 * kMs);
  EXPECT_THAT(line.finish(), IsEmpty());
  EXPECT_EQ(line.count(xgate_checks::Check::kQueueAnswered), 1U);
}

}  // namespace
}  // namespace dsdpv1::xgate
