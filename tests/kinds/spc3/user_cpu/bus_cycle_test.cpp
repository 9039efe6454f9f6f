// The user CPU's accesses at the pins of the SPC3 family: how long the FSMC of an STM32F103 waits for XREADY.
#include "kinds/spc3/user_cpu/bus_cycle.hpp"

#include <gtest/gtest.h>

#include <map>

#include "kinds/user_cpu/fsmc_access.hpp"
#include "model/spc3/pins.hpp"
#include "tests/kinds/quiet_device.hpp"

namespace dsdpv1 {
namespace {

using bus::Tick;
using spc3::Pin;

constexpr Tick kStart = 1000;
constexpr std::int64_t kHz = 12'000'000;  // 1000 ticks an HCLK

/// XREADY falls at a tick. Notes the last change of each strobe and when DB is sampled.
class Ready : public QuietDevice {
 public:
  explicit Ready(Tick at, bool high = false) : at_(at), idle_(high ? 0 : 1) {}
  void set(Tick at, tb::PinNumber pin, tb::Level level) override { changes[{pin, level}] = at; }
  void advance(Tick to) override { now_ = to; }
  tb::Level level(tb::PinNumber pin) const override {
    return pin == number(Pin::kXReady) && now_ >= at_ ? static_cast<tb::Level>(1 - idle_) : idle_;
  }
  tb::Level sample(Tick at) override {
    sampled = at;
    return 0x5A;
  }
  /// In HCLK from the begin of the access.
  Tick fell(Pin pin) { return (changes.at({number(pin), 0}) - kStart) / 1000; }
  Tick rose(Pin pin) { return (changes.at({number(pin), 1}) - kStart) / 1000; }

  std::map<std::pair<tb::PinNumber, tb::Level>, Tick> changes;
  Tick sampled = 0;

 private:
  const Tick at_;
  const tb::Level idle_;
  Tick now_ = 0;
};

/// ADDSET = 1, DATAST = 5: NWE is low from 2 to 7 HCLK, a read is sampled at 8.
void run(Ready& chip, bool write, user_cpu::WaitTiming wait) {
  user_cpu::FsmcBank bank;
  bank.hclk_hz = kHz;
  const user_cpu::FsmcAccess timing = user_cpu::access_timing(bank);
  spc3_user::BusCycle cycle(chip, spc3::Bus::kIntelAsync);
  cycle.set_wait(wait);
  cycle.begin(kStart, {write, 0x16, 0xA5}, write ? timing.write : timing.read);
  while (cycle.next_edge() != bus::kNever) cycle.run_edge();
  EXPECT_EQ(cycle.read_value(), write ? 0xFF : 0x5A);
}

constexpr user_cpu::WaitTiming kWhileHigh = {true, true, kHz}, kWhileLow = {true, false, kHz}, kOff = {};

TEST(BusCycle, AReadIsSampledFourHclkAfterItsChipIsReady) {
  const std::map<Tick, Tick> sampled = {{0, 8}, {4, 8}, {5, 9}, {9, 13}, {30, 34}};  // ready: sampled
  for (const auto& [ready, expected] : sampled) {
    Ready chip(kStart + ready * 1000);
    run(chip, false, kWhileHigh);
    EXPECT_EQ((chip.sampled - kStart) / 1000, expected) << ready;
    EXPECT_EQ(chip.fell(Pin::kXRd), 0);  // mode 1
    EXPECT_EQ(chip.rose(Pin::kXRd), expected + 2) << ready;
  }
}

TEST(BusCycle, AWriteEndsThreeHclkAfterItsChipIsReady) {
  const std::map<Tick, Tick> ended = {{0, 7}, {4, 7}, {5, 8}, {9, 12}, {30, 33}};  // ready: end of the strobe
  for (const auto& [ready, expected] : ended) {
    Ready chip(kStart + ready * 1000);
    run(chip, true, kWhileHigh);
    EXPECT_EQ(chip.fell(Pin::kXWr), 2);
    EXPECT_EQ(chip.rose(Pin::kXWr), expected) << ready;
    EXPECT_EQ(chip.rose(Pin::kXCs), expected + 1) << ready;
  }
}

TEST(BusCycle, WaitsByThePolarityOfNwaitAndOnlyIfItIsOn) {
  Ready rises(kStart + 9000, true), never(bus::kNever);
  run(rises, true, kWhileLow);
  EXPECT_EQ(rises.rose(Pin::kXWr), 12);
  run(never, true, kOff);
  EXPECT_EQ(never.rose(Pin::kXWr), 7);
}

}  // namespace
}  // namespace dsdpv1
