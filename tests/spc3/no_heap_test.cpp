// The core takes memory when it is made and at no other time. A separate program, because it replaces operator new.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <new>
#include <vector>

#include "model/profibus/character_run.hpp"
#include "model/spc3/chip.hpp"

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

namespace dsdpv1::spc3 {
namespace {

class Spc3NoHeap : public testing::TestWithParam<Engine> {};
INSTANTIATE_TEST_SUITE_P(Engines, Spc3NoHeap, testing::Values(Engine::kStep, Engine::kSkip));

/// A chip, and a master on its RXD at 12 Mbit/s.
class Line {
 public:
  explicit Line(Engine engine) : chip(with(engine)) {
    chip.watch({[](void* self, Tick, Pin, Level) { ++static_cast<Line*>(self)->changes; }, this}, kOutputPins);
    chip.on_event({[](void*, const profibus::Event&) {}, nullptr});
    chip.set(2500, Pin::kReset, 0);
    chip.advance(now);
  }
  /// A telegram with SD2 after T_SYN, and the time of its answer: in skip every second one as a run.
  void send(const std::uint8_t* body, int size) {
    unsigned sum = 0;
    for (int i = 0; i < size; ++i) sum += body[i];
    const auto length = static_cast<std::uint8_t>(size);
    now += Tick{40} * 4 * profibus::kTicksPerCycle;
    std::array<std::uint8_t, 32> bytes = {0x68, length, length, 0x68};
    std::copy_n(body, size, bytes.begin() + 4);
    bytes.at(length + 4U) = static_cast<std::uint8_t>(sum & 0xFF);
    bytes.at(length + 5U) = 0x16;
    pass(bytes.data(), size + 6);
    now += Tick{500} * 4 * profibus::kTicksPerCycle;
    chip.advance(now);
  }
  void store(Address address, std::uint8_t value) { chip.store(now / profibus::kTicksPerCycle, address, value); }
  void load(Address address) { chip.load(now / profibus::kTicksPerCycle, address); }

  Chip chip;
  std::size_t changes = 0;
  int runs = 0;

 private:
  static Config with(Engine engine) {
    Config config;
    config.engine = engine;
    return config;
  }
  void pass(const std::uint8_t* bytes, int size) {
    if (++telegrams % 2 == 0 && chip.hear(now, {now, 4, bytes, size})) {
      ++runs;
      now += Tick{size} * 11 * 4 * profibus::kTicksPerCycle;
      return;
    }
    for (int i = 0; i < size; ++i) character(bytes[i]);
  }
  void character(std::uint8_t value) {
    for (unsigned frame = profibus::frame_of(value), bit = 0; bit < 11; ++bit, frame >>= 1) {
      chip.set(now, Pin::kRxd, static_cast<Level>(frame & 1U));
      now += 4 * profibus::kTicksPerCycle;
    }
  }
  Tick now = 20'000;
  int telegrams = 0;
};

constexpr std::uint8_t kPrm[] = {0x85, 0x82, 0x6D, 61, 62, 0x80, 0, 0, 11, 0, 0, 0, 0};
constexpr std::uint8_t kCfg[] = {0x85, 0x82, 0x6D, 62, 62, 0x10};
constexpr std::uint8_t kDiag[] = {0x85, 0x82, 0x6D, 60, 62};
constexpr std::uint8_t kData[] = {0x05, 0x02, 0x6D, 0x11};

TEST_P(Spc3NoHeap, FromResetToDataExchangeAndAgain) {
  Line line(GetParam());
  constexpr Address kCells[][2] = {{0x16, 5},    {0x1A, 1},    {0x1B, 0x10}, {0x1C, 0x12}, {0x1D, 0x14}, {0x1E, 1},
                                   {0x1F, 0x16}, {0x20, 0x18}, {0x21, 0x1A}, {0x24, 6},    {0x25, 6},    {0x26, 0x1C},
                                   {0x27, 0x1E}, {0x28, 16},   {0x2B, 0x20}, {0x30, 0x24}, {0x32, 0x28}, {0x07, 0x01}};
  const std::size_t before = allocations;
  for (const auto& [address, value] : kCells) line.store(address, static_cast<std::uint8_t>(value));
  line.load(regs::kNewDin);
  line.store(regs::kMode1S, regs::kMode1Start | regs::kMode1ResUserWd);
  for (int round = 0; round < 2; ++round) {
    line.send(kDiag, sizeof kDiag);
    line.send(kPrm, sizeof kPrm);
    line.load(regs::kPrmOk);
    line.send(kCfg, sizeof kCfg);
    line.load(regs::kCfgOk);
    line.load(regs::kNewDin);
    for (int i = 0; i < 5; ++i) line.send(kData, sizeof kData);
    EXPECT_EQ(line.chip.status().dp_state, profibus::DpState::kDataExch);
    line.load(regs::kNewDiag);
    line.send(kDiag, sizeof kDiag);
    line.load(0x700);
    line.send(kDiag, sizeof kDiag);
    line.store(regs::kMode1S, regs::kMode1Start);
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(line.changes, 500U);
  EXPECT_EQ(line.runs > 5, GetParam() == Engine::kSkip);
  int* volatile one = new int;
  delete one;
  EXPECT_GT(allocations, before) << "the counter itself counts";
}

}  // namespace
}  // namespace dsdpv1::spc3
