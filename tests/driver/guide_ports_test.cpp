// docs/programmers_guide.md: the cost of a call over SPI and UART, counted, and the examples of its chapter on them,
// which are compiled unchanged.
#include <fstream>
#include <sstream>

#include "tests/driver/acyclic_fixture.hpp"

extern "C" {
dsdpv1_error open_spi(dsdpv1_device* chip, const dsdpv1_judge* judge);
dsdpv1_error open_uart(dsdpv1_device* chip, const dsdpv1_judge* judge);
void board_select(bool selected);
std::uint8_t board_spi(std::uint8_t byte);
void board_wait_ns(std::uint32_t ns);
void board_put(std::uint8_t character);
void board_flush(void);
bool board_get(std::uint8_t* character);
std::uint32_t board_cycles(void);
}

namespace dsdpv1::board {

// Used by the examples' board functions; the examples are C and have no objects.
FakeRsu* rsu = nullptr;    // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
std::uint32_t cycles = 0;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

}  // namespace dsdpv1::board

void board_select(bool selected) {
  if (selected) dsdpv1::board::rsu->select();
}
std::uint8_t board_spi(std::uint8_t byte) { return dsdpv1::board::rsu->spi_byte(byte); }
void board_wait_ns(std::uint32_t /*ns*/) {}
void board_put(std::uint8_t character) { dsdpv1::board::rsu->uart_character(character); }
void board_flush() {}
bool board_get(std::uint8_t* character) { return dsdpv1::board::rsu->next_character(*character); }
std::uint32_t board_cycles() { return dsdpv1::board::cycles += 72; }

namespace dsdpv1 {
namespace {

using testing::ElementsAre;

struct Cost {
  std::size_t telegrams = 0, bytes = 0;
};

class Costs : public AcyclicTest {
 public:
  explicit Costs(FakePort port) : port_(port) {}
  FakePort port_kind() const override { return port_; }
  void TestBody() override {}
  std::vector<std::pair<std::string, Cost>> count();

 private:
  void begin(std::uint8_t most);
  void cyclic();
  void judged();
  void others();
  void acyclic_calls();
  void ask_for(const std::string& what, const Bytes& request);
  template <class Call>
  void cost(const std::string& what, Call call) {
    rsu.requests.clear();
    rsu.bytes = 0;
    EXPECT_EQ(call(), DSDPV1_OK) << what;
    costs_.push_back({what, {rsu.requests.size(), rsu.bytes}});
  }

  FakePort port_;
  std::vector<std::pair<std::string, Cost>> costs_;
};

void Costs::begin(std::uint8_t most) {
  config.max_input = 244;
  config.max_output = most;
  config.max_diag = 238;
  config.max_prm = 237;
  config.max_cfg = 200;
  initialise(2, 2);
  static_cast<void>(exchange({1}));
}

void Costs::cyclic() {
  begin(64);
  cost(
      "initialise, 2 configuration bytes", [&] { return dsdpv1_initialise(&device, &config); });
  cost("exchange, 8 inputs, no new outputs", [&] { return exchange(Bytes(8)); });
  for (const std::size_t length : {8U, 64U, 244U}) {
    if (length == 244U) begin(244);
    const std::string number = std::to_string(length);
    chip.put_outputs(Bytes(length));
    cost("exchange, " + number + " inputs, " + number + " outputs", [&] { return exchange(Bytes(length)); });
  }
}

void Costs::judged() {
  begin(64);
  static_cast<void>(exchange(Bytes(8)));
  chip.put_prm(Bytes(18));
  cost("service, 18 parameter bytes, verdict", [&] { return dsdpv1_service(&device); });
  chip.put_cfg(8, 8, Bytes(2));
  cost("service, 2 configuration bytes, verdict", [&] { return dsdpv1_service(&device); });
}

void Costs::others() {
  const Bytes data(238);
  cost(
      "set_diagnosis, 9 bytes", [&] { return dsdpv1_set_diagnosis(&device, DSDPV1_DIAG_STATIC, data.data(), 9); });
  cost("set_diagnosis, 238 bytes", [&] { return dsdpv1_set_diagnosis(&device, DSDPV1_DIAG_STATIC, data.data(), 238); });
  dsdpv1_status status{};
  cost("get_status", [&] { return dsdpv1_get_status(&device, &status); });
}

void Costs::ask_for(const std::string& what, const Bytes& request) {
  EXPECT_EQ(poll(), DSDPV1_OK);
  chip.put_request(1, request);
  cost(what, [&] { return poll(); });
}

void Costs::acyclic_calls() {
  table.objects = objects.data();
  table.count = objects.size();
  EXPECT_EQ(dsdpv1_acyclic_open(&acyclic, &device, &table), DSDPV1_OK);
  cost("acyclic_poll, no request", [&] { return poll(); });
  ask_for("acyclic_poll, read answered with 4 bytes", {0x5E, 1, 1, 4});
  ask_for("acyclic_poll, write of 4 bytes", {0x5F, 1, 1, 4, 1, 2, 3, 4});
  ask_for("acyclic_poll, read answered with 240 bytes", {0x5E, 1, 5, 240});
}

std::vector<std::pair<std::string, Cost>> Costs::count() {
  AcyclicTest::SetUp();
  cyclic();
  judged();
  others();
  acyclic_calls();
  AcyclicTest::TearDown();
  return costs_;
}

TEST(GuidePorts, TableSaysWhatCallsCost) {
  std::ifstream file(GUIDE);
  std::stringstream guide;
  guide << file.rdbuf();
  const auto spi = Costs(FakePort::kSpi).count(), uart = Costs(FakePort::kUart).count();
  for (std::size_t i = 0; i < spi.size(); ++i) {
    std::ostringstream row;
    row << "| " << spi[i].first << " | " << spi[i].second.telegrams << " | " << spi[i].second.bytes << " | "
        << uart.at(i).second.telegrams << " | " << uart.at(i).second.bytes << " |\n";
    EXPECT_NE(guide.str().find(row.str()), std::string::npos) << "the guide should say: " << row.str();
  }
}

/// The examples, run on the fake chip.
class GuidePortExample : public DriverTest {
 protected:
  void SetUp() override {
    DriverTest::SetUp();
    chip.looks_at_crcs = false;
    board::rsu = &rsu;
  }
  void expect_to_work() {
    initialise();
    chip.put_outputs({3, 4});
    EXPECT_EQ(exchange({1, 2}), DSDPV1_OK);
    EXPECT_THAT(chip.inputs, ElementsAre(1, 2));
    EXPECT_THAT(received(), ElementsAre(3, 4));
    rsu.deaf = 2;
    EXPECT_EQ(exchange({5}), DSDPV1_OK);
  }
};

TEST_F(GuidePortExample, OfSpi) {
  ASSERT_EQ(open_spi(&device, &judge), DSDPV1_OK);
  expect_to_work();
}

TEST_F(GuidePortExample, OfUart) {
  ASSERT_EQ(open_uart(&device, &judge), DSDPV1_OK);
  expect_to_work();
}

}  // namespace
}  // namespace dsdpv1
