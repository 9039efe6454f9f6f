// The core takes memory when it is made and at no other time: start-up, baud rate search, bring-up, data exchange and
// a reset go by without a single allocation. A separate program, because it replaces operator new.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <optional>

#include "tests/bench/saturated_bus.hpp"

namespace {
std::size_t allocations = 0;

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

using dsdpv1::Level;
using dsdpv1::Pin;
using dsdpv1::profibus::Tick;

/// A chip that counts what is allocated while it is in a call.
class Counted {
 public:
  Counted(dsdpv1::Engine engine, bool takes_runs) : takes_runs_(takes_runs), chip_(with(engine)) {
    chip_.watch(pins_.sink(), dsdpv1::speed::PinCounter::kWatched);
    chip_.on_event({[](void* self, const dsdpv1::profibus::Event&) { ++static_cast<Counted*>(self)->events_; }, this});
  }
  void set(Tick at, Pin pin, Level level) {
    during([&] { chip_.set(at, pin, level); });
  }
  void advance(Tick to) {
    during([&] { chip_.advance(to); });
  }
  bool hear(Tick at, const dsdpv1::profibus::CharacterRun& run) {
    bool taken = false;
    during([&] { taken = takes_runs_ && chip_.hear(at, run); });
    return taken;
  }
  Level level(Pin pin) { return chip_.level(pin); }
  dsdpv1::Status status() const { return chip_.status(); }
  std::size_t allocated() const { return allocated_; }
  std::size_t events() const { return events_; }

 private:
  static dsdpv1::Config with(dsdpv1::Engine engine) {
    dsdpv1::Config config;
    config.engine = engine;
    return config;
  }
  template <class Call>
  void during(const Call& call) {
    const std::size_t before = allocations;
    call();
    allocated_ += allocations - before;
  }
  bool takes_runs_;
  dsdpv1::speed::PinCounter pins_;
  dsdpv1::Chip chip_;
  std::size_t allocated_ = 0, events_ = 0;
};

struct Way {
  const char* name;
  dsdpv1::Engine engine;
  bool takes_runs;
};
class NoHeap : public testing::TestWithParam<Way> {};
INSTANTIATE_TEST_SUITE_P(Engines, NoHeap,
                         testing::Values(Way{"Step", dsdpv1::Engine::kStep, false},
                                         Way{"Skip", dsdpv1::Engine::kSkip, false},
                                         Way{"SkipWithRuns", dsdpv1::Engine::kSkip, true}),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(NoHeap, FromResetToDataExchangeAndAgain) {
  Counted chip(GetParam().engine, GetParam().takes_runs);
  dsdpv1::speed::SaturatedBus<Counted> bus(chip, 64);
  for (int round = 0; round < 2; ++round) {
    bus.start();
    for (int i = 0; i < 20; ++i) bus.exchange();
    EXPECT_EQ(chip.status().data_exchanges, 20U);
    chip.set(bus.now(), Pin::kReset, 0);
  }
  EXPECT_GT(chip.events(), 10U);
  EXPECT_EQ(chip.allocated(), 0U);
  const std::size_t before = allocations;
  int* volatile one = new int;
  delete one;
  EXPECT_GT(allocations, before) << "the counter itself counts";
}

/// SPI or UART of a DSDPV1-RSU: a write and an exchange of inputs, again and again.
class SerialNoHeap : public testing::TestWithParam<dsdpv1::Engine> {
 protected:
  void start(Level mode) {
    chip_.emplace(with(GetParam()));
    chip_->watch(pins_.sink(), dsdpv1::outputs_of(dsdpv1::Part::kRsu));
    chip_->set(0, Pin::kMode, mode);
    chip_->set(0, Pin::kAdr, 1);
    chip_->set(0, Pin::kUbr, 7);
    chip_->set(5000, Pin::kReset, 1);
    now_ = 3000 * 250;
    chip_->advance(now_);
  }
  void set(Pin pin, unsigned level, Tick ticks) {
    chip_->set(now_, pin, static_cast<Level>(level & 1U));
    now_ += ticks;
    chip_->advance(now_);
  }
  static dsdpv1::Config with(dsdpv1::Engine engine) {
    dsdpv1::Config config;
    config.engine = engine;
    config.part = dsdpv1::Part::kRsu;
    return config;
  }
  dsdpv1::speed::PinCounter pins_;
  std::optional<dsdpv1::Chip> chip_;
  Tick now_ = 0;
};
INSTANTIATE_TEST_SUITE_P(Engines, SerialNoHeap, testing::Values(dsdpv1::Engine::kStep, dsdpv1::Engine::kSkip));

constexpr std::uint8_t kSpiWrite[] = {0x21, 0x01, 0x00, 0x01, 0x5A, 0x19, 0xA2};
constexpr std::uint8_t kUartExchange[] = {0x41, 0x00, 0x01, 0x30, 0x02, 0x01, 0x55, 0xAB, 0x18};

TEST_P(SerialNoHeap, SpiTelegrams) {
  start(1);
  const std::size_t before = allocations;
  for (int round = 0; round < 10; ++round) {
    set(Pin::kXss, 0, 600);
    for (const unsigned byte : kSpiWrite) {
      for (int bit = 7; bit >= 0; --bit) {
        set(Pin::kMosi, byte >> bit, 600);
        set(Pin::kSck, 1, 600);
        set(Pin::kSck, 0, 0);
      }
    }
    set(Pin::kXss, 1, 40'000);
  }
  EXPECT_EQ(allocations, before);
}

TEST_P(SerialNoHeap, UartTelegrams) {
  start(2);
  const std::size_t before = allocations;
  for (int round = 0; round < 10; ++round) {
    for (const unsigned byte : kUartExchange) {
      const unsigned parity = static_cast<unsigned>(__builtin_popcount(byte)) & 1U;
      const unsigned frame = byte << 1 | parity << 9 | 1U << 10;
      for (int bit = 0; bit < 11; ++bit) set(Pin::kRxd, frame >> bit, 26 * 250);
    }
    set(Pin::kRxd, 1, Tick{26} * 300 * 250);
  }
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(chip_->peek(0x130), 0x01) << "carried out";
}

}  // namespace
