// Random host traffic, right and mutated, in step, skip and dozing: the three agree, nothing hangs, and the next right
// telegram is answered.
#include <random>

#include "tests/conformance/rsu_bench.hpp"

namespace dsdpv1::conformance {
namespace {

class Traffic {
 public:
  explicit Traffic(unsigned seed) : random_(seed) {}

  int below(int limit) { return static_cast<int>(random_() % static_cast<unsigned>(limit)); }
  bool one_in(int n) { return below(n) == 0; }
  std::uint8_t byte() { return static_cast<std::uint8_t>(below(256)); }

  Bytes telegram(bool exchanges) {
    const auto card = static_cast<std::uint8_t>(one_in(8) ? below(4) : 1);
    Bytes telegram;
    switch (below(6)) {
      case 0: telegram = write_telegram(0x014, {static_cast<std::uint8_t>(one_in(3) ? 0 : 2)}, card); break;
      case 1: telegram = read_telegram(address(), static_cast<std::uint8_t>(below(12)), card); break;
      case 2: telegram = read_telegram(0x014, 1, card); break;
      case 3: telegram = write_telegram(address(), data(), card); break;
      default:
        telegram = exchanges ? exchange_telegram(byte() & 3, area(), data(), card) : inputs_telegram(data(), card);
    }
    return mutated(telegram);
  }

 private:
  std::uint16_t address() {
    constexpr std::uint16_t kCells[] = {0x000, 0x00A, 0x00E, 0x010, 0x012, 0x014,
                                        0x018, 0x020, 0x130, 0x319, 0x7F8, 0x0800};
    return static_cast<std::uint16_t>(kCells[below(12)] + below(4));
  }
  std::uint16_t area() {
    constexpr std::uint16_t kAreas[] = {0x130, 0x130, 0x227, 0x5D0, 0x6D0, 0x319};
    return kAreas[below(6)];
  }
  Bytes data() {
    Bytes data(static_cast<std::size_t>(below(one_in(40) ? 250 : 6)));
    for (std::uint8_t& each : data) each = byte();
    return data;
  }
  Bytes mutated(Bytes telegram) {
    if (!one_in(4)) return telegram;
    switch (below(4)) {
      case 0:
        telegram[static_cast<std::size_t>(below(static_cast<int>(telegram.size())))] ^=
            static_cast<std::uint8_t>(1 << below(8));
        break;
      case 1: telegram.resize(1 + static_cast<std::size_t>(below(static_cast<int>(telegram.size())))); break;
      case 2: telegram.resize(telegram.size() + static_cast<std::size_t>(below(9)), byte()); break;
      default: telegram[0] = byte();
    }
    return telegram;
  }
  std::mt19937 random_;
};

Config config_of(Traffic& traffic) {
  Config config;
  if (traffic.one_in(3)) config.u_timer = 48 + static_cast<std::uint32_t>(traffic.below(3000));
  if (traffic.one_in(4)) config.spi_reply_gap = static_cast<std::uint32_t>(traffic.below(17));
  if (traffic.one_in(4)) config.spi_write_gap = static_cast<std::uint32_t>(traffic.below(200));
  if (traffic.one_in(4)) config.access_interval = 16 + static_cast<std::uint32_t>(traffic.below(100));
  if (traffic.one_in(4)) config.spi_miso_delay = 1 + static_cast<std::uint32_t>(traffic.below(600));
  return config;
}

class RsuRandom : public ::testing::TestWithParam<unsigned> {};

TEST_P(RsuRandom, Spi) {
  Traffic traffic(GetParam());
  const Config config = config_of(traffic);
  RsuBench bench({}, config);
  bench.power_on();
  int answered = 0;
  for (int i = 0; i < 600; ++i) {
    Bytes mosi = traffic.telegram(false);
    mosi.resize(mosi.size() + static_cast<std::size_t>(traffic.below(10)), 0xFF);
    RsuBench::Frame frame;
    frame.high = 100 + traffic.below(600);
    frame.low = 250 + traffic.below(600);
    frame.lead = frame.low + traffic.below(500);
    frame.lag = traffic.below(900);
    if (traffic.one_in(20)) frame.bits = 1 + traffic.below(7);
    const Bytes miso = bench.spi(mosi, frame);
    answered += miso.back() != 0xFF ? 1 : 0;
    bench.run_until(bench.now() + (traffic.one_in(3) ? traffic.below(2000) : 33'000 + traffic.below(9000)));
    if (traffic.one_in(200)) bench.reset_for(1 + traffic.below(50)), bench.run_cycles(traffic.below(3000));
    if (HasFailure()) return;
    if (i % 100 == 99) bench.forget_events();
  }
  bench.run_cycles(6000);
  const Bytes miso = bench.ask(read_telegram(0x014, 1), config.spi_reply_gap + 5);
  EXPECT_EQ(part_of(miso, config.spi_reply_gap, 2), (Bytes{0x81, 0x00}));
  EXPECT_GT(answered, 10);  // of writes, short silences and mutations many are not
}

TEST_P(RsuRandom, Uart) {
  Traffic traffic(GetParam());
  Straps straps;
  straps.mode = HostMode::kUart;
  RsuBench bench(straps, config_of(traffic));
  bench.power_on();
  const auto silence = [&] { bench.run_cycles(Cycle{26} * 60); };
  for (int i = 0; i < 120; ++i) {
    const Bytes telegram = traffic.telegram(true);
    for (const std::uint8_t byte : telegram) bench.send(byte, {traffic.one_in(200), traffic.one_in(200)});
    if (traffic.one_in(10)) {
      bench.run_cycles(traffic.below(1500));
      bench.send(traffic.byte(), {});
    }
    bench.set(bench.now(), Pin::kRxd, 1);
    if (traffic.one_in(4))
      bench.run_cycles(traffic.below(1200));
    else
      silence();
    for (int glitch = traffic.one_in(10) ? traffic.below(30) : 0; glitch > 0; --glitch) {
      bench.set(bench.now(), Pin::kRxd, static_cast<Level>(glitch % 2));
      bench.run_until(bench.now() + traffic.below(3000));
    }
    bench.set(bench.now(), Pin::kRxd, 1);
    if (HasFailure()) return;
  }
  bench.run_cycles(Cycle{26} * 11 * 400);
  const Bytes version = bench.talk(read_telegram(0x014, 1));
  EXPECT_EQ(part_of(version, 0, 2), (Bytes{0x81, 0x00}));
}

INSTANTIATE_TEST_SUITE_P(Seeds, RsuRandom, ::testing::Range(1U, 17U));

}  // namespace
}  // namespace dsdpv1::conformance
