// The serial ports of the DSDPV1-RSU, the model alone, with mostly invalid frames and telegrams: after every few of
// them the port answers a valid one, and every violation that a host can commit at the port has been reported.
// DSDPV1_TELEGRAMS and DSDPV1_SEED in the environment select their number and content (docs/cosim.md has the figures of
// a long run).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <set>

#include "kinds/dsdpv1/random/host_verbs.hpp"
#include "kinds/dsdpv1/random/random_host.hpp"
#include "model/dsdpv1/chip.hpp"
#include "tests/conformance/host_telegrams.hpp"

namespace dsdpv1 {
namespace {

using conformance::with_crc;
using cosim::Action;
using cosim::Verb;
namespace verb = cosim::verb;

constexpr Tick kCycle = profibus::kTicksPerCycle;
constexpr std::uint16_t kReady = 0x004;  // no cell of a port's
constexpr int kRate = 7;

long from_environment(const char* name, long usual) {
  const char* text = std::getenv(name);
  return text == nullptr ? usual : std::atol(text);
}
long telegrams() { return from_environment("DSDPV1_TELEGRAMS", 2000); }
std::uint64_t seed() { return static_cast<std::uint64_t>(from_environment("DSDPV1_SEED", 1)); }

/// A chip at one of the ports, and a host that generates its telegrams from a seed.
class Port {
 public:
  Port(HostMode mode, std::uint64_t seed) : random_(seed) {
    Config config;
    config.part = Part::kRsu;
    config.u_timer = 20'000;
    chip_ = std::make_unique<Chip>(config);
    chip_->watch({[](void* self, Tick at, Pin, Level level) { static_cast<Port*>(self)->txd(at, level); }, this},
                 mask(Pin::kTxd));
    chip_->on_event({[](void* self, const profibus::Event& event) {
                       static_cast<Port*>(self)->told_.insert(profibus::code(event.reason));
                     },
                     this});
    host_ = (mode == HostMode::kSpi ? cosim::make_random_spi : cosim::make_random_uart)(random_, actions_);
    chip_->set(0, Pin::kMode, mode == HostMode::kSpi ? 1 : 2);
    chip_->set(0, Pin::kAdr, 1);
    chip_->set(0, Pin::kUbr, kRate);
    chip_->set(1000 * kCycle, Pin::kReset, 1);
  }

  /// Something random: telegrams, pins. How many telegrams it was.
  long anything() {
    actions_.clear();
    if (random_.one_in(20))
      host_->rude();
    else
      while (!host_->own_traffic()) {
      }
    long count = 0;
    for (const Action& each : actions_) count += play(each);
    return count;
  }
  bool answers_spi() {
    now_ += 40'000;  // SP9: 2.7 us after whatever it was
    Action action;
    action.verb = verb::kSpi;
    action.bytes = with_crc({0x01, 0, kReady, 1});
    const std::size_t request = action.bytes.size();
    const bus::Bytes reply = expected();
    action.bytes.resize(request + reply.size(), 0xFF);
    miso_.clear();
    play(action);
    return bus::Bytes(miso_.begin() + static_cast<std::ptrdiff_t>(request), miso_.end()) == reply;
  }
  bool answers_uart() {
    now_ += 300 * bus::kCharacterBits * cosim::uart_bit(kRate);  // the longest reply, the longest interval
    Action action;
    action.verb = verb::kUart;
    action.rate = kRate;
    action.bytes = with_crc({0x01, 0, kReady, 1});
    chip_->advance(now_);
    edges_.clear();
    const bus::Bytes reply = expected();
    play(action);
    now_ += 300 * bus::kCharacterBits * cosim::uart_bit(kRate);
    chip_->advance(now_);
    return heard(reply.size()) == reply;
  }
  /// Those of these codes that the chip has not reported.
  std::set<std::string> untold(std::initializer_list<const char*> codes) const {
    std::set<std::string> left;
    for (const char* code : codes)
      if (told_.count(code) == 0) left.insert(code);
    return left;
  }

 private:
  bus::Bytes expected() const { return with_crc({0x81, 0, chip_->peek(kReady)}); }
  long play(const Action& action) {
    now_ += action.delay;
    if (action.verb == Verb::kPin) chip_->set(now_, static_cast<Pin>(action.pin), static_cast<Level>(action.value));
    if (action.verb == verb::kSpi) return edges(cosim::spi_edges(action));
    if (action.verb == verb::kUart) return edges(cosim::uart_edges(action));
    return 0;
  }
  long edges(const std::vector<cosim::PinEdge>& list) {
    const Tick begin = now_;
    unsigned byte = 1;
    for (const cosim::PinEdge& each : list) {
      now_ = begin + each.at;
      chip_->set(now_, static_cast<Pin>(each.pin), each.level);
      if (each.pin != number(Pin::kSck) || each.level == 0) continue;
      byte = byte << 1 | (chip_->level(Pin::kMiso) != 0 ? 1U : 0U);
      if (byte > 0xFF) miso_.push_back(static_cast<std::uint8_t>(byte));
      if (byte > 0xFF) byte = 1;
    }
    return 1;
  }
  void txd(Tick at, Level level) { edges_.push_back({at, number(Pin::kTxd), level}); }
  /// The characters on TXD since the request, by its edges.
  bus::Bytes heard(std::size_t count) const {
    bus::Bytes bytes;
    if (edges_.empty()) return bytes;
    const Tick bit = cosim::uart_bit(kRate), begin = edges_.front().at;
    for (std::size_t i = 0; i < count; ++i) {
      std::uint8_t byte = 0;
      for (int k = 0; k < 8; ++k)
        if (level_at(begin + (static_cast<Tick>(i) * bus::kCharacterBits + k + 1) * bit + bit / 2))
          byte = static_cast<std::uint8_t>(byte | 1 << k);
      bytes.push_back(byte);
    }
    return bytes;
  }
  bool level_at(Tick at) const {
    const auto after =
        std::find_if(edges_.begin(), edges_.end(), [at](const cosim::PinEdge& edge) { return edge.at > at; });
    return after == edges_.begin() || (after - 1)->level != 0;
  }

  cosim::Random random_;
  cosim::Stimulus actions_;
  std::unique_ptr<Chip> chip_;
  std::unique_ptr<cosim::RandomHost> host_;
  Tick now_ = 10'000 * kCycle;  // it is initialised
  bus::Bytes miso_;
  std::vector<cosim::PinEdge> edges_;
  std::set<std::string> told_;
};

TEST(SerialPort, SpiAnswersARightFrameAfterWhateverCameBefore) {
  Port port(HostMode::kSpi, seed());
  long answered = 0;
  for (long sent = 0; sent < telegrams(); ++answered) {
    sent += port.anything();
    ASSERT_TRUE(port.answers_spi()) << "after " << sent << " frames";
  }
  EXPECT_GT(answered, telegrams() / 4);
  EXPECT_EQ(port.untold({"SPI_SCK_HIGH", "SPI_SCK_LOW", "SPI_XSS_LEAD", "SPI_XSS_LAG", "SPI_XSS_HIGH", "SPI_SCK_IDLE",
                         "SPI_MOSI_SETUP", "SPI_MOSI_HOLD", "SPI_BITS", "SPI_WRITE_GAP", "SPI_REPLY_CUT",
                         "TELEGRAM_CUT", "TELEGRAM_CRC"}),
            std::set<std::string>());
}

TEST(SerialPort, UartAnswersARightTelegramAfterWhateverCameBefore) {
  Port port(HostMode::kUart, seed());
  long answered = 0;
  for (long sent = 0; sent < telegrams(); ++answered) {
    sent += port.anything();
    ASSERT_TRUE(port.answers_uart()) << "after " << sent << " telegrams";
  }
  EXPECT_GT(answered, telegrams() / 4);
  EXPECT_EQ(port.untold({"UART_PARITY", "UART_FRAMING", "UART_HALF_DUPLEX", "TELEGRAM_CUT", "TELEGRAM_CRC"}),
            std::set<std::string>());
}

}  // namespace
}  // namespace dsdpv1
