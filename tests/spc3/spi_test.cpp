// SPI of the VPC3+S at the pins (docs/spc3.md, A59 to A61), edge by edge.
#include <random>
#include <string>
#include <utility>

#include "tests/spc3/bus_user.hpp"

namespace dsdpv1::spc3_test {
namespace {

using spc3::Level;
using spc3::Reason;

constexpr std::uint8_t kWriteArray = 0x02, kReadArray = 0x03, kWriteByte = 0x12, kReadByte = 0x13;
constexpr Tick kHalf = 700;  // of a period of SCK, 8.6 MHz

/// A CPU at SPI.
class SpiUser {
 public:
  explicit SpiUser(Bench& bench, unsigned mode = 0) : bench_(bench), mode_(mode) {
    set(Pin::kSck, rest());
    set(Pin::kSerial, 1);
  }

  void set(Pin pin, Level level) { bench_.twins.set(bench_.now(), pin, level); }
  void wait(Tick time) { bench_.run_until(bench_.now() + time); }
  Level miso() const { return bench_.twins.chip().level(Pin::kMiso); }

  void begin() {
    set(Pin::kXss, 0);
    wait(kHalf);
  }
  void end() {
    set(Pin::kXss, 1);
    wait(kHalf);
  }
  /// A period of SCK; returns MISO before the edge that takes MOSI.
  bool bit(bool mosi) {
    const bool late = (mode_ & 1U) != 0;
    if (late) set(Pin::kSck, static_cast<Level>(1 - rest()));
    set(Pin::kMosi, mosi ? 1 : 0);
    wait(kHalf);
    const bool got = miso() != 0;
    set(Pin::kSck, late ? rest() : static_cast<Level>(1 - rest()));
    wait(kHalf);
    if (!late) set(Pin::kSck, rest());
    return got;
  }
  std::uint8_t byte(std::uint8_t out, int bits = 8) {
    unsigned in = 0;
    for (int i = 0; i < bits; ++i) in = in << 1 | (bit((out >> (7 - i) & 1) != 0) ? 1U : 0U);
    return static_cast<std::uint8_t>(in);
  }
  void head(std::uint8_t instruction, unsigned address) {
    begin();
    byte(instruction);
    byte(static_cast<std::uint8_t>(address >> 8));
    byte(static_cast<std::uint8_t>(address & 0xFF));
  }
  Bytes read(std::uint8_t instruction, unsigned address, int count) {
    head(instruction, address);
    Bytes in;
    for (int i = 0; i < count; ++i) in.push_back(byte(0));
    end();
    return in;
  }
  void write(std::uint8_t instruction, unsigned address, const Bytes& bytes) {
    head(instruction, address);
    for (const std::uint8_t each : bytes) byte(each);
    end();
  }

 private:
  Level rest() const { return (mode_ & 2U) != 0 ? 1 : 0; }

  Bench& bench_;
  const unsigned mode_;
};

spc3::Config with(std::uint32_t mode, std::uint32_t fetch) {
  spc3::Config config;
  config.spi_mode = mode;
  config.spi_fetch = fetch;
  return config;
}

struct Vpc3Spi : testing::Test {
  explicit Vpc3Spi(std::uint32_t mode = 0, std::uint32_t fetch = 0)
      : bench(Variant::kVpc3, with(mode, fetch)), user(bench, mode) {
    bench.power_on();
    bench.run_cycles(10);
  }
  std::uint8_t cell(unsigned address) const { return bench.twins.chip().peek(static_cast<Address>(address)); }
  int count(const profibus::ReasonRow& row) const { return bench.count(row); }
  int count(profibus::Reason reason) const { return bench.count(reason); }

  Bench bench;
  SpiUser user;
};

TEST_F(Vpc3Spi, BytesAndArraysAreReadAndWritten) {
  user.write(kWriteByte, 0x123, {0xA5});
  user.write(kWriteArray, 0x400, {1, 2, 3});
  EXPECT_EQ(cell(0x123), 0xA5);
  EXPECT_EQ(user.read(kReadByte, 0x123, 1), (Bytes{0xA5}));
  EXPECT_EQ(user.read(kReadArray, 0x3FF, 5), (Bytes{0, 1, 2, 3, 0}));
  user.write(kWriteByte, regs::kImr, {0x0F});
  user.write(kWriteArray, regs::kIrr, {0xF1, 0x20});
  EXPECT_EQ(user.read(kReadArray, regs::kIrr, 4), (Bytes{0xF1, 0x20, 0xF0, 0x00})) << "IRR, IR";
  EXPECT_TRUE(bench.twins.events.empty());
}

struct EachSpiMode : Vpc3Spi, testing::WithParamInterface<unsigned> {
  EachSpiMode() : Vpc3Spi(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(Modes, EachSpiMode, testing::Range(0U, 4U));
TEST_P(EachSpiMode, IsThatOfTheParameter) {
  user.write(kWriteArray, 0x200, {0x80, 0x01, 0xC3});
  EXPECT_EQ(user.read(kReadArray, 0x200, 3), (Bytes{0x80, 0x01, 0xC3}));
  EXPECT_TRUE(bench.twins.events.empty());
  SpiUser other(bench, GetParam() ^ 2U);
  other.read(kReadByte, 0x200, 1);
  EXPECT_EQ(count(Reason::kSpiRest), 1);
  EXPECT_EQ(spc3::describe(bench.twins.events.front()), "XSS falls while SCK is " + std::to_string(1 - GetParam() / 2) +
                                                            ": not the rest of mode " + std::to_string(GetParam()));
}

TEST_F(Vpc3Spi, AReadActsWithItsFirstBit) {
  user.head(kReadByte, regs::kNewDin);
  user.wait(1'000'000);
  EXPECT_EQ(cell(regs::kDinSm), 0xE1);
  user.bit(false);
  const std::uint8_t after = cell(regs::kDinSm);
  EXPECT_NE(after, 0xE1);
  EXPECT_EQ(user.byte(0, 7), 3) << "the new U";
  user.end();
  EXPECT_EQ(cell(regs::kDinSm), after) << "once";
  // An array acts once for each byte that is clocked: New_Din, and not New_Diag.
  EXPECT_EQ(user.read(kReadArray, regs::kDinSm, 5), (Bytes{after, 2, 0xE1, 2, 0x09}));
  EXPECT_EQ(cell(regs::kDiagSm), 0x09);
  EXPECT_TRUE(bench.twins.events.empty());
}

struct SpiAhead : Vpc3Spi {
  SpiAhead() : Vpc3Spi(0, 1) {}
};
TEST_F(SpiAhead, MayActWithTheLastBitBefore) {
  user.head(kReadByte, regs::kNewDin);
  const std::uint8_t after = cell(regs::kDinSm);
  EXPECT_NE(after, 0xE1);
  EXPECT_EQ(user.byte(0), 3);
  user.end();
  EXPECT_EQ(cell(regs::kDinSm), after) << "a single byte is fetched once";
  EXPECT_EQ(user.read(kReadArray, regs::kDiagSm, 1), (Bytes{0x09}));
  EXPECT_NE(cell(regs::kDiagSm), 0x09) << "New_Diag was fetched, though not clocked";
  EXPECT_EQ(user.read(kReadArray, 0x16, 2).size(), 2U);
}

TEST_F(Vpc3Spi, AWriteActsWithItsLastBit) {
  user.head(kWriteArray, 0x300);
  user.byte(0x11);
  EXPECT_EQ(cell(0x300), 0x11);
  user.byte(0xFF, 7);
  EXPECT_EQ(cell(0x301), 0);
  user.end();
  EXPECT_EQ(cell(0x301), 0);
  EXPECT_EQ(spc3::describe(bench.twins.events.at(0)),
            "XSS rises after 4 bytes and 7 bits: a byte of a write that is not whole does nothing");
}

TEST_F(Vpc3Spi, WhatIsNoFrameIsReported) {
  user.write(0x55, 0x100, {1, 2});
  EXPECT_EQ(count(Reason::kSpiInstruction), 1);
  user.write(kWriteByte, 0x100, {1, 2, 3});
  EXPECT_EQ(user.read(kReadByte, 0x100, 3), (Bytes{1, 0xFF, 0xFF}));
  EXPECT_EQ(count(Reason::kSpiMore), 2) << "once in a frame";
  EXPECT_EQ(cell(0x101), 0);
  user.write(kWriteArray, 0x200, {});
  user.begin();
  user.byte(kReadArray);
  user.byte(0);
  user.end();
  EXPECT_EQ(count(Reason::kSpiCut), 2);
  user.begin();
  user.end();
  EXPECT_EQ(count(Reason::kSpiCut), 2) << "nothing was asked";
  user.write(kWriteByte, 0x5123, {7});
  EXPECT_EQ(cell(0x123), 7);
  EXPECT_EQ(count(Reason::kSpiAddress), 1);
}

/// FFFH is followed by 000H: of 2 KB both are reported, the violation (A3) and the wrap.
TEST_F(Vpc3Spi, TheAddressWrapsAtTheEndOfTheMap) {
  user.write(kWriteByte, regs::kMode2, {0x81});  // 4 KB
  user.write(kWriteArray, 0xFFE, {1, 2, 0x34, 0x12});
  EXPECT_EQ(cell(0xFFF), 2);
  EXPECT_EQ(user.read(kReadArray, 0xFFF, 3), (Bytes{2, 0x34, 0x12})) << "IRR";
  EXPECT_EQ(count(Reason::kSpiAddress), 2);
  EXPECT_EQ(count(Reason::kRamViolation), 0);
  user.write(kWriteByte, regs::kMode2, {0x01});
  EXPECT_EQ(user.read(kReadArray, 0x7FF, 1).size(), 1U);
  EXPECT_EQ(count(Reason::kRamViolation), 0) << "the byte after the last one is not clocked";
  user.read(kReadArray, 0x7FF, 2);
  EXPECT_EQ(count(Reason::kRamViolation), 1);
}

TEST_F(Vpc3Spi, TheParallelPinsAreDeadAndViceVersa) {
  bench.twins.poke(0x123, 0x42);
  user.set(Pin::kAb, 0x123);
  user.set(Pin::kXCs, 0);
  user.set(Pin::kXRd, 0);
  user.wait(5000);
  EXPECT_EQ(bench.twins.chip().level(Pin::kXReady), 1);
  EXPECT_EQ(bench.twins.chip().level(Pin::kDbOut), spc3::kLevelZ);
  EXPECT_EQ(user.miso(), spc3::kLevelZ);
  user.set(Pin::kSerial, 0);
  user.wait(5000);
  EXPECT_EQ(bench.twins.chip().level(Pin::kDbOut), 0x42) << "the strap has changed";
  user.write(kWriteByte, 0x123, {0x43});
  EXPECT_EQ(cell(0x123), 0x42);
  EXPECT_EQ(user.miso(), spc3::kLevelZ);
  EXPECT_TRUE(bench.twins.events.empty());
}

TEST_F(Vpc3Spi, ResetEndsAFrame) {
  user.head(kReadArray, 0x100);
  EXPECT_EQ(user.miso(), 0);
  user.set(Pin::kReset, 1);
  EXPECT_EQ(user.miso(), spc3::kLevelZ);
  user.byte(0);
  user.end();
  user.begin();
  user.wait(kHalf);
  EXPECT_EQ(count(Reason::kSpiInReset), 0);
  user.byte(kWriteByte);
  EXPECT_EQ(count(Reason::kSpiInReset), 1);
  user.end();
  user.begin();
  user.set(Pin::kReset, 0);
  EXPECT_EQ(user.miso(), spc3::kLevelZ);
  user.wait(10 * profibus::kTicksPerCycle);
  EXPECT_EQ(user.miso(), 1) << "no edge of SCK has come yet: it is heard (A9)";
  user.byte(kWriteByte);
  user.byte(1);
  user.byte(0x23);
  user.byte(9);
  user.end();
  EXPECT_EQ(cell(0x123), 9);
  EXPECT_EQ(bench.twins.events.size(), 1U);
}

TEST(SpiEdges, SckBetweenHighAndFloatingIsNoEdge) {
  Bench bench(Variant::kVpc3);
  bench.power_on();
  SpiUser user(bench);
  user.begin();
  for (int i = 7; i >= 0; --i) {
    user.set(Pin::kMosi, static_cast<Level>(kReadByte >> i & 1));
    user.wait(kHalf);
    for (const Level level : {Level{1}, spc3::kLevelZ, spc3::kLevelX, Level{1}, Level{0}}) {
      user.set(Pin::kSck, level);
      user.wait(kHalf);
    }
  }
  user.byte(0);
  user.byte(0x20);
  user.byte(0);
  user.end();
  EXPECT_EQ(bench.count(Reason::kSpiInstruction), 0);
  EXPECT_EQ(bench.count(Reason::kSpiCut), 0);
}

struct WideBus : testing::TestWithParam<Bus> {};
INSTANTIATE_TEST_SUITE_P(Buses, WideBus,
                         testing::Values(Bus::kIntelAsync, Bus::kIntelSync, Bus::kMotorolaAsync, Bus::kMotorolaSync));
TEST_P(WideBus, Ab11ReachesTheUpperHalf) {
  Bench bench(Variant::kVpc3);
  bench.power_on();
  BusUser user(bench, GetParam());
  user.write(regs::kMode2, 0x81);  // 4 KB
  user.set(Pin::kAb11, 1);
  user.write(0x123, 0x5A);
  EXPECT_EQ(user.read(0x123), 0x5A);
  EXPECT_EQ(bench.twins.chip().peek(0x923), 0x5A);
  EXPECT_EQ(bench.twins.chip().peek(0x123), 0);
  user.set(Pin::kAb11, spc3::kLevelX);
  user.read(0x123);
  EXPECT_EQ(bench.count(Reason::kUnknownAddress), 1);
}

/// Random frames against the register call: each byte of a read that is begun loads, each whole byte of a write stores.
class RandomFrames {
 public:
  explicit RandomFrames(unsigned seed) : random_(seed), mode_(seed % 4), bench_(Variant::kVpc3, with(mode_, 0)) {
    bench_.power_on();
    other_.power_on();
    bench_.run_cycles(10);
  }

  void play(int frames) {
    for (int i = 0; i < frames && !testing::Test::HasFailure(); ++i) frame();
    for (Address each = 0; each < 0x1000; ++each) ASSERT_EQ(chip().peek(each), other_.twins.chip().peek(each)) << each;
    EXPECT_EQ(chip().level(Pin::kXInt), other_.twins.chip().level(Pin::kXInt));
  }

 private:
  unsigned below(unsigned end) { return static_cast<unsigned>(random_() % end); }
  const spc3::Chip& chip() const { return bench_.twins.chip(); }

  void frame() {
    static constexpr std::uint8_t kInstructions[] = {kWriteArray, kReadArray, kWriteByte, kReadByte, 0x00, 0xFF};
    const std::uint8_t instruction = kInstructions[below(6)];
    const unsigned address = below(4) == 0 ? below(0x10000) : below(2) == 0 ? below(0x18) : below(0x800);
    const unsigned bytes = below(6), cut = below(3) == 0 ? below(8) : 0;
    user_.begin();
    if (below(8) == 0) return user_.end();
    for (const unsigned each : {unsigned{instruction}, address >> 8, address & 0xFF})
      EXPECT_EQ(user_.byte(static_cast<std::uint8_t>(each)), 0xFF) << "no data yet";
    for (unsigned i = 0; i < bytes; ++i) data(instruction, address + i, i, 8);
    if (cut != 0) data(instruction, address + bytes, bytes, static_cast<int>(cut));
    user_.end();
    EXPECT_EQ(user_.miso(), spc3::kLevelZ);
  }
  void data(std::uint8_t instruction, unsigned address, unsigned number, int bits) {
    const auto where = static_cast<Address>(address & 0xFFF);
    const bool known = (instruction & 0xEE) == 2, counts = known && (instruction < 0x10 || number == 0);
    const bool read = (instruction & 1) != 0;
    std::uint8_t out = static_cast<std::uint8_t>(below(256));
    if (where == regs::kMode1S) out &= 0xFE;  // never START
    const bool was_read = counts && read;
    const std::uint8_t expected = was_read ? other_.load(where) : std::uint8_t{0xFF};
    EXPECT_EQ(user_.byte(out, bits), expected >> (8 - bits)) << std::hex << int{instruction} << " " << where;
    if (counts && !read && bits == 8) other_.store(where, out);
    other_.run_until(bench_.now());
  }

  std::mt19937 random_;
  const unsigned mode_;
  Bench bench_, other_{Variant::kVpc3};
  SpiUser user_{bench_, mode_};
};

TEST(RandomSpi, FramesAreTheRegisterCall) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    RandomFrames(seed).play(60);
  }
}

}  // namespace
}  // namespace dsdpv1::spc3_test
