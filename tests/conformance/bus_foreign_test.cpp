// A telegram for another station that a chip receives as a run: it causes no event, and nothing else differs.
#include <gtest/gtest.h>

#include "model/dsdpv1/chip.hpp"
#include "tests/bench/saturated_bus.hpp"

namespace dsdpv1 {
namespace {

using bus::Bytes;
using profibus::Tick;

const Bytes kForOther = {0x10, 0x63, 0x02, 0x49, 0xAE, 0x16};  // FDL status of station 99
constexpr Tick kGap = 40 * speed::kBit;

struct Station {
  Station() { speed::SaturatedBus<dsdpv1::Chip>(chip, 16).start(); }
  dsdpv1::Chip chip;
};

TEST(ForeignTelegrams, CostNoEventAndAreCounted) {
  Station by_run, by_edges;
  const auto before = by_run.chip.status().telegrams_received;
  const speed::Wave wave = speed::wave_of(kForOther);
  Tick at = by_run.chip.now() + kGap;
  const Tick planned = by_run.chip.next_event();
  for (unsigned telegrams = 1; telegrams <= 3; ++telegrams, at += wave.length + kGap) {
    const profibus::CharacterRun run{at, speed::kBit / profibus::kTicksPerCycle, kForOther.data(),
                                     static_cast<int>(kForOther.size())};
    ASSERT_TRUE(by_run.chip.hear(at, run));
    EXPECT_GT(by_run.chip.next_event(), at + wave.length + kGap) << "behind " << telegrams;
    for (const auto& edge : wave.edges) by_edges.chip.set(at + edge.at, Pin::kPbrxd, edge.level ? 1 : 0);
    for (dsdpv1::Chip* chip : {&by_run.chip, &by_edges.chip}) {
      chip->advance(at + wave.length + kGap / 2);
      EXPECT_EQ(chip->status().telegrams_received, before + telegrams);
    }
  }
  EXPECT_EQ(by_run.chip.next_event(), by_edges.chip.next_event());
  EXPECT_GE(by_run.chip.next_event(), planned);
}

TEST(ForeignTelegrams, OneThatConcernsTheStationHasItsEvent) {
  Station station;
  Bytes own = kForOther;
  own[1] = 5;
  own[4] = static_cast<std::uint8_t>(own[1] + own[2] + own[3]);
  const Tick at = station.chip.now() + kGap;
  const profibus::CharacterRun run{at, speed::kBit / profibus::kTicksPerCycle, own.data(),
                                   static_cast<int>(own.size())};
  ASSERT_TRUE(station.chip.hear(at, run));
  EXPECT_LE(station.chip.next_event(), at + speed::wave_of(own).length + kGap);
}

}  // namespace
}  // namespace dsdpv1
