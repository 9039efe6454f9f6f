// Rulings D7, D11; order of the checks: chapter 10 of the micro-architecture.
#include "model/dpram/init_data.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "model/dpram/reasons.hpp"
#include "model/profibus/cfg_identifier.hpp"
#include "tests/core/event_recorder.hpp"

namespace dsdpv1::dpram {
namespace {

using Block = std::vector<std::uint8_t>;

/// B020.. with two configuration bytes: 2 inputs, 2 outputs.
Block right() { return {16, 5, 0x0C, 0xC9, 0x0F, 0, 0, 244, 244, 32, 237, 0, 200, 0, 2, 0x11, 0x21}; }

/// D7 and D11, written again independently.
bool allowed(const Block& block) {
  if (block.size() < 15 || block[0] > 214) return false;
  const std::size_t cfg = block[14];
  if (block[1] > 126 || block[7] > 244 || block[8] > 244 || block[9] > 238 || block[10] > 237 || block[11] > 2)
    return false;
  if (block[12] > 200 || block[13] > 2 || cfg > block[12] || block[0] < 14 + cfg) return false;
  const profibus::CfgLengths lengths = profibus::cfg_lengths(block.data() + 15, static_cast<int>(cfg));
  return lengths.complete() && lengths.input() <= block[7] && lengths.output() <= block[8];
}

bool parse(const Block& block, profibus::SlaveConfig& config, core_test::EventRecorder& recorder) {
  return parse_init(block.data(), static_cast<int>(block.size()), 100, recorder.log, config);
}

TEST(InitData, EveryFieldArrives) {
  Block block = right();
  block[4] = 0x0A;
  block[9] = 17;
  block[10] = 18;
  block[11] = 2;
  block[12] = 19;
  block[13] = 1;
  profibus::SlaveConfig config;
  core_test::EventRecorder recorder;
  ASSERT_TRUE(parse(block, config, recorder));
  EXPECT_EQ(config.address, 5);
  EXPECT_EQ(config.ident, 0x0CC9);
  EXPECT_TRUE(config.fail_safe_supported);
  EXPECT_FALSE(config.sync_supported);
  EXPECT_TRUE(config.freeze_supported);
  EXPECT_FALSE(config.address_change);
  EXPECT_EQ(config.max_input, 244);
  EXPECT_EQ(config.max_output, 244);
  EXPECT_EQ(config.max_diag, 17);
  EXPECT_EQ(config.max_prm, 18);
  EXPECT_EQ(config.max_cfg, 19);
  EXPECT_EQ(config.prm_mode, profibus::Judging::kUser);
  EXPECT_EQ(config.cfg_mode, profibus::Judging::kExact);
  EXPECT_EQ(config.cfg.size, 2);
  EXPECT_EQ(config.cfg.bytes[0], 0x11);
  EXPECT_EQ(config.cfg.bytes[1], 0x21);
}

TEST(InitData, EveryByteAtEveryValueIsJudgedByTheLimits) {
  for (std::size_t position = 1; position < right().size(); ++position) {
    for (int value = 0; value < 256; ++value) {
      Block block = right();
      block[position] = static_cast<std::uint8_t>(value);
      profibus::SlaveConfig config;
      core_test::EventRecorder recorder;
      EXPECT_EQ(parse(block, config, recorder), allowed(block))
          << "B0" << std::hex << 0x20 + position << " = " << value;
      EXPECT_EQ(recorder.events.size(), allowed(block) ? 0U : 1U) << "one reason for a refusal";
    }
  }
}

TEST(InitData, EveryLengthIsJudged) {
  for (int length = 0; length <= 214; ++length) {
    Block block = right();
    block.resize(static_cast<std::size_t>(length) + 1);
    block[0] = static_cast<std::uint8_t>(length);
    profibus::SlaveConfig config;
    core_test::EventRecorder recorder;
    EXPECT_EQ(parse(block, config, recorder), length >= 16) << length;
    EXPECT_EQ(recorder.count(Reason::kInitLength), length >= 16 ? 0 : 1) << length;
  }
}

TEST(InitData, RandomBlocksAreJudgedByTheLimits) {
  std::mt19937 random(9);
  int good = 0;
  for (int round = 0; round < 20'000; ++round) {
    Block block = right();
    block.resize(15 + random() % 200);
    block[0] = static_cast<std::uint8_t>(block.size() - 1);
    for (std::size_t i = 15; i < block.size(); ++i)
      block[i] = static_cast<std::uint8_t>(random() % 3 == 0 ? random() : 0);
    block[14] = static_cast<std::uint8_t>(random() % 8 == 0 ? random() : random() % (block.size() - 14));
    block[1 + random() % 13] = static_cast<std::uint8_t>(random());
    profibus::SlaveConfig config;
    core_test::EventRecorder recorder;
    ASSERT_EQ(parse(block, config, recorder), allowed(block)) << "round " << round;
    good += allowed(block) ? 1 : 0;
  }
  EXPECT_GT(good, 1000);
}

}  // namespace
}  // namespace dsdpv1::dpram
