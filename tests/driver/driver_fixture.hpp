#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/driver/fake_rsu.hpp"

namespace dsdpv1 {

/// A device on a fake chip. Every test ends with a check of the user's discipline.
class DriverTest : public testing::Test {
 protected:
  using Bytes = std::vector<std::uint8_t>;

  virtual FakePort port_kind() const { return FakePort::kParallel; }

  void SetUp() override {
    judge.ctx = this;
    judge.prm = [](void* ctx, const std::uint8_t* bytes, std::uint8_t length) {
      auto& test = *static_cast<DriverTest*>(ctx);
      test.prm_seen.emplace_back(bytes, bytes + length);
      if (test.while_judging) test.while_judging();
      return test.prm_verdict;
    };
    judge.cfg = [](void* ctx, const dsdpv1_cfg_block* cfg) {
      auto& test = *static_cast<DriverTest*>(ctx);
      test.cfg_seen.emplace_back(cfg->bytes, cfg->bytes + cfg->length);
      test.cfg_lengths = {cfg->input_length, cfg->output_length};
      return test.cfg_verdict;
    };
    ASSERT_EQ(rsu.open(port_kind(), device, judge), DSDPV1_OK);
    config.address = 5;
    config.ident = 0x0CC9;
    config.sync = true;
    config.freeze = true;
    config.max_input = 8;
    config.max_output = 4;
    config.max_diag = 9;
    config.max_prm = 18;
    config.max_cfg = 20;
    config.cfg = initial_cfg.data();
    config.cfg_length = 2;
    result.outputs = outputs.data();
    result.capacity = static_cast<std::uint8_t>(outputs.size());
  }

  void TearDown() override { EXPECT_THAT(chip.violations, testing::IsEmpty()); }

  void initialise(std::uint8_t prm_mode = 0, std::uint8_t cfg_mode = 0) {
    config.prm_mode = prm_mode;
    config.cfg_mode = cfg_mode;
    ASSERT_EQ(dsdpv1_initialise(&device, &config), DSDPV1_OK);
    chip.holds = 0;
  }

  dsdpv1_error exchange(const Bytes& inputs, dsdpv1_input_policy policy = DSDPV1_INPUT_NEWEST) {
    return dsdpv1_exchange(&device, policy, inputs.data(), static_cast<std::uint8_t>(inputs.size()), &result);
  }

  Bytes received() const { return {outputs.begin(), outputs.begin() + result.length}; }

  FakeChip chip;
  FakeRsu rsu{chip};
  dsdpv1_device device{};
  dsdpv1_judge judge{};
  dsdpv1_config config{};
  Bytes initial_cfg = {0x17, 0x23};
  dsdpv1_exchange_result result{};
  Bytes outputs = Bytes(244);
  dsdpv1_verdict prm_verdict = DSDPV1_ACCEPT, cfg_verdict = DSDPV1_ACCEPT;
  std::vector<Bytes> prm_seen, cfg_seen;
  std::pair<int, int> cfg_lengths;
  std::function<void()> while_judging;
};

}  // namespace dsdpv1
