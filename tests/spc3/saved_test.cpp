// Saved states: those that a chip refuses. That the others continue is in every test (bench.hpp), and in the middle of
// telegrams in random_test.cpp.
#include "tests/spc3/bench.hpp"

namespace dsdpv1::spc3_test {
namespace {

using State = std::vector<std::uint8_t>;

spc3::Config named(Variant variant) {
  spc3::Config config;
  config.variant = variant;
  return config;
}

/// Why a chip refuses the state; empty: it does not.
std::string refusal(const State& state, const spc3::Config& config = {}) {
  spc3::Chip chip(config);
  chip.advance(1000);
  const State before = chip.save();
  try {
    chip.restore(state.data(), state.size());
  } catch (const spc3::StateError& error) {
    EXPECT_EQ(chip.save(), before) << "the chip is as it was";
    return error.what();
  }
  return "";
}

TEST(Saved, StatesOfOtherChipsAreRefused) {
  const State state = spc3::Chip(named(Variant::kSpc3)).save();
  EXPECT_EQ(refusal(state, named(Variant::kSpc3)), "");
  EXPECT_EQ(refusal(state, named(Variant::kApc3)), "the state is of a SPC3, this chip is a APC3");
  spc3::Config other = named(Variant::kSpc3);
  other.event_delay = 33;
  EXPECT_EQ(refusal(state, other), "the state is of a chip whose event_delay is 32, here it is 33");
}

TEST(Saved, DamagedStatesAreRefused) {
  Bench bench;
  bench.to_data_ex();
  const State whole = bench.twins.chip().save();
  EXPECT_EQ(refusal(whole), "");
  State cut = whole, other = whole;
  cut.pop_back();
  EXPECT_NE(refusal(cut), "");
  other[0] ^= 1U;
  EXPECT_EQ(refusal(other), "this is no saved state of a chip");
  for (std::size_t i = 20; i < whole.size(); i += 7) {
    State damaged = whole;
    damaged[i] ^= 0x10U;
    EXPECT_EQ(refusal(damaged), "the state is damaged: its checksum is wrong");
  }
}

// The checksum is right, the values are any: refused, or a chip that goes its way.
TEST(Saved, ImpossibleValuesDoNoHarm) {
  Bench bench;
  bench.to_data_ex();
  bench.exchange({1, 2});
  const State whole = bench.twins.chip().save();
  int refused = 0;
  for (std::size_t i = 20; i < whole.size(); i += i < 300 || i > 4300 ? 1 : 50) {
    State damaged = whole;
    damaged[i] ^= 0xFFU;
    damaged = profibus::end_frame(damaged);
    spc3::Chip chip;
    try {
      chip.restore(damaged.data(), damaged.size());
    } catch (const spc3::StateError&) {
      ++refused;
      continue;
    }
    chip.advance(chip.now() + 1'000'000);
    chip.load(chip.now() / profibus::kTicksPerCycle, regs::kNewDin);
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace dsdpv1::spc3_test
