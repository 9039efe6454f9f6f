// SPI: telegrams, ownership, replies, U_Timer (SP4 to SP18).
#include "tests/conformance/rsu_bench.hpp"

namespace dsdpv1::conformance {
namespace {

using R = dsdpv1::Reason;

class RsuSpi : public ::testing::Test {
 protected:
  void SetUp() override { bench_.power_on(); }
  RsuBench bench_;
};

/// In one frame: SP11 does not hear the second until XSS has risen.
Bytes and_then_a_right_read(Bytes mosi) {
  const Bytes read = read_telegram(0x000, 1);
  mosi.resize(mosi.size() + 5, 0xFF);
  mosi.insert(mosi.end(), read.begin(), read.end());
  mosi.resize(mosi.size() + 5, 0xFF);
  return mosi;
}

Bytes error(std::uint8_t code) { return with_crc({0xE1, code}); }

// docs/microarchitecture_rsu.md, section 10.
TEST_F(RsuSpi, WorkedExampleToTheCycle) {
  bench_.run_until(1'000'000);
  bench_.forget_events();
  EXPECT_EQ(bench_.spi({0x01, 0x00, 0x14, 0x01, 0x18, 0xCF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}),
            (Bytes{0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x81, 0x00, 0x00, 0xE8, 0x21}));
  bench_.run_cycles(100);
  std::vector<Tick> at;
  for (const PinChange& change : bench_.changes(Pin::kMiso)) at.push_back(change.at);
  EXPECT_EQ(at, (std::vector<Tick>{1'000'000, 1'058'920, 1'066'120, 1'067'320, 1'086'520, 1'090'120, 1'091'320,
                                   1'092'520, 1'098'520, 1'099'720, 1'104'520, 1'106'200}));
  EXPECT_EQ(bench_.changes(Pin::kMiso).front().level, 1);
  EXPECT_EQ(bench_.changes(Pin::kMiso).back().level, kLevelZ);
  EXPECT_EQ(bench_.events().size(), static_cast<std::size_t>(bench_.count(dpram::Reason::kReadyFlag)));
}

TEST(RsuTelegram, CrcOfTheExamples) {
  EXPECT_EQ(with_crc({0x01, 0x00, 0x14, 0x01}), (Bytes{0x01, 0x00, 0x14, 0x01, 0x18, 0xCF}));
  EXPECT_EQ(with_crc({0x81, 0x00, 0x00}), (Bytes{0x81, 0x00, 0x00, 0xE8, 0x21}));
  EXPECT_EQ(with_crc({0xA1, 0x00}), (Bytes{0xA1, 0x00, 0x20, 0x78}));
  const Bytes uart = {0x01, 0x20, 0x05, 0x00, 0x07, 0x30, 0x30, 0x06, 0x1F, 0x2F, 0x1F, 0x2F, 0x1F, 0x2F};
  EXPECT_EQ(part_of(with_crc(uart), uart.size(), 2), (Bytes{0x3B, 0xF0}));
}

TEST_F(RsuSpi, ClaimUseRelease) {
  EXPECT_EQ(bench_.read(0x014, 1)[0] & 0xFE, 0x00);
  bench_.claim();
  EXPECT_EQ(bench_.count(R::kSpiClaimed), 1);
  EXPECT_EQ(bench_.read(0x014, 1), Bytes{0x02});
  EXPECT_EQ(bench_.peek(0x014), 0x02);
  EXPECT_EQ(bench_.ask(write_telegram(0x020, {1, 2, 3, 4}), 4), with_crc({0xA1, 0x00}));
  EXPECT_EQ(bench_.peek(0x020, 4), (Bytes{1, 2, 3, 4}));
  EXPECT_EQ(bench_.ask(read_telegram(0x01F, 6), 10), with_crc({0x81, 0x00, 0, 1, 2, 3, 4, 0}));
  const std::uint64_t accesses = bench_.status().accesses;
  bench_.run_cycles(1000);
  EXPECT_EQ(bench_.status().accesses, accesses) << "the chip keeps off";
  bench_.release();
  bench_.run_cycles(100);
  EXPECT_GT(bench_.status().accesses, accesses);
  EXPECT_EQ(bench_.count(R::kSpiReleased), 1);
  EXPECT_EQ(bench_.count(R::kSpiNoClaim), 0);
}

// A commit moves one byte a cycle from beg + 1 on, and the due access begins at Q.
TEST_F(RsuSpi, ReleaseLetsTheAccessBegin) {
  bench_.claim();
  bench_.run_cycles(500);
  Bytes mosi = write_telegram(0x014, {0x00});
  const std::uint64_t accesses = bench_.status().accesses;
  bench_.spi(mosi, {600, 600, 600, 0, 0, true});
  // J is 3 to 4 cycles after the last rise, the access one more
  const Tick last_rise = bench_.now() - 600;
  const Cycle judged = last_rise / 250 + 1 + 2 + 1;
  bench_.run_until(judged * 250);
  EXPECT_EQ(bench_.last(R::kSpiReleased).at, bench_.now());
  EXPECT_EQ(bench_.status().accesses, accesses);
  bench_.run_until((judged + 1) * 250);
  EXPECT_EQ(bench_.status().accesses, accesses + 1);
  EXPECT_GT(bench_.status().longest_wait, 0U);
}

// SP9: kept until J, then one byte a cycle, ascending; the access that the release lets in waits for the last.
TEST_F(RsuSpi, AWriteMovesOneByteACycleAscendingAfterItsJudgement) {
  bench_.claim();
  bench_.run_cycles(500);
  const std::uint64_t accesses = bench_.status().accesses;
  bench_.spi(write_telegram(0x014, {0x00, 7, 8, 9}), {600, 600, 600, 0, 0, true});
  const Cycle judged = (bench_.now() - 600) / 250 + 4;
  const Bytes after[] = {{0, 0, 0}, {0, 0, 0}, {7, 0, 0}, {7, 8, 0}, {7, 8, 9}};
  for (Cycle i = 0; i <= 4; ++i) {
    bench_.run_until((judged + i) * 250);
    EXPECT_EQ(bench_.peek(0x015, 3), after[i]) << i;
    if (i < 4) EXPECT_EQ(bench_.status().accesses, accesses) << i;
  }
  bench_.run_cycles(2);
  EXPECT_EQ(bench_.status().accesses, accesses + 1);
}

TEST_F(RsuSpi, WrongCrcIsBitZeroAlone) {
  Bytes telegram = read_telegram(0xF900, 0);
  telegram.back() ^= 1;
  EXPECT_EQ(bench_.ask(telegram, 4), error(0x01));
  EXPECT_EQ(bench_.count(R::kTelegramCrc), 1);
  EXPECT_EQ(bench_.count(R::kTelegramAddress), 0);
}

TEST_F(RsuSpi, ErrorBits) {
  EXPECT_EQ(bench_.ask(read_telegram(0x0800, 1), 4), error(0x02));
  EXPECT_EQ(bench_.last(R::kTelegramAddress).a, 0x0800);
  EXPECT_EQ(bench_.ask(read_telegram(0x0100, 0), 4), error(0x04));
  EXPECT_EQ(bench_.ask(read_telegram(0x0100, 246), 4), error(0x04));
  EXPECT_EQ(bench_.last(R::kTelegramData).b, 245);
  EXPECT_EQ(bench_.ask(read_telegram(0x07F0, 17), 4), error(0x04));
  EXPECT_EQ(bench_.last(R::kTelegramData).b, 16);
  EXPECT_EQ(bench_.last(R::kTelegramData).c, 0x07F0);
  EXPECT_EQ(bench_.ask(read_telegram(0xFFFF, 2), 4), error(0x06));
  EXPECT_EQ(bench_.ask(write_telegram(0x100, Bytes(246, 7)), 4), error(0x0C));
  EXPECT_EQ(bench_.last(R::kTelegramLength).a, 252);
  EXPECT_EQ(bench_.last(R::kTelegramLength).b, 251);
  EXPECT_EQ(bench_.ask(write_telegram(0x8700, Bytes(255, 7)), 4), error(0x0E));
  EXPECT_EQ(bench_.ask(inputs_telegram(Bytes(245, 7)), 4), error(0x04));
  EXPECT_EQ(bench_.last(R::kTelegramData).b, 244);
  EXPECT_EQ(bench_.ask(inputs_telegram(Bytes(255, 7)), 4), error(0x0C));
  EXPECT_EQ(bench_.peek(0x100, 300), Bytes(300, 0)) << "nothing is carried out";
}

// 6.2.2: bits 15 to 11 of the address are reserved.
TEST_F(RsuSpi, EachReservedBitOfTheAddressIsAnError) {
  for (unsigned bit = 11; bit < 16; ++bit)
    EXPECT_EQ(bench_.ask(read_telegram(static_cast<std::uint16_t>(0x123U | 1U << bit), 1), 4), error(0x02)) << bit;
}

TEST_F(RsuSpi, LongestTelegrams) {
  bench_.claim();
  Bytes data(245);
  for (std::size_t i = 0; i < data.size(); ++i) data[i] = static_cast<std::uint8_t>(i * 7 + 1);
  bench_.write(0x30B, data);
  EXPECT_EQ(bench_.read(0x30B, 245), data);
  EXPECT_EQ(bench_.peek(0x30A), 0);
  EXPECT_EQ(bench_.peek(0x400), 0);
}

// SP8: data byte i is taken when byte i after the request has been handed over.
TEST_F(RsuSpi, AReadTakesEachByteTwoBeforeItIsSent) {
  for (std::size_t taken = 0; taken <= 4; ++taken) {
    bench_.claim();
    bench_.write(0x100, {1, 2, 3, 4});
    bench_.spi(read_telegram(0x100, 4), {600, 600, 600, 600, 0, true});
    Bytes reply = bench_.clock(Bytes(taken, 0xFF));
    bench_.run_cycles(10);
    for (std::uint16_t i = 0; i < 4; ++i) bench_.poke(static_cast<std::uint16_t>(0x100 + i), 9);
    const Bytes rest = bench_.clock(Bytes(8 - taken, 0xFF));
    bench_.xss(1);
    reply.insert(reply.end(), rest.begin(), rest.end());
    Bytes expected = {0x81, 0x00, 1, 2, 3, 4};
    for (std::size_t i = taken; i < 4; ++i) expected[2 + i] = 9;
    EXPECT_EQ(reply, with_crc(expected)) << taken;
    bench_.run_cycles(200);
    bench_.release();
  }
}

TEST_F(RsuSpi, StartBytesThatAreNone) {
  for (const std::uint8_t start : Bytes{0x61, 0x81, 0xE1, 0x05, 0x11, 0x49}) {
    const Bytes mosi = and_then_a_right_read({start, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_EQ(bench_.spi(mosi), Bytes(mosi.size(), 0xFF));
    EXPECT_EQ(bench_.last(R::kTelegramStart).a, start);
    bench_.run_cycles(200);
  }
  EXPECT_EQ(bench_.count(R::kTelegramStart), 6);
  EXPECT_EQ(bench_.read(0x000, 1), Bytes{1});
}

TEST_F(RsuSpi, WithoutXssNothingIsHeardOrSaid) {
  bench_.forget_events();
  bench_.clock(write_telegram(0x100, {9}));
  bench_.clock(Bytes(4, 0xFF));
  EXPECT_EQ(bench_.level(Pin::kMiso), kLevelZ);
  EXPECT_TRUE(bench_.changes(Pin::kMiso).empty());
  EXPECT_EQ(bench_.peek(0x100), 0);
  EXPECT_EQ(bench_.read(0x000, 1), Bytes{1}) << "the next frame begins anew";
}

TEST_F(RsuSpi, OtherCardsAreNotAnswered) {
  bench_.run_until(4300 * 250);  // B004 is C5
  bench_.forget_events();
  for (const std::uint8_t card : Bytes{0, 2, 3}) {
    const Bytes mosi = and_then_a_right_read(read_telegram(0x000, 1, card));
    EXPECT_EQ(bench_.spi(mosi), Bytes(mosi.size(), 0xFF));
    bench_.run_cycles(200);
  }
  EXPECT_TRUE(bench_.events().empty());
}

TEST_F(RsuSpi, WhatXssCutsIsDropped) {
  bench_.claim();
  bench_.forget_events();
  const Bytes telegram = write_telegram(0x100, {1, 2, 3});
  for (std::size_t bytes = 1; bytes < telegram.size(); ++bytes) {
    bench_.spi(part_of(telegram, 0, bytes));
    bench_.run_cycles(200);
    EXPECT_EQ(bench_.last(R::kTelegramCut).a, bytes);
    EXPECT_EQ(bench_.last(R::kTelegramCut).b, bytes < 4 ? 0 : 9);
  }
  EXPECT_EQ(bench_.peek(0x100, 3), Bytes(3, 0));
  EXPECT_EQ(bench_.count(R::kTelegramCut), static_cast<int>(telegram.size()) - 1);
  bench_.write(0x100, {1, 2, 3});
  EXPECT_EQ(bench_.peek(0x100, 3), (Bytes{1, 2, 3}));
}

TEST_F(RsuSpi, CompleteIsCarriedOutWithoutItsReply) {
  bench_.claim();
  bench_.forget_events();
  bench_.spi(write_telegram(0x100, {1, 2, 3}));
  bench_.run_cycles(200);
  EXPECT_EQ(bench_.peek(0x100, 3), (Bytes{1, 2, 3}));
  EXPECT_EQ(bench_.last(R::kSpiReplyCut).a, 0);
  EXPECT_EQ(bench_.last(R::kSpiReplyCut).b, 4);
  Bytes mosi = read_telegram(0x100, 3);
  mosi.resize(mosi.size() + 3, 0);
  EXPECT_EQ(part_of(bench_.spi(mosi), 6, 3), (Bytes{0x81, 0x00, 1}));
  bench_.run_cycles(200);
  EXPECT_EQ(bench_.last(R::kSpiReplyCut).a, 3);
  EXPECT_EQ(bench_.last(R::kSpiReplyCut).b, 7);
}

// XSS rises so soon after the last rise that the judgement comes after it.
TEST_F(RsuSpi, XssRisesBeforeTheJudgement) {
  bench_.claim();
  bench_.forget_events();
  bench_.spi(write_telegram(0x100, {9}), {100, 600, 600, 50, 0, false});
  bench_.run_cycles(200);
  EXPECT_EQ(bench_.peek(0x100), 9);
  EXPECT_EQ(bench_.count(R::kSpiReplyCut), 1);
}

TEST_F(RsuSpi, BytesAfterTheRequestAreNotLookedAt) {
  Bytes mosi = read_telegram(0x000, 1);
  const Bytes more = write_telegram(0x100, {7});
  mosi.insert(mosi.end(), more.begin(), more.end());
  mosi.resize(mosi.size() + 4, 0x00);
  const Bytes miso = bench_.spi(mosi);
  EXPECT_EQ(part_of(miso, 6, 5), with_crc({0x81, 0x00, 0x01}));
  EXPECT_EQ(part_of(miso, 11, 100), Bytes(miso.size() - 11, 0xFF)) << "FF after its end";
  bench_.run_cycles(200);
  EXPECT_EQ(bench_.peek(0x100), 0);
}

// The chip is in an access of 7 cycles each 48: of claims at all phases of CLK and the access some are refused, none
// while it is out.
TEST_F(RsuSpi, ClaimIsRefusedWhileTheChipIsInAnAccess) {
  int refused = 0, granted = 0;
  for (int i = 0; i < 48; ++i) {
    const Bytes reply = bench_.ask(write_telegram(0x014, {0x02}), 4);
    if (reply == error(0x00)) {
      ++refused;
      EXPECT_EQ(bench_.last(R::kSpiBusy).a, 0);
      EXPECT_EQ(bench_.peek(0x014) & 2, 0);
    } else {
      ++granted;
      EXPECT_EQ(reply, with_crc({0xA1, 0x00}));
      bench_.release();
    }
    bench_.run_cycles(i % 7);
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(granted, 20);
  EXPECT_EQ(bench_.count(R::kSpiBusy), refused);
}

/// The cycle at which the next access of the chip begins: nothing shows it in this mode but the counter.
Cycle next_access(RsuBench& bench) {
  const std::uint64_t before = bench.status().accesses;
  while (bench.status().accesses == before) bench.run_until((bench.cycle() + 1) * 250);
  return bench.cycle();
}

// Ties of section 8: J = s, the cycle at which the access is due: the claim is first. J = e: refused still.
TEST_F(RsuSpi, TiesOfClaimAndAccess) {
  const Bytes claim = write_telegram(0x014, {0x02});
  // an access is 7 cycles long: begins at s, ends at s + 7
  for (int offset = -1; offset <= 8; ++offset) {
    RsuBench bench;
    bench.power_on();
    const Cycle due = next_access(bench) + 48 * 30;
    // J is 4 cycles after edge m - 1 of the last rise, whose tick is 250 (J - 4)
    const Tick last_rise = (due + offset - 4) * 250;
    const auto bits = static_cast<Tick>(claim.size()) * 8;
    const Tick begin = last_rise - 600 - (bits - 1) * 1200;
    bench.run_until(begin);
    bench.spi(claim, {600, 600, 600, 600, 0, true});
    bench.clock(Bytes(4, 0xFF));
    const bool refused = bench.count(R::kSpiBusy) > 0;
    const Tick judged = refused ? bench.last(R::kSpiBusy).at : bench.last(R::kSpiClaimed).at;
    EXPECT_EQ(judged, (due + offset) * 250);
    EXPECT_EQ(refused, offset >= 1 && offset <= 7) << offset;
  }
}

TEST_F(RsuSpi, OtherBitsOfB014AreIgnored) {
  bench_.claim();
  bench_.write(0x013, {0x00, 0xFD, 0x77});  // covers B014: bit 1 is 0
  EXPECT_EQ(bench_.peek(0x014) & 2, 0);
  EXPECT_EQ(bench_.peek(0x015), 0x77);
  EXPECT_EQ(bench_.last(R::kReadOnlyWritten).a, 0x013);
  EXPECT_EQ(bench_.count(R::kReadOnlyWritten), 1) << "B014 is not among them";
}

// P6, over a telegram: one event for each byte that sets bits.
TEST_F(RsuSpi, BitsThatOnlyTheChipSetsAreReported) {
  bench_.claim();
  const Cycle before = bench_.cycle();
  bench_.write(0x00A, {0x01, 0x02, 0, 0, 0x04, 0x80});
  EXPECT_EQ(bench_.count(R::kBitSet), 4);
  EXPECT_GT(bench_.last(R::kBitSet).at, before * 250);
  EXPECT_EQ(bench_.last(R::kBitSet).a, 0x00F);
  EXPECT_EQ(bench_.last(R::kBitSet).b, 0x80);
  EXPECT_EQ(bench_.last(R::kBitSet).c, 0x80);
  bench_.write(0x00E, {0x00, 0xC0});
  EXPECT_EQ(bench_.count(R::kBitSet), 5);
  EXPECT_EQ(bench_.last(R::kBitSet).c, 0x40);
}

TEST_F(RsuSpi, WithoutClaimItIsCarriedOutAndReported) {
  EXPECT_EQ(bench_.read(0x000, 4), (Bytes{0x01, 0x0D, 0x07, 0x01}));
  EXPECT_EQ(bench_.last(R::kSpiNoClaim).a, 0);
  EXPECT_EQ(bench_.last(R::kSpiNoClaim).b, 4);
  EXPECT_EQ(bench_.last(R::kSpiNoClaim).c, 0);
  bench_.write(0x100, {5});
  EXPECT_EQ(bench_.last(R::kSpiNoClaim).c, 1);
  EXPECT_EQ(bench_.peek(0x100), 5);
  const Bytes many(245, 0x5A);
  bench_.write(0x100, many);
  EXPECT_EQ(bench_.read(0x100, 245), many) << "within the chip's accesses, too";
}

// A write without claim waits for the start-up access; meanwhile no frame is heard, reads give 00.
TEST(RsuSpiStartUp, ReadsAreZeroAndWritesWait) {
  RsuBench bench(Straps{}, [] {
    Config config;
    config.spi_write_gap = 0;
    return config;
  }());
  bench.set(5000, Pin::kReset, 1);
  bench.run_until(30 * 250);
  const RsuBench::Frame fast = {400, 400, 400, 400, 0, false};  // the start-up access takes 43 us
  const auto reply = [&](const Bytes& request, std::size_t size) {
    Bytes mosi = request;
    mosi.resize(request.size() + size, 0xFF);
    const Bytes miso = bench.spi(mosi, fast);
    bench.run_cycles(10);
    return part_of(miso, request.size(), size);
  };
  EXPECT_EQ(reply(read_telegram(0x014, 1), 5), with_crc({0x81, 0x00, 0x01}));
  bench.poke(0x700, 0xAA);
  EXPECT_EQ(reply(read_telegram(0x700, 1), 5), with_crc({0x81, 0x00, 0x00}));
  EXPECT_EQ(bench.peek(0x700), 0xAA) << "not cleared yet";
  EXPECT_EQ(reply(write_telegram(0x014, {0x02, 0x77}), 4), with_crc({0xE1, 0x00}));
  EXPECT_EQ(bench.last(R::kSpiBusy).a, 0);
  EXPECT_EQ(reply(inputs_telegram({}), 4), with_crc({0xE1, 0x00}));
  EXPECT_EQ(bench.last(R::kSpiBusy).a, 1);
  reply(write_telegram(0x100, {0x55}), 4);
  EXPECT_EQ(bench.count(R::kSpiWriteWaits), 0);
  EXPECT_EQ(reply(read_telegram(0x000, 1), 5), Bytes(5, 0xFF));
  EXPECT_EQ(bench.count(R::kSpiWriteWaits), 1);
  ASSERT_LT(bench.cycle(), 2000);
  EXPECT_EQ(bench.peek(0x100), 0);
  bench.run_until(2100 * 250);
  EXPECT_EQ(bench.peek(0x100), 0x55);
  EXPECT_EQ(bench.peek(0x015), 0) << "nothing of the refused claim is written";
  EXPECT_EQ(bench.read(0x000, 2), (Bytes{0x01, 0x0D}));
}

// XSS is high at one edge only, the first after the last bit of a write: X is the J of that write. When the chip is in
// an access the write has to wait, and the frame is not heard; else it is.
TEST(RsuSpiStartUp, AFrameThatBeginsAtTheJudgementOfAWriteIsHeardUnlessTheWriteWaits) {
  for (const Cycle begin : {30, 2200}) {
    Config config;
    config.spi_write_gap = 0;
    RsuBench bench(Straps{}, config);
    bench.set(5000, Pin::kReset, 1);
    bench.run_until(begin * 250 + 100);
    Tick rise = bench.now() + 750;  // 100 ticks after an edge, as each of the others
    bench.xss(0);
    const Bytes request = write_telegram(0x100, {0x55});
    for (std::size_t bit = 0; bit < 8 * request.size(); ++bit, rise += 1250) {
      bench.set(rise - 300, Pin::kMosi, static_cast<Level>(request[bit / 8] >> (7 - bit % 8) & 1));
      bench.set(rise, Pin::kSck, 1);
      if (bit + 1 < 8 * request.size()) bench.set(rise + 600, Pin::kSck, 0);
    }
    const Tick last = rise - 1250, first_edge = last + 150;
    bench.set(first_edge - 50, Pin::kXss, 1);
    bench.set(first_edge + 50, Pin::kXss, 0);
    bench.set(first_edge + 60, Pin::kSck, 0);
    bench.run_until(first_edge + 900);
    const Bytes asked = read_telegram(0x000, 1);
    bench.clock(asked);
    const Bytes reply = bench.clock(Bytes(5, 0xFF));
    bench.xss(1);
    const bool waits = begin < 2000;
    EXPECT_EQ(reply, waits ? Bytes(5, 0xFF) : with_crc({0x81, 0x00, 0x01})) << begin;
    EXPECT_EQ(bench.count(R::kSpiWriteWaits), waits ? 1 : 0) << begin;
    if (waits) EXPECT_EQ(bench.last(R::kSpiWriteWaits).at, first_edge + 750) << "J";
    bench.run_cycles(2500);
    EXPECT_EQ(bench.peek(0x100), 0x55) << begin;
    EXPECT_EQ(bench.read(0x100, 1), Bytes{0x55}) << begin;
  }
}

// SP9: a host that keeps 2.7 us is heard at every phase of CLK, and so is a gap of 128 cycles; none below 31750 ticks
// is.
TEST_F(RsuSpi, GapAfterAWrite) {
  bench_.claim();
  for (const Tick gap : {31'740, 31'760, 32'000, 32'390, 32'400}) {
    for (Tick phase = 0; phase < 250; phase += 31) {
      bench_.forget_events();
      bench_.run_until(bench_.now() + 50'000 + phase);
      bench_.spi(write_telegram(0x100, {1}), {600, 600, 600, 600, 0, false});
      const Tick last_rise = bench_.now() - 1200;
      bench_.run_until(last_rise + gap);
      Bytes mosi = read_telegram(0x100, 1);
      mosi.resize(11, 0xFF);
      const Bytes miso = bench_.spi(mosi);
      const bool heard = part_of(miso, 6, 5) == with_crc({0x81, 0x00, 0x01});
      if (gap < 31'750) EXPECT_FALSE(heard) << gap << " " << phase;
      if (gap >= 32'000) EXPECT_TRUE(heard) << gap << " " << phase;
      EXPECT_EQ(bench_.count(R::kSpiWriteGap), gap < 32'400 ? 1 : 0) << gap;
      if (gap < 32'400) {
        EXPECT_EQ(bench_.last(R::kSpiWriteGap).a, gap);
        EXPECT_EQ(bench_.last(R::kSpiWriteGap).b, 32'400);
        EXPECT_EQ(bench_.last(R::kSpiWriteGap).c, heard ? 0 : 1);
      }
    }
  }
}

// SP9: the same gap after a write with a wrong CRC, none after one for the other card.
TEST_F(RsuSpi, GapAfterAWrongWriteAndNoneAfterTheOtherCards) {
  Bytes wrong = write_telegram(0x100, {1});
  wrong.back() ^= 1;
  struct Try {
    Bytes write;
    Tick gap;
    bool heard;
  };
  for (const Try& one :
       {Try{wrong, 31'740, false}, Try{wrong, 32'400, true}, Try{write_telegram(0x100, {1}, 2), 3'000, true}}) {
    bench_.forget_events();
    bench_.run_until(bench_.now() + 50'000);
    bench_.spi(one.write);
    bench_.run_until(bench_.now() - 1200 + one.gap);  // from the last bit's rise
    Bytes mosi = read_telegram(0x000, 1);
    mosi.resize(11, 0xFF);
    EXPECT_EQ(part_of(bench_.spi(mosi), 6, 5), one.heard ? with_crc({0x81, 0x00, 0x01}) : Bytes(5, 0xFF)) << one.gap;
    EXPECT_EQ(bench_.count(R::kSpiWriteGap), one.heard ? 0 : 1) << one.gap;
  }
  EXPECT_EQ(bench_.peek(0x100), 0);
}

// 6.3.3, second remark: the same 2.7 us after a read and write, right or refused.
TEST_F(RsuSpi, GapAfterAReadAndWrite) {
  for (const Tick gap : {31'740, 32'400}) {
    bench_.forget_events();
    bench_.run_until(bench_.now() + 50'000);
    bench_.spi(inputs_telegram({1}));
    bench_.run_until(bench_.now() - 1200 + gap);  // from the last bit's rise
    Bytes mosi = read_telegram(0x000, 1);
    mosi.resize(11, 0xFF);
    EXPECT_EQ(part_of(bench_.spi(mosi), 6, 5), gap < 32'400 ? Bytes(5, 0xFF) : with_crc({0x81, 0x00, 0x01})) << gap;
    EXPECT_EQ(bench_.count(R::kSpiWriteGap), gap < 32'400 ? 1 : 0) << gap;
  }
}

TEST_F(RsuSpi, ReadNeedsNoGap) {
  bench_.ask(read_telegram(0x014, 1), 5);
  bench_.forget_events();
  bench_.spi(read_telegram(0x014, 1));
  bench_.run_until(bench_.now() + 600);
  Bytes mosi = read_telegram(0x014, 1);
  mosi.resize(11, 0xFF);
  EXPECT_EQ(part_of(bench_.spi(mosi), 6, 5), with_crc({0x81, 0x00, 0x00}));
  EXPECT_EQ(bench_.count(R::kSpiWriteGap), 0);
}

TEST_F(RsuSpi, ReadAndWrite) {
  bench_.poke(0x319, 3);
  for (std::uint16_t i = 0; i < 3; ++i)
    bench_.poke(static_cast<std::uint16_t>(0x31A + i), static_cast<std::uint8_t>(0xA0 + i));
  bench_.poke(0x00E, 0x03);
  Bytes reply;
  do reply = bench_.ask(inputs_telegram({1, 2}), 8);
  while (reply[0] == 0xE1);
  EXPECT_EQ(reply, with_crc({0xC1, 0x00, 0x03, 0xA0, 0xA1, 0xA2}));
  EXPECT_EQ(bench_.peek(0x130, 3), (Bytes{2, 1, 2}));
  EXPECT_EQ(bench_.peek(0x00E) & 1, 0) << "B00E.0";
  EXPECT_EQ(bench_.count(dpram::Reason::kBeforeInit), 1)
      << "B010.0 was set: the chip took the block, and had not been initialised";
}

TEST_F(RsuSpi, ReadAndWriteLimitsTheOutputs) {
  bench_.poke(0x319, 250);
  bench_.poke(0x40D, 0x77);
  Bytes reply;
  for (const Bytes& inputs : {Bytes{}, Bytes(244, 9)}) {
    do reply = bench_.ask(inputs_telegram(inputs), 249);
    while (reply[0] == 0xE1);
    EXPECT_EQ(reply, with_crc(part_of(reply, 0, 247)));
    EXPECT_EQ(reply[0], 0xC1);
    EXPECT_EQ(reply[2], 244);
    EXPECT_EQ(reply[246], 0x77);
  }
  EXPECT_EQ(bench_.peek(0x130), 244);
  EXPECT_EQ(bench_.peek(0x131, 244), Bytes(244, 9));
}

// No access begins while the frame lasts.
TEST_F(RsuSpi, ReadAndWriteHoldsUntilXssRises) {
  Bytes mosi = inputs_telegram({1});
  mosi.resize(mosi.size() + 5, 0xFF);
  Bytes miso;
  do {
    bench_.run_cycles(150);
    miso = bench_.spi(mosi, {600, 600, 600, 600, 0, true});
    if (miso[5] == 0xE1) bench_.xss(1);
  } while (miso[5] == 0xE1);
  const std::uint64_t accesses = bench_.status().accesses;
  bench_.run_cycles(500);
  EXPECT_EQ(bench_.status().accesses, accesses);
  const Tick rise = bench_.now() + 17;
  bench_.run_until(rise);
  bench_.xss(1);
  bench_.run_until(rise / 250 * 250 + 250 * 3 - 250);
  EXPECT_EQ(bench_.status().accesses, accesses);
  bench_.run_until((rise / 250 + 3) * 250);  // Y
  EXPECT_EQ(bench_.status().accesses, accesses + 1);
}

TEST_F(RsuSpi, BlockCrcsCountAsRight) {
  bench_.claim();
  bench_.write(0x020, {17, 5, 0x0C, 0xC9, 0x0F, 0, 0, 244, 244, 32, 237, 0, 200, 0, 2, 0x11, 0x21});
  bench_.write(0x020, {16});
  bench_.write(0x010, {0x04});
  bench_.release();
  bench_.run_cycles(300);
  EXPECT_EQ(bench_.peek(0x00A), 0x01);
  EXPECT_EQ(bench_.count(dpram::Reason::kInitialised), 1);
  EXPECT_EQ(bench_.level(Pin::kReady), 1);
}

TEST(RsuSpiParameter, SerialBlockCrc) {
  Config config;
  config.serial_block_crc = 1;
  RsuBench bench({}, config);
  bench.power_on();
  bench.claim();
  bench.write(0x020, {16, 5, 0x0C, 0xC9, 0x0F, 0, 0, 244, 244, 32, 237, 0, 200, 0, 2, 0x11, 0x21});
  bench.write(0x010, {0x04});
  bench.release();
  bench.run_cycles(300);
  EXPECT_EQ(bench.peek(0x00A), 0x00);
  EXPECT_EQ(bench.count(dpram::Reason::kInitCrc), 1);
  const auto hand_over = [&bench](std::uint16_t area, const Bytes& block, std::uint16_t crc, std::uint8_t flag) {
    bench.claim();
    bench.write(area, block);
    bench.write(crc, part_of(with_crc(block), block.size(), 2));
    bench.write(0x010, {flag});
    bench.release();
    bench.run_cycles(300);
  };
  hand_over(0x020, {16, 5, 0x0C, 0xC9, 0x0F, 0, 0, 244, 244, 32, 237, 0, 200, 0, 2, 0x11, 0x21}, 0x0F7, 0x04);
  EXPECT_EQ(bench.peek(0x00A), 0x01);
  hand_over(0x130, {2, 5, 6}, 0x300, 0x01);
  EXPECT_EQ(bench.peek(0x00B), 0x04) << "no CRC at B225";
  hand_over(0x130, {2, 5, 6}, 0x225, 0x01);
  EXPECT_EQ(bench.peek(0x00B), 0x00);
}

// R6: B011.7 is taken back, and B00B.2 is never set, whatever CRC stands at B225.
TEST_F(RsuSpi, InputHistoryHasNothingToKeep) {
  bench_.claim();
  bench_.write(0x011, {0xC0});
  bench_.release();
  bench_.run_cycles(300);
  EXPECT_EQ(bench_.peek(0x011), 0x40);
  EXPECT_EQ(bench_.peek(0x00B), 0x00);
  bench_.claim();
  bench_.write(0x020, {16, 5, 0x0C, 0xC9, 0x0F, 0, 0, 244, 244, 32, 237, 0, 200, 0, 2, 0x11, 0x21});
  bench_.write(0x130, {2, 5, 6});
  bench_.write(0x225, {0x12, 0x34});
  bench_.write(0x010, {0x05});
  bench_.release();
  bench_.run_cycles(300);
  EXPECT_EQ(bench_.peek(0x00A, 2), (Bytes{0x01, 0x00}));
  EXPECT_EQ(bench_.peek(0x010), 0x00);
}

// SP13: only a host far beyond SP2 and SP9 gets there, and only with a gap of 0.
TEST(RsuSpiParameter, AWriteIsRefusedWhileAnEarlierOneIsUnderWay) {
  for (const Bytes& second : {write_telegram(0x300, {9}), inputs_telegram({9})}) {
    Config config;
    config.spi_write_gap = 0;
    RsuBench bench({}, config);
    bench.power_on();
    bench.claim();
    const RsuBench::Frame fast = {100, 100, 100, 100, 0, false};
    bench.spi(write_telegram(0x400, Bytes(245, 7)), fast);
    bench.run_until(bench.now() + 1000);
    bench.spi(second, {100, 100, 100, 100, 0, true});
    bench.run_cycles(4);  // the reply is at a host's speed
    EXPECT_EQ(bench.clock(Bytes(4, 0xFF)), error(0x00));
    bench.xss(1);
    EXPECT_EQ(bench.last(R::kSpiBusy).a, 2);
    bench.run_cycles(300);
    EXPECT_EQ(bench.peek(0x400, 245), Bytes(245, 7));
    EXPECT_EQ(bench.peek(0x300), 0);
    EXPECT_EQ(bench.peek(0x130, 2), (Bytes{0, 0}));
  }
}

TEST(RsuSpiParameter, ReplyGap) {
  for (const std::uint32_t gap : {1U, 2U, 16U}) {
    Config config;
    config.spi_reply_gap = gap;
    RsuBench bench({}, config);
    bench.power_on();
    const Bytes miso = bench.ask(read_telegram(0x000, 4), gap + 8 + 2);
    EXPECT_EQ(part_of(miso, 0, gap), Bytes(gap, 0xFF));
    EXPECT_EQ(part_of(miso, gap, 8), with_crc({0x81, 0x00, 0x01, 0x0D, 0x07, 0x01}));
    EXPECT_EQ(part_of(miso, gap + 8, 2), Bytes(2, 0xFF));
  }
}

// "Not open for the time being": without the parameter B015 opens nothing.
TEST(RsuSpiUTimer, IsNotOpenByDefault) {
  RsuBench bench;
  bench.power_on();
  bench.claim();
  bench.write(0x015, {0x01});
  bench.read(0x100, 1);  // would start it
  bench.run_cycles(100'000);
  EXPECT_EQ(bench.peek(0x014) & 2, 2);
  EXPECT_EQ(bench.count(R::kSpiUTimer), 0);
}

// SP17: from the last judgement with a right CRC; ends, and the telegram of that cycle is without claim.
TEST(RsuSpiUTimer, TakesTheOwnership) {
  Config config;
  config.u_timer = 24'000;
  RsuBench bench({}, config);
  bench.power_on();
  bench.claim();
  bench.run_cycles(30'000);
  EXPECT_EQ(bench.peek(0x014) & 2, 2) << "B015.0 is 0";
  bench.write(0x015, {0x01});
  bench.run_cycles(30'000);
  EXPECT_EQ(bench.peek(0x014) & 2, 2) << "its own telegram came before it";
  bench.spi(read_telegram(0x100, 1));
  const Cycle judged = (bench.now() - 1200) / 250 + 4;
  bench.run_until((judged + 24'000) * 250 - 1);
  EXPECT_EQ(bench.peek(0x014) & 2, 2);
  bench.run_until((judged + 24'000) * 250);
  EXPECT_EQ(bench.peek(0x014) & 2, 0);
  EXPECT_EQ(bench.last(R::kSpiUTimer).a, 24'000);
  EXPECT_EQ(bench.last(R::kSpiUTimer).at, (judged + 24'000) * 250);
  EXPECT_EQ(bench.count(R::kSpiReleased), 0);
}

// The claim alone starts it, each telegram with a right CRC starts it again.
TEST(RsuSpiUTimer, BeginsWithTheClaimAndAgainWithATelegram) {
  for (const bool again : {false, true}) {
    Config config;
    config.u_timer = 24'000;
    RsuBench bench({}, config);
    bench.power_on();
    bench.claim();
    bench.write(0x015, {0x01});
    bench.release();
    bench.claim();
    Tick begun = bench.last(R::kSpiClaimed).at;
    if (again) {
      bench.run_until(begun + 18'000 * 250);
      bench.spi(read_telegram(0x100, 1));
      begun = ((bench.now() - 1200) / 250 + 4) * 250;
    }
    bench.run_until(begun + 24'000 * 250 - 1);
    EXPECT_EQ(bench.peek(0x014) & 2, 2);
    bench.run_until(begun + 24'000 * 250);
    EXPECT_EQ(bench.peek(0x014) & 2, 0);
    EXPECT_EQ(bench.last(R::kSpiUTimer).at, bench.now());
  }
}

TEST(RsuSpiUTimer, WrongCrcDoesNotStartItAgain) {
  Config config;
  config.u_timer = 4000;
  RsuBench bench({}, config);
  bench.power_on();
  bench.claim();
  bench.write(0x015, {0x01});
  bench.read(0x100, 1);
  bench.run_cycles(1000);
  Bytes wrong = read_telegram(0x100, 1);
  wrong.back() ^= 0x10;
  bench.ask(wrong, 4);
  bench.spi(read_telegram(0x100, 1, 2));  // nor does one for the other card
  bench.run_cycles(2900);
  EXPECT_EQ(bench.count(R::kSpiUTimer), 1);
  bench.claim();
  bench.release();
  bench.run_cycles(5000);
  EXPECT_EQ(bench.count(R::kSpiUTimer), 1) << "a release stops it";
}

}  // namespace
}  // namespace dsdpv1::conformance
