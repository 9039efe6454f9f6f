// The SPI and the UART socket of the DSDPV1-RSU: times, responses, effects of a killed initiator.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "model/systemc/rsu_tlm.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::current_tick;
using dsdpv1::systemc::RsuTlmModule;
using dsdpv1::systemc::to_time;
using testing::ElementsAre;

namespace {

using Bytes = std::vector<std::uint8_t>;
const Bytes kReadB014 = {0x01, 0x00, 0x14, 0x01, 0x18, 0xCF}, kReply = {0x81, 0x00, 0x00, 0xE8, 0x21};  // R15
constexpr Tick kMisoDelay = 120;                                                                        // SP2
constexpr Tick kAt = 200 * kUs, kDelay = 777, kBit = 26 * 250;

struct Outcome {
  tlm::tlm_response_status response;
  Tick begin, end;
  sc_core::sc_time delay;
  Bytes data;
};

/// A chip, its initiator and their outputs.
struct Side : sc_core::sc_module, tlm::tlm_analysis_if<std::uint8_t> {
  RsuTlmModule chip;
  tlm_utils::simple_initiator_socket<Side> socket{"socket"};
  sc_core::sc_signal<bool> reset, low;
  Changes changes;
  bool throws = false, always_throws = false;  ///< at the next change, at each
  Bytes heard;
  std::vector<Tick> heard_at;

  Side(const sc_core::sc_module_name& name, HostMode mode) : sc_module(name), chip("chip", options(mode)) {
    socket.bind(mode == HostMode::kSpi ? chip.spi_socket : chip.uart_socket);
    chip.RESET(reset), chip.R_REQ(low), chip.R_STA(low);
    chip.uart_out.bind(*this);
    chip.on_pin = [this](Tick at, Pin pin, Level level) {
      changes.push_back({at, pin, level});
      if (std::exchange(throws, false) || always_throws) throw std::runtime_error("from on_pin");
    };
    thread([this] {
      wait_until(kUs);
      reset.write(true);
    });
  }
  static systemc::RsuTlmOptions options(HostMode mode) {
    systemc::RsuTlmOptions options;
    options.straps.mode = mode;
    options.report_violations = false;
    return options;
  }
  void write(const std::uint8_t& byte) override {
    heard.push_back(byte);
    heard_at.push_back(current_tick());
  }

  /// `change`: modifies the payload.
  Outcome transport(tlm::tlm_command command, Bytes data,
                    const std::function<void(tlm::tlm_generic_payload&)>& change = {}, Tick delay = 0) {
    tlm::tlm_generic_payload payload;
    payload.set_command(command);
    payload.set_data_ptr(data.data());
    payload.set_data_length(static_cast<unsigned>(data.size()));
    payload.set_streaming_width(static_cast<unsigned>(data.size()));
    if (change) change(payload);
    sc_core::sc_time local = to_time(delay);
    const Tick begin = current_tick();
    socket->b_transport(payload, local);
    return {payload.get_response_status(), begin, current_tick(), local, data};
  }
  /// The text of the exception that leaves a transaction.
  std::string thrown(const Bytes& data) {
    throws = true;
    try {
      transport(tlm::TLM_WRITE_COMMAND, data);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "nothing";
  }
  std::vector<tlm::tlm_response_status> refusals() {
    std::uint8_t enable = 0xFF;
    std::vector<tlm::tlm_response_status> all;
    const auto refused = [&](tlm::tlm_command command, const std::function<void(tlm::tlm_generic_payload&)>& change) {
      all.push_back(transport(command, {1, 2}, change).response);
    };
    refused(
        tlm::TLM_WRITE_COMMAND, [](auto& payload) { payload.set_address(1); });
    refused(
        tlm::TLM_WRITE_COMMAND, [](auto& payload) { payload.set_data_length(0); });
    refused(
        tlm::TLM_WRITE_COMMAND, [](auto& payload) { payload.set_streaming_width(1); });
    refused(
        tlm::TLM_WRITE_COMMAND, [&](auto& payload) { payload.set_byte_enable_ptr(&enable); });
    refused(tlm::TLM_WRITE_COMMAND, [](auto& payload) { payload.set_data_ptr(nullptr); });
    refused(tlm::TLM_IGNORE_COMMAND, {});
    return all;
  }
};

Bytes with_room(Bytes request) {
  request.resize(request.size() + kReply.size(), 0xFF);
  return request;
}

struct World {
  Side spi{"spi", HostMode::kSpi}, uart{"uart", HostMode::kUart};
  std::optional<Outcome> frame, next, after_kill, telegram, read, at_the_delay, after_the_delay;
  std::vector<tlm::tlm_response_status> of_spi, of_uart;
  std::string thrown_of_spi, thrown_of_uart;
  std::optional<Outcome> frame_after_throw, telegram_after_throw;
  std::vector<Level> released;  ///< XSS, SCK, MOSI of a killed frame
  Tick refused_until = 0;
  Bytes debug = Bytes(2);
  unsigned debugged = 0;
  static constexpr Tick kKill = 300 * kUs;

  World() {
    thread([this] { run_spi(); });
    thread([this] { run_uart(); });
  }
  void run_spi() {
    wait_until(kAt);
    frame = spi.transport(tlm::TLM_READ_COMMAND, with_room(kReadB014), {}, kDelay);
    next = spi.transport(tlm::TLM_WRITE_COMMAND, with_room(kReadB014));
    of_spi = spi.refusals();
    refused_until = current_tick();
    debugged = write_and_read_debug();
    auto killed = sc_core::sc_spawn([this] { spi.transport(tlm::TLM_WRITE_COMMAND, Bytes(200, 0x55)); });
    wait_until(kKill);
    killed.kill();
    wait_until(kKill + kUs);
    after_kill = spi.transport(tlm::TLM_READ_COMMAND, with_room(kReadB014));
    at_the_delay = read_with_low(kMisoDelay);
    after_the_delay = read_with_low(kMisoDelay + 1);
    thrown_of_spi = spi.thrown(kReadB014);
    wait_until(current_tick() + kUs);
    frame_after_throw = spi.transport(tlm::TLM_READ_COMMAND, with_room(kReadB014));
    kill_while_an_observer_throws();
  }
  void kill_while_an_observer_throws() {
    const Chip& chip = spi.chip.chip();
    auto killed = sc_core::sc_spawn([this] { spi.transport(tlm::TLM_WRITE_COMMAND, Bytes(200, 0xFF)); });
    while (chip.level(Pin::kSck) != 1 || chip.level(Pin::kMosi) != 1) wait_until(current_tick() + 100);
    spi.always_throws = true;
    killed.kill();
    spi.always_throws = false;
    for (const Pin pin : {Pin::kXss, Pin::kSck, Pin::kMosi}) released.push_back(chip.level(pin));
  }
  /// SCK is low for `low` ticks.
  Outcome read_with_low(Tick low) {
    return spi.transport(
        tlm::TLM_READ_COMMAND, with_room(kReadB014),
        [low](tlm::tlm_generic_payload& payload) {
          auto* special = new systemc::SpiFrameExtension;  // owned by the payload
          special->timing.low = low;
          payload.set_extension(special);
        });
  }
  unsigned write_and_read_debug() {
    Bytes written = {0x12, 0x34};
    tlm::tlm_generic_payload payload;
    payload.set_address(0x7FE);
    payload.set_data_length(2);
    payload.set_write();
    payload.set_data_ptr(written.data());
    const unsigned count = spi.socket->transport_dbg(payload);
    payload.set_read();
    payload.set_data_ptr(debug.data());
    return count + spi.socket->transport_dbg(payload);
  }
  void run_uart() {
    wait_until(kAt);
    telegram = uart.transport(tlm::TLM_WRITE_COMMAND, kReadB014, {}, kDelay);
    wait_until(kAt + 200 * kUs);
    of_uart = uart.refusals();
    read = uart.transport(tlm::TLM_READ_COMMAND, {0});
    auto killed = sc_core::sc_spawn([this] { uart.transport(tlm::TLM_WRITE_COMMAND, Bytes(200, 0x00)); });
    wait_until(kAt + 200 * kUs + 2 * kBit);
    killed.kill();
    wait_until(kAt + 300 * kUs);
    thrown_of_uart = uart.thrown({0x00});
    uart.throws = true;  // in a telegram that is killed: the exception goes with it
    killed = sc_core::sc_spawn([this] { uart.transport(tlm::TLM_WRITE_COMMAND, Bytes(200, 0x00)); });
    wait_until(kAt + 300 * kUs + 14 * kBit);
    killed.kill();
    wait_until(kAt + 400 * kUs);
    telegram_after_throw = uart.transport(tlm::TLM_WRITE_COMMAND, kReadB014);
  }
};

std::unique_ptr<World> world;

constexpr auto kAddress = tlm::TLM_ADDRESS_ERROR_RESPONSE, kBurst = tlm::TLM_BURST_ERROR_RESPONSE,
               kEnables = tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE, kGeneric = tlm::TLM_GENERIC_ERROR_RESPONSE,
               kCommand = tlm::TLM_COMMAND_ERROR_RESPONSE;

}  // namespace

void simulate() {
  set_resolution();
  collect_reports();
  world = std::make_unique<World>();
  sc_core::sc_start(700, sc_core::SC_US);
}

namespace {

Bytes behind(const Bytes& data, std::size_t request) { return {data.begin() + static_cast<long>(request), data.end()}; }

TEST(RsuSockets, ATransactionIsAFrameOfSpiWithItsReply) {
  const Tick duration = SpiFrame(with_room(kReadB014), SpiTiming()).duration();
  EXPECT_EQ(world->frame->response, tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(behind(world->frame->data, kReadB014.size()), kReply);
  EXPECT_EQ(world->frame->end, kAt + kDelay + duration);
  EXPECT_EQ(world->frame->delay, sc_core::SC_ZERO_TIME);
  const Changes xss = only(world->spi.changes, Pin::kXss);
  ASSERT_GE(xss.size(), 4U);
  EXPECT_EQ(xss[0], (Change{kAt + kDelay, Pin::kXss, 0}));
  EXPECT_EQ(xss[1], (Change{kAt + kDelay + duration, Pin::kXss, 1}));
  EXPECT_EQ(xss[2].at, xss[1].at + SpiTiming().gap) << "the next frame waits for the gap";
  EXPECT_EQ(world->next->data, with_room(kReadB014)) << "a write leaves its data alone";
}

TEST(RsuSockets, MisoIsSampledBeforeWhatChangesAtTheTickOfTheEdge) {
  EXPECT_EQ(behind(world->after_the_delay->data, kReadB014.size()), kReply);
  const Bytes late = behind(world->at_the_delay->data, kReadB014.size());
  for (std::size_t bit = 1; bit < 8 * kReply.size(); ++bit) {
    const auto at = [](const Bytes& bytes, std::size_t n) { return bytes.at(n / 8) >> (7 - n % 8) & 1; };
    EXPECT_EQ(at(late, bit), at(kReply, bit - 1)) << bit;
  }
}

TEST(RsuSockets, WrongTransactionsAreRefusedAtOnce) {
  EXPECT_THAT(world->of_spi, ElementsAre(kAddress, kBurst, kBurst, kEnables, kGeneric, kCommand));
  EXPECT_THAT(world->of_uart, ElementsAre(kAddress, kBurst, kBurst, kEnables, kGeneric, kCommand));
  EXPECT_EQ(world->refused_until, world->next->end);
  EXPECT_EQ(world->read->response, kCommand) << "bytes of the chip come through uart_out";
}

TEST(RsuSockets, DebugTransportReachesTheDpram) {
  EXPECT_EQ(world->debugged, 4U);
  EXPECT_EQ(world->debug, (Bytes{0x12, 0x34}));
}

TEST(RsuSockets, AKilledInitiatorLeavesIdlePinsAndTheNextFrameNeedNotWait) {
  EXPECT_THAT(only(world->spi.changes, Pin::kXss), testing::Contains(Change{World::kKill, Pin::kXss, 1}));
  EXPECT_THAT(only(world->spi.changes, Pin::kXss), testing::Contains(Change{World::kKill + kUs, Pin::kXss, 0}));
  EXPECT_EQ(behind(world->after_kill->data, kReadB014.size()), kReply);
  EXPECT_THAT(only(world->uart.changes, Pin::kRxd),
              testing::Contains(Change{kAt + 200 * kUs + 2 * kBit, Pin::kRxd, 1}));
}

TEST(RsuSockets, AKilledFrameReleasesItsPinsWhateverAnObserverThrows) {
  EXPECT_THAT(world->released, ElementsAre(1, 0, 0));
}

TEST(RsuSockets, ATransactionIsATelegramOfTheUartAndItsReplyComesByteByByte) {
  EXPECT_EQ(world->telegram->response, tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(world->telegram->end, kAt + kDelay + UartTelegram(kReadB014, UartTiming()).duration());
  EXPECT_EQ(Bytes(world->uart.heard.begin(), world->uart.heard.begin() + 5), kReply);
  const Tick first = only(world->uart.changes, Pin::kTxd).front().at;
  ASSERT_GE(world->uart.heard_at.size(), kReply.size());
  for (std::size_t i = 0; i < kReply.size(); ++i)
    EXPECT_EQ(world->uart.heard_at[i], first + static_cast<Tick>(i + 1) * 11 * kBit) << i;
}

TEST(RsuSockets, AnExceptionOfAnObserverLeavesTheTransactionAndTheNextIsAsUsual) {
  EXPECT_EQ(world->thrown_of_spi, "from on_pin");
  EXPECT_EQ(behind(world->frame_after_throw->data, kReadB014.size()),
            (Bytes{0x81, 0x00, 0x01, 0x28, 0xE0}));  // B014.0: an access of the chip
  EXPECT_EQ(world->thrown_of_uart, "from on_pin");
  EXPECT_EQ(world->telegram_after_throw->response, tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(Bytes(world->uart.heard.end() - 5, world->uart.heard.end()), kReply);
  EXPECT_EQ(world->uart.heard.size(), 2 * kReply.size());
}

}  // namespace
}  // namespace dsdpv1
