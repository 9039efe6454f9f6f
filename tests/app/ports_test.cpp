// The DSDPV1-RSU on its three ports: the same application and masters must give the same telegrams on the bus.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using Bytes = std::vector<int>;

Bytes bytes_of(const std::string& hex) {
  std::istringstream in(hex);
  Bytes bytes;
  for (int byte = 0; in >> std::hex >> byte;) bytes.push_back(byte);
  return bytes;
}

/// DA, SA, FC and data of a telegram SD1 or SD2; empty for a token or a short acknowledge.
Bytes body(const Bytes& telegram) {
  if (telegram.size() < 6) return {};
  const int begin = telegram[0] == 0x68 ? 4 : 1;
  return {telegram.begin() + begin, telegram.end() - 2};
}

/// Requests with their answers, by requester and SAPs, in sequence, each only once however often it is repeated. The
/// user's speed determines how often a master asks, but not the answers. FCB and FCV, which count the requests, are
/// ignored.
class Conversations {
 public:
  explicit Conversations(const std::string& log) {
    std::ifstream file(log);
    for (std::string line; std::getline(file, line);) {
      const auto entry = nlohmann::json::parse(line);
      if (entry.at("kind") == "telegram") hear(bytes_of(entry.at("bytes")));
    }
  }
  using Pair = std::pair<Bytes, Bytes>;
  std::map<Bytes, std::vector<Pair>> pairs;

 private:
  void hear(const Bytes& telegram) {
    Bytes heard = body(telegram);
    if (!heard.empty() && (heard[2] & 0x40) != 0) {
      heard[2] &= ~0x30;
      request_ = heard;
      return;
    }
    if (!heard.empty() && !request_.empty()) note({request_, heard});
    if (telegram.size() != 3) request_.clear();  // a token is neither of the two
  }
  void note(const Pair& pair) {
    const Bytes& request = pair.first;
    Bytes key = {request[1]};
    if ((request[0] & 0x80) != 0) key.insert(key.end(), request.begin() + 3, request.begin() + 5);
    std::vector<Pair>& list = pairs[key];
    if (list.empty() || list.back() != pair) list.push_back(pair);
  }
  Bytes request_;
};

Conversations heard_in(const std::string& scenario, const std::string& settings = "") {
  const app_test::Folder folder;
  const auto called = call(std::string("run ") + DSDPV1_SOURCE_DIR + "/scenarios/" + scenario +
                               ".yaml --log log.jsonl --log-whole -q" + settings,
                           folder.path());
  EXPECT_EQ(called.status, 0) << scenario << called.err;
  return Conversations(folder.file("log.jsonl"));
}

TEST(HostPorts, TheBusHearsTheSameThroughAllOfThem) {
  const auto parallel = heard_in("rsu_parallel").pairs;
  EXPECT_EQ(parallel.size(), 5U) << "Data_Exchange, Slave_Diag, C1; C2's connection and its start";
  EXPECT_EQ(parallel.at({2}).size(), 13U);
  for (const char* other : {"rsu_spi", "rsu_uart", "r"}) EXPECT_EQ(heard_in(other).pairs, parallel) << other;
}

#ifdef FIRMWARE_O2

/// The ARM board's firmware on each port, by polling and by interrupts.
TEST(HostPorts, TheBusHearsTheSameOfFirmwareThroughAllOfThem) {
  const auto parallel = heard_in("arm_spi", std::string(" --set chip.mode=parallel")).pairs;
  EXPECT_EQ(parallel.size(), 5U);
  EXPECT_EQ(parallel.at({2}).size(), 9U);
  for (const char* elf : {FIRMWARE_O2, FIRMWARE_INTERRUPTS})
    for (const char* port : {"arm_spi", "arm_uart"})
      EXPECT_EQ(heard_in(port, std::string(" --set user_cpu.elf=") + elf).pairs, parallel) << port << elf;
}

#endif

/// The text of a shipped scenario without the lines for name, rate and end.
std::string without_rate(const std::string& scenario) {
  std::istringstream lines(app_test::read(std::string(DSDPV1_SOURCE_DIR "/scenarios/") + scenario + ".yaml"));
  std::string rest;
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("name:", 0) != 0 && line.rfind("end:", 0) != 0 && line.rfind("chip:", 0) != 0) rest += line + "\n";
  return rest;
}

TEST(HostPorts, EachRateOfTheUartHasTheSameTelegrams) {
  const std::string fastest = without_rate("rsu_uart_1m8432");
  EXPECT_THAT(fastest, testing::HasSubstr("host_telegram"));
  for (const char* rate : {"9k6", "19k2", "38k4", "57k6", "115k2", "230k4", "460k8"})
    EXPECT_EQ(without_rate(std::string("rsu_uart_") + rate), fastest) << rate;
}

/// Log entries of the kind `host` of a run of a shipped scenario.
std::vector<nlohmann::json> host_telegrams(const std::string& scenario) {
  const app_test::Folder folder;
  const auto called =
      call("run " DSDPV1_SOURCE_DIR "/scenarios/" + scenario + ".yaml --log log.jsonl -q", folder.path());
  EXPECT_EQ(called.status, 0) << called.err;
  std::ifstream file(folder.file("log.jsonl"));
  std::vector<nlohmann::json> found;
  for (std::string line; std::getline(file, line);)
    if (auto entry = nlohmann::json::parse(line); entry.at("kind") == "host") found.push_back(std::move(entry));
  return found;
}

// The first one: a character of 11 bits of 1/1843200 s each, six of them from the order on (UA1, UA5).
TEST(HostPorts, TheLogHasTheirTelegrams) {
  const auto telegrams = host_telegrams("rsu_uart_1m8432");
  ASSERT_EQ(telegrams.size(), 21U + 16U) << "requests and replies";
  EXPECT_EQ(telegrams[0].at("station"), "card");
  EXPECT_EQ(telegrams[0].at("text"), "read B004, length 1, card 1, CRC right");
  EXPECT_EQ(telegrams[0].at("bytes"), "01 00 04 01 D8 C2");
  EXPECT_FALSE(telegrams[0].contains("wrong"));
  EXPECT_NEAR(telegrams[0].at("at_ns").get<double>(), 100'000 + 66e9 / 1'843'200, 100);
  EXPECT_EQ(telegrams[1].at("bytes"), "81 00 C5 BB E1");
  EXPECT_EQ(telegrams[14].at("wrong"), "CRC D8C2, computed 48C3");
}

/// Runs a shipped scenario with these additional orders for its drive; returns the log.
std::string with_orders(const std::string& scenario, const std::vector<std::string>& orders,
                        const std::string& settings = "") {
  const app_test::Folder folder;
  const std::filesystem::path shipped = std::filesystem::path(DSDPV1_SOURCE_DIR) / "scenarios";
  std::filesystem::copy(shipped / "dsdpv1.gsd", folder.path() / "dsdpv1.gsd");
  std::string text = app_test::read(shipped / (scenario + ".yaml"));
  std::string script = "script:\n";
  for (const std::string& order : orders) script += "  - {slave: drive, " + order + "}\n";
  text.replace(text.find("script:\n"), 8, script);
  std::ofstream(folder.file("run.yaml")) << text
                                         << "allow: [{event: SPI_BITS}, {event: RXD_PARITY}, {event: "
                                            "RXD_CHARACTER_GAP}, {event: USER_REFUSED}]\n";  // meant
  const auto called = call("run run.yaml --log log.txt -q" + settings, folder.path());
  EXPECT_EQ(called.status, 0) << scenario << called.err;
  return app_test::read(folder.path() / "log.txt");
}

using testing::HasSubstr;
using testing::Not;

TEST(HostPorts, TelegramsThatGoWrongOverSpiAreRepeated) {
  const std::string log =
      with_orders("rsu_spi", {"at: 114ms, do: flip_bit, times: 2", "at: 120ms, do: cut_telegram, times: 2"});
  EXPECT_THAT(log, HasSubstr("TELEGRAM_CRC"));
  EXPECT_THAT(log, HasSubstr("SPI_BITS"));
  EXPECT_THAT(log, HasSubstr("TELEGRAM_CUT"));
  EXPECT_THAT(log, Not(HasSubstr("the driver's")));
}

const std::vector<std::string> kUartOrders = {
    "do: flip_bit, times: 2, at: ", "do: cut_telegram, times: 2, at: ", "do: wrong_parity, times: 2, at: "};

void expect_repeated_over_the_uart(const std::string& log) {
  for (const char* reason : {"TELEGRAM_CRC", "TELEGRAM_CUT", "UART_PARITY"}) EXPECT_THAT(log, HasSubstr(reason));
  EXPECT_THAT(log, Not(HasSubstr("the driver's")));
}

TEST(HostPorts, TelegramsThatGoWrongOverTheUartAreRepeated) {
  expect_repeated_over_the_uart(
      with_orders("rsu_uart", {kUartOrders[0] + "112ms", kUartOrders[1] + "116ms", kUartOrders[2] + "120ms"}));
}

#ifdef FIRMWARE_O2

TEST(HostPorts, FirmwareRepeatsTelegramsOverSpiAndHoldsTheDpram) {
  const std::string log = with_orders("arm_spi",
                                      {"at: 28ms, do: flip_bit, times: 2", "at: 30ms, do: cut_telegram, times: 2",
                                       "at: 32ms, do: hold_dpram, for: 3ms"},
                                      std::string(" --set user_cpu.elf=") + FIRMWARE_INTERRUPTS);
  EXPECT_THAT(log, HasSubstr("TELEGRAM_CRC"));
  EXPECT_THAT(log, HasSubstr("TELEGRAM_CUT"));
  EXPECT_THAT(log, testing::ContainsRegex("SPI_RELEASED: .* after 65535 cycles"));  // or more: 1.4 ms
  EXPECT_THAT(log, Not(HasSubstr("the driver's")));
}

TEST(HostPorts, FirmwareRepeatsTelegramsOverTheUart) {
  for (const char* elf : {FIRMWARE_O2, FIRMWARE_INTERRUPTS})
    expect_repeated_over_the_uart(
        with_orders("arm_uart", {kUartOrders[0] + "28ms", kUartOrders[1] + "30ms", kUartOrders[2] + "32ms"},
                    std::string(" --set user_cpu.elf=") + elf));
}

#endif

}  // namespace
}  // namespace dsdpv1
