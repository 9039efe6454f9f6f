// The module at its planned cycles is the module at every cycle, and one that is replaced by its saved state; bytes and
// gaps of any kind do not hang it.
#include <cstdlib>
#include <random>

#include "tests/core/event_recorder.hpp"
#include "tests/xgate/module_bench.hpp"

namespace dsdpv1::xgate {
namespace {

/// Host, master, C1, C2 and alarms, and faults of all kinds. No call waits longer than the module takes.
void live(ModuleBench& bench) {
  const auto ask = [&](std::uint8_t command, const Bytes& data = {}, std::uint8_t special = 0x11) {
    bench.put(frame(command, data, special));
    bench.run(1'000 + 160 * 60);
  };
  ask(0x15, {0xE4, 0xFF});
  ask(0x04, ModuleBench::initialisation());
  ask(0x20, {1, 2, 3});
  bench.diagnosis();
  bench.set_prm({1});
  ask(0x20, {1, 2, 3});
  bench.set_prm(ModuleBench::prm());
  bench.service(62, ModuleBench::cfg());
  ask(0x20, {1, 2, 3});
  ask(0x22);
  ask(0x16, {0x80, 1});
  bench.service(51, {0x5E, 1, 2, 2}, 51);
  bench.service(49, {0x57, 0, 0, 0, 0, 100, 1, 0, 0, 0, 0, 0, 0, 0}, 50);
  bench.service(48, {}, 50);
  bench.service(48, {0x5F, 1, 2, 1, 9}, 50);
  ask(0x20, {1, 2, 3});
  bench.service(-1, {4, 5, 6});
  bench.put({0x7E, 0x30});
  bench.service(-1, {4, 5, 7});
  bench.run(6'000);
  ask(0x30, box(1, {0x5E, 1, 2, 2, 7, 7}) + box(2, {0xDF, 0x80, 0xB6, 0}));
  bench.service(51, {}, 51);
  bench.service(48, {}, 50);
  bench.service(49, {0x57, 0, 0, 0, 0, 100, 1, 0, 0, 0, 0, 0, 0, 0}, 50);  // a second channel
  bench.service(47, {}, 50);
  bench.service(48, {0x5E, 1, 2, 1}, 50);
  bench.service(47, Bytes{0x5F, 1, 2, 31} + Bytes(31), 50);  // too long, and waits for the first
  ask(0x20, {1, 2, 3});
  ask(0x30, box(2, {0x5E, 1, 2, 1, 9}));
  bench.service(48, {}, 50);
  bench.service(48, Bytes{0x5F, 1, 2, 31} + Bytes(31), 50);
  bench.service(48, {}, 50);
  bench.service(51, Bytes{0x5F, 1, 2, 21} + Bytes(21), 51);
  bench.service(51, {}, 51);
  ask(0x31, box(4, {0x04, 0x02, 7, 0x29}));
  bench.put({0x7E, 0x31});
  bench.diagnosis();
  bench.service(51, {0x5C, 7, 0x02, 0x29}, 51);
  bench.put(frame(0x01, {1}) + frame(0x01, {9}));
  bench.run(5'000);
  ask(0x20, {1, 2, 3}, 0x51);
  ask(0x20, {3, 2, 1}, 0x51);
  bench.run(20'000);
  ask(0x03, {0x00, 0x00, 0x10});
  bench.byte_time = 458;
  ask(0x12, {1});
  ask(0x12, {0});
  bench.run(500 * 1'000);  // the watchdog of 10 ms ends
  bench.put(frame(0x01, {9}));
  bench.run(400);
  bench.reset(true);
  bench.run(100);
  bench.reset(false);
  bench.run(2'000);
}

Config watched() {
  Config config = ModuleBench::quick();
  config.watchdog = WatchdogUse::kHost;
  return config;
}

TEST(XgateTime, PlannedCyclesAreEnoughAndAnyOfThemCanBeSaved) {
  ModuleBench skip(watched(), Way::kSkip), step(watched(), Way::kStep), restored(watched(), Way::kRestored);
  for (ModuleBench* bench : {&skip, &step, &restored}) live(*bench);
  for (const char* const reason :
       {"XGATE_ERROR", "XGATE_LOST", "XGATE_PRM", "XGATE_WATCHDOG", "C1_ANSWER", "C2_ANSWER", "ALARM_ACK", "DP_STATE"})
    EXPECT_TRUE(skip.has(reason)) << reason;
  EXPECT_LT(skip.evaluated * 20, step.evaluated);
  for (const ModuleBench* bench : {&step, &restored}) {
    EXPECT_EQ(bench->now, skip.now);
    EXPECT_TRUE(bench->changes == skip.changes);
    EXPECT_EQ(bench->begins, skip.begins);
    EXPECT_TRUE(std::equal(skip.events.begin(), skip.events.end(), bench->events.begin(), bench->events.end(),
                           core_test::same));
  }
}

TEST(XgateTime, ADamagedStateIsRefused) {
  ModuleBench bench;
  bench.to_exchange();
  const Bytes saved = save(*bench.module);
  const Module* const before = bench.module.get();
  for (std::size_t size : {std::size_t{0}, std::size_t{20}, saved.size() - 1})
    EXPECT_THROW(restore(bench.module, saved.data(), size), profibus::StateError);
  for (std::size_t place = 0; place < saved.size(); place += 97) {
    Bytes damaged = saved;
    damaged[place] ^= 0x10;
    EXPECT_THROW(restore(bench.module, damaged.data(), damaged.size()), profibus::StateError) << place;
  }
  Config other = ModuleBench::quick();
  other.errors = ErrorForm::kPrinted;
  auto stranger = std::make_unique<Module>(other);
  EXPECT_THROW(restore(stranger, saved.data(), saved.size()), profibus::StateError);
  EXPECT_EQ(bench.module.get(), before);
  EXPECT_EQ(save(*bench.module), saved);
}

/// 20 000 bytes, or as many as DSDPV1_XGATE_BYTES says: parts of frames, damaged ones, noise, gaps, with a master.
class XgateFuzz : public testing::TestWithParam<Port> {
 protected:
  static Config config() {
    Config config = watched();
    config.port = GetParam();
    config.mailboxes = MailboxForm::kShort;
    return config;
  }
  unsigned below(unsigned limit) { return static_cast<unsigned>(random() % limit); }
  std::uint8_t byte_below(unsigned limit) { return static_cast<std::uint8_t>(below(limit)); }

  Bytes command() {
    static const Bytes kCommands = {0x01, 0x02, 0x04, 0x12, 0x13, 0x15, 0x16, 0x20,
                                    0x20, 0x21, 0x22, 0x23, 0x24, 0x30, 0x31, 0x77};
    if (below(12) == 0) return frame(0x04, ModuleBench::initialisation(static_cast<std::uint8_t>(4 + below(3))));
    Bytes data(below(4) == 0 ? below(256) : below(4) == 0 ? below(20) : 3);
    for (std::uint8_t& byte : data) byte = byte_below(below(4) == 0 ? 256 : 6);
    const std::uint8_t code = kCommands[below(static_cast<unsigned>(kCommands.size()))];
    return frame(code, data, below(8) == 0 ? byte_below(256) : std::uint8_t{0x11});
  }
  Bytes damaged(Bytes sent) {
    if (below(4) == 0) sent[below(static_cast<unsigned>(sent.size()))] ^= static_cast<std::uint8_t>(1U << below(8));
    if (below(6) == 0) sent.resize(below(static_cast<unsigned>(sent.size())) + 1);
    return sent;
  }
  void put(const Bytes& sent) {
    if (GetParam() == Port::kUart) return bench.put(sent);
    for (const std::uint8_t byte : sent) {
      if (below(50) == 0) {
        static_cast<void>(bench.module->begin_byte());
        bench.module->cut_byte();
      }
      bench.transfer(byte);
    }
  }
  Bytes ask(const Bytes& sent) {
    if (GetParam() == Port::kUart) return bench.send(sent);
    bench.transfer(sent);
    bench.run(1'000);
    return bench.transfer(Bytes(7));
  }
  void master() {
    switch (below(8)) {
      case 0: bench.diagnosis(); break;
      case 1: bench.set_prm(below(2) == 0 ? ModuleBench::prm() : Bytes(below(6))); break;
      case 2: bench.service(62, ModuleBench::cfg()); break;
      case 3: bench.service(51, {0x5E, 1, 2, 2}, 51); break;
      case 4: bench.service(-1, {1, 2, 3}); break;
      case 5:
        bench.diagnosis();
        bench.set_prm(ModuleBench::prm());
        bench.service(62, ModuleBench::cfg());
        break;
      default: break;
    }
    exchanged += bench.exchanging() ? 1 : 0;
  }
  void forget() {
    bench.changes.clear();
    bench.heard.clear();
    bench.events.clear();
    bench.begins.clear();
  }
  /// After a rest it answers again; once 2/1 for bytes that were lost.
  void expect_alive() {
    bench.run(300'000);
    if (bench.module->state() == ModuleState::kStopped) {
      bench.reset(true);
      bench.reset(false);
      bench.run(2'000);
    }
    if (GetParam() == Port::kSpi) bench.transfer(Bytes(270));  // an answer that waits
    ask(frame(0x01, {1}));
    ASSERT_EQ(ask(frame(0x01, {1}, 0x51)), frame(0x01, {1, 0}));
  }

  std::mt19937 random{50};
  ModuleBench bench{config()};
  int exchanged = 0;
};

TEST_P(XgateFuzz, BytesAndGapsNeverHangIt) {
  const char* const given = std::getenv("DSDPV1_XGATE_BYTES");
  const int most = given != nullptr ? std::atoi(given) : 20'000;
  for (int bytes = 0, asked = 0; bytes < most; ++asked) {
    const Bytes sent = damaged(command());
    bytes += static_cast<int>(sent.size());
    put(sent);
    bench.run(below(3) == 0 ? Cycle{below(30'000)} : Cycle{300 + kByte * 10});
    master();
    forget();
    if (asked % 20 == 0) expect_alive();
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(exchanged, 20);
}

INSTANTIATE_TEST_SUITE_P(Ports, XgateFuzz, testing::Values(Port::kUart, Port::kSpi));

}  // namespace
}  // namespace dsdpv1::xgate
