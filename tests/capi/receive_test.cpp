// Characters passed to dpsim_chip_receive compared with single edges: the two chips must be indistinguishable.
#include <random>
#include <string>
#include <vector>

#include "tests/capi/capi.hpp"
#include "tests/capi/station.hpp"

namespace dsdpv1::capi_test {
namespace {

constexpr uint32_t kBit = 1000;  // 12 Mbit/s
constexpr uint64_t kOutputs = DPSIM_ALL_PINS & ~DPSIM_PIN(DPSIM_DSDPV1_PBRXD);

/// A chip in data exchange; records changes, events and, at each of them, the level of PBRXD.
class Heard {
 public:
  explicit Heard(dpsim_engine engine) : chip(make_chip(engine)), now(start_up(chip.get())) {
    ok(dpsim_chip_watch(
        chip.get(), kOutputs,
        [](void* self, const dpsim_change* change) {
          static_cast<Heard*>(self)->note(change->tick, change->pin, change->level);
        },
        this));
    ok(dpsim_chip_on_event(
        chip.get(),
        [](void* self, const dpsim_chip_event* event) {
          static_cast<Heard*>(self)->note(event->tick, 100 + event->reason, event->a);
        },
        this));
  }
  Heard(const Heard&) = delete;
  Heard& operator=(const Heard&) = delete;

  void receive(uint64_t at, uint32_t bit, const bus::Bytes& bytes) {
    ok(dpsim_chip_receive(chip.get(), at, bit, bytes.data(), bytes.size(), &now));
  }
  void set(uint64_t at, uint16_t pin, dpsim_level level) { ok(dpsim_chip_set(chip.get(), at, pin, level)); }

  const Owned<dpsim_chip> chip;
  uint64_t now;
  std::vector<std::string> notes;

 private:
  void note(uint64_t at, int what, int value) {
    dpsim_level line = 0;
    ok(dpsim_chip_level(chip.get(), DPSIM_DSDPV1_PBRXD, &line));
    notes.push_back(std::to_string(at) + ": " + std::to_string(what) + " is " + std::to_string(value) + ", PBRXD " +
                    std::to_string(line));
  }
};

/// The input of the chips, generated from a seed.
class Stimulus {
 public:
  explicit Stimulus(unsigned seed) : random_(seed) {}

  int below(int end) { return std::uniform_int_distribution<int>(0, end - 1)(random_); }
  uint32_t bit() {
    constexpr uint32_t kOthers[] = {1100, 1250, 2000, 500};  // no whole cycles, and other rates
    return below(12) == 0 ? kOthers[below(4)] : kBit;
  }
  /// Ticks before a telegram: none, less than a gap, T_SYN, or so long that the watchdog (1 ms) ends in the telegram.
  uint64_t idle() {
    switch (below(5)) {
      case 0: return 0;
      case 1: return static_cast<uint64_t>(below(3 * kBit));
      case 2: return kMs - static_cast<uint64_t>(below(250 * 12'000));
      default: return kBit * static_cast<uint64_t>(33 + below(400));
    }
  }
  bus::Bytes characters() {
    bus::Bytes all = telegram();
    while (below(6) == 0) {
      const bus::Bytes more = telegram();
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }

 private:
  bus::Bytes telegram() {
    constexpr int kIo = kBytes;
    switch (below(8)) {
      case 0: return speed::bring_up(kIo)[static_cast<std::size_t>(below(3))];
      case 1: return with_watchdog();
      case 2: return speed::bring_up(kIo)[2];
      case 3: return bytes(below(300));
      case 4: return bus::encode(bus::make_telegram(90, 2, 0x5D, bytes(200)));
      default: return speed::exchange_requests(kIo)[toggle_ ^= 1U];
    }
  }
  bus::Bytes bytes(int count) {
    bus::Bytes all;
    for (int i = 0; i < count; ++i) all.push_back(static_cast<uint8_t>(below(256)));
    return all;
  }
  static bus::Bytes with_watchdog() {
    conformance::Prm prm;
    prm.status = 0x88;
    prm.wd1 = prm.wd2 = 1;
    prm.user = {0x04, 0, 0};
    return bus::encode(bus::make_telegram(5, 2, 0x6D, prm.bytes(), 61, 62));
  }

  std::mt19937 random_;
  unsigned toggle_ = 0;
};

/// At the very end of a telegram or later: the user requests the DPRAM, or there is a RESET.
void disturb(Stimulus& draw, Heard& told, Heard& edges, uint16_t pin) {
  const uint64_t at = told.now + static_cast<uint64_t>(draw.below(4 * 250)), back = at + 250U * 20;
  for (Heard* each : {&told, &edges}) {
    each->set(at, pin, pin == DPSIM_DSDPV1_R_REQ ? 1 : 0);
    each->set(back, pin, pin == DPSIM_DSDPV1_R_REQ ? 0 : 1);
    each->now = back;
  }
}

class CapiReceive : public testing::TestWithParam<unsigned> {};

TEST_P(CapiReceive, IsTheEdgesOfTheCharacters) {
  Stimulus draw(GetParam());
  Heard told(DPSIM_ENGINE_SKIP), edges(GetParam() % 2 == 0 ? DPSIM_ENGINE_SKIP : DPSIM_ENGINE_STEP);
  constexpr int kTelegrams = 60;
  for (int i = 0; i < kTelegrams; ++i) {
    if (draw.below(20) == 0)  // the line is low before
      for (Heard* each : {&told, &edges}) each->set(told.now, DPSIM_DSDPV1_PBRXD, 0);
    const uint64_t at = told.now + draw.idle();
    const uint32_t bit = draw.bit();
    const bus::Bytes bytes = draw.characters();
    told.receive(at, bit, bytes);
    edges.now = receive_edges(edges.chip.get(), at, bit, bytes);
    ASSERT_EQ(told.now, edges.now);
    if (i == kTelegrams - 2) disturb(draw, told, edges, DPSIM_DSDPV1_RESET);
    if (draw.below(10) == 0) disturb(draw, told, edges, DPSIM_DSDPV1_R_REQ);
    ASSERT_EQ(told.notes, edges.notes) << "telegram " << i;
    told.notes.clear();
    edges.notes.clear();
  }
}

// 72 and 100: a change at the very tick of an edge of PBRXD, whose level is then read.
INSTANTIATE_TEST_SUITE_P(Seeds, CapiReceive, testing::Values(1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 72U, 100U));

}  // namespace
}  // namespace dsdpv1::capi_test
