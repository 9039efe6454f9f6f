// Random scripts of masters, user and disturbances: both engines stay together (twin_chip.hpp), every right request is
// answered, and what holds in every state holds.
#include <gtest/gtest.h>

#include <random>

#include "tests/conformance/master_side.hpp"

namespace dsdpv1::conformance {
namespace {

class RandomScript {
 public:
  explicit RandomScript(unsigned seed) : random_(seed), bench_(config()) { bench_.to_wait_prm(any_init()); }

  void run(int actions) {
    for (int i = 0; i < actions && !testing::Test::HasFailure(); ++i) {
      act();
      bench_.chip.compare(bench_.now());
      check();
    }
  }

  int times_in_data_exchange() const { return bench_.count(Reason::kCfgAccepted); }

 private:
  static dsdpv1::Config config() {
    dsdpv1::Config config = quick_search();
    config.baud_control_ms = 3;
    return config;
  }
  int below(int limit) { return static_cast<int>(random_() % static_cast<unsigned>(limit)); }
  std::uint8_t any_byte() { return static_cast<std::uint8_t>(random_()); }
  Bytes any_bytes(int length) {
    Bytes bytes;
    for (int i = 0; i < length; ++i) bytes.push_back(any_byte());
    return bytes;
  }

  Init any_init() {
    Init init = plain_init_;
    init.command = any_byte();
    init.prm_mode = static_cast<std::uint8_t>(below(3));
    init.cfg_mode = static_cast<std::uint8_t>(below(3));
    init.max_prm = static_cast<std::uint8_t>(below(4));
    return init;
  }
  Prm any_prm() {
    Prm prm;
    prm.status = below(4) == 0 ? any_byte() : 0x80;
    prm.wd1 = static_cast<std::uint8_t>(below(3));
    prm.wd2 = static_cast<std::uint8_t>(below(3));
    prm.min_tsdr = below(4) == 0 ? any_byte() : 11;
    if (below(8) == 0) prm.ident = 1;
    prm.user = any_bytes(below(4));
    if (!prm.user.empty() && below(4) != 0) prm.user[0] = 0x04;
    return prm;
  }
  Bytes any_request(int dsap) {
    switch (dsap) {
      case kNoSap: return any_bytes(below(8) == 0 ? below(5) : 2);
      case 55: return {5, 0x0C, 0xC9, 0};
      case 61: return any_prm().bytes();
      case 62: return below(4) == 0 ? any_bytes(below(6)) : Bytes{0x11, 0x21};
      default: return {};
    }
  }

  void request() {
    constexpr int kSaps[] = {kNoSap, kNoSap, kNoSap, 55, 56, 57, 59, 60, 61, 61, 62, 62, 49, 51};
    const int dsap = kSaps[below(14)];
    const auto master = static_cast<std::uint8_t>(below(5) == 0 ? 3 : 2);
    constexpr std::uint8_t kCodes[] = {0x6D, 0x5D, 0x7D, 0x4C, 0x6C};
    const bool searching = !bench_.chip.status().baud_index.known();
    const Exchange exchange =
        send_fc(bench_, kCodes[below(5)], dsap, dsap == kNoSap ? kNoSap : 62, any_request(dsap), master);
    if (!searching && bench_.chip.status().baud_index.known()) EXPECT_TRUE(exchange.answered()) << "SAP " << dsap;
  }
  /// A whole start-up by master 2, whatever the judging modes are; the flags it asks for may be refused.
  void bring_up() {
    if (!bench_.chip.status().baud_index.known()) bench_.find_baud(0);
    Prm prm;
    prm.status = below(2) == 0 ? 0xB0 : 0x80;
    ask(bench_, 61, prm.bytes());
    settle(bench_);
    bench_.verdict(true, std::nullopt);
    ask(bench_, 62, {0x11, 0x21});
    settle(bench_);
    bench_.verdict(std::nullopt, true);
    for (int i = below(6); i > 0; --i) ask(bench_, kNoSap, any_bytes(2));
  }
  void disturb() {
    bus::WireFaults faults;
    faults.glitch_at = static_cast<std::size_t>(below(6));
    faults.glitch = {below(11'000), 100 + below(900)};
    bench_.requester.send(bench_.timeline, bus::encode(bus::make_telegram(5, 2, 0x6D, any_bytes(2))),
                          {.idle_bits = below(60), .faults = faults});
  }
  void user() {
    switch (below(5)) {
      case 0: return bench_.give_inputs(any_bytes(2), below(6) == 0 ? 1 : 0);
      case 1: return bench_.give_diag(static_cast<std::uint8_t>(below(2) == 0 ? 0x81 : 0x02), any_bytes(below(34)));
      case 2: return bench_.verdict(below(4) != 0, std::nullopt);
      case 3: return bench_.verdict(std::nullopt, below(4) != 0);
      default: bench_.fetch_outputs();
    }
  }
  void act() {
    const int what = below(110);
    if (what >= 100) return bring_up();
    if (what < 50) return request();
    if (what < 70) return user();
    if (what < 80) return tell(bench_, below(4) == 0 ? 5 : 127, 58, any_bytes(2));
    if (what < 88) return disturb();
    if (what < 93) return bench_.run_for(below(3'000'000));
    if (what < 96) return bench_.run_ms(below(5));
    if (what < 99 || below(3) != 0) return bench_.find_baud(below(4));
    EXPECT_TRUE(bench_.initialise(any_init()));
    bench_.find_baud(below(4));
  }

  void check() {
    const auto status = bench_.chip.status();
    EXPECT_EQ(bench_.chip.level(Pin::kPbf), status.dp_state == DpState::kDataExch ? 0 : 1);
    EXPECT_EQ(bench_.chip.level(Pin::kBr), status.baud_index.known() ? 1 : 0);
    EXPECT_TRUE(status.dp_state < DpState::kWaitCfg || status.master != 255) << "nobody holds the slave";
  }

  std::mt19937 random_;
  const Init plain_init_;
  SlaveBench bench_;
};

class Scripts : public testing::TestWithParam<unsigned> {};

TEST_P(Scripts, KeepStepAndSkipTogether) {
  RandomScript script(GetParam());
  script.run(1500);
  EXPECT_GT(script.times_in_data_exchange(), 10) << "the script does not reach far enough to prove anything";
}

INSTANTIATE_TEST_SUITE_P(Seeds, Scripts, testing::Values(1U));
INSTANTIATE_TEST_SUITE_P(MoreSeeds, Scripts, testing::Range(2U, 9U));

}  // namespace
}  // namespace dsdpv1::conformance
