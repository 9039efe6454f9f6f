// UART: characters, telegrams, replies (UA1 to UA6, UA16; docs/microarchitecture_rsu.md 6.1 to 6.3, 6.5).
#include <algorithm>

#include "tests/conformance/rsu_bench.hpp"

namespace dsdpv1::conformance {
namespace {

using R = dsdpv1::Reason;

Straps uart(Level rate = 7) {
  Straps straps;
  straps.mode = HostMode::kUart;
  straps.rate = rate;
  return straps;
}

class RsuUart : public ::testing::Test {
 protected:
  void SetUp() override {
    bench_.power_on();
    bench_.run_until(4300 * 250);  // B004 is C5
    bench_.forget_events();
  }
  void silence(int bits = 100) { bench_.run_cycles(Cycle{bits} * bench_.bit()); }
  bool answers() { return bench_.talk(read_telegram(0x000, 2)) == with_crc({0x81, 0x00, 0x01, 0x0D}); }
  RsuBench bench_{uart()};
};

TEST_F(RsuUart, ReadAndWrite) {
  EXPECT_TRUE(answers());
  EXPECT_EQ(bench_.talk(write_telegram(0x200, {1, 2, 3})), with_crc({0xA1, 0x00}));
  EXPECT_EQ(bench_.peek(0x200, 3), (Bytes{1, 2, 3}));
  EXPECT_EQ(bench_.talk(read_telegram(0x1FF, 4)), with_crc({0x81, 0x00, 0, 1, 2, 3}));
  EXPECT_TRUE(bench_.events().empty());
}

TEST_F(RsuUart, LongestReadAndWrite) {
  Bytes data(250);
  for (std::size_t i = 0; i < data.size(); ++i) data[i] = static_cast<std::uint8_t>(i + 3);
  EXPECT_EQ(bench_.talk(write_telegram(0x300, data)), with_crc({0xA1, 0x00}));
  EXPECT_EQ(bench_.peek(0x300, 250), data);
  Bytes reply = {0x81, 0x00};
  const Bytes first = part_of(data, 0, 245);
  reply.insert(reply.end(), first.begin(), first.end());
  EXPECT_EQ(bench_.talk(read_telegram(0x300, 245)), with_crc(reply));
}

// UA6: one byte a cycle, ascending; no access of the chip begins before the last, the overdue one follows.
TEST_F(RsuUart, AWriteIsCarriedOutUninterrupted) {
  const Bytes data(250, 7);
  bench_.send(write_telegram(0x300, data));  // its first bytes are written within the last stop bit
  const std::uint64_t accesses = bench_.status().accesses;
  const auto written = [this] {
    const Bytes cells = bench_.peek(0x300, 250);
    return std::find_if(cells.begin(), cells.end(), [](std::uint8_t cell) { return cell != 7; }) - cells.begin();
  };
  const std::ptrdiff_t begun = written();
  EXPECT_LT(begun, 50);
  for (std::ptrdiff_t done = begun; done < 250; ++done) {
    ASSERT_EQ(written(), done);
    ASSERT_EQ(bench_.status().accesses, accesses) << done;
    bench_.run_cycles(1);
  }
  EXPECT_EQ(bench_.peek(0x300, 250), data);
  bench_.run_cycles(3);
  EXPECT_EQ(bench_.status().accesses, accesses + 1);
}

// UA1: at each of the eight rates, and the reply's earliest time (UA4): tsdr bit times after the request's end, plus
// more than 0 and at most 1 cycle.
TEST(RsuUartRates, AllEight) {
  for (Level rate = 0; rate < 8; ++rate) {
    RsuBench bench(uart(rate));
    bench.power_on();
    const Tick phase = 37 * rate;
    bench.run_until(3000 * 250 + phase);
    bench.forget_events();
    EXPECT_EQ(bench.talk(read_telegram(0x000, 1)), with_crc({0x81, 0x00, 0x01})) << rate;
    const Tick end = 3000 * 250 + phase + Tick{6} * 11 * bench.bit() * 250;
    const Tick falls = bench.changes(Pin::kTxd).front().at;
    EXPECT_GT(falls - end, Tick{11} * bench.bit() * 250);
    EXPECT_LE(falls - end, (Tick{11} * bench.bit() + 1) * 250);
  }
}

TEST_F(RsuUart, TsdrByRegisterAndParameter) {
  bench_.talk(write_telegram(0x01A, {40}));
  bench_.forget_events();
  const Tick begin = bench_.now();
  EXPECT_TRUE(answers());
  const Tick end = begin + Tick{6} * 11 * 26 * 250;
  EXPECT_EQ((bench_.changes(Pin::kTxd).front().at - end - 1) / 250, 40 * 26);
  bench_.talk(write_telegram(0x01A, {3}));
  bench_.forget_events();
  const Tick again = bench_.now();
  EXPECT_TRUE(answers());
  EXPECT_EQ((bench_.changes(Pin::kTxd).front().at - again - Tick{6} * 11 * 26 * 250 - 1) / 250, 11 * 26) << "at least";
}

TEST_F(RsuUart, ParityDropsTheTelegram) {
  Bytes telegram = write_telegram(0x200, {1});
  for (std::size_t i = 0; i < telegram.size(); ++i) bench_.send(telegram[i], {i == 4, false});
  silence();
  EXPECT_EQ(bench_.last(R::kUartParity).a, 4);
  EXPECT_EQ(bench_.last(R::kUartParity).b, 1);
  EXPECT_TRUE(bench_.changes(Pin::kTxd).empty());
  EXPECT_EQ(bench_.peek(0x200), 0);
  EXPECT_TRUE(answers());
}

TEST_F(RsuUart, NothingIsHeardUntilSilence) {
  bench_.send(0x55, {true, false});
  bench_.send(read_telegram(0x000, 1));
  silence();
  EXPECT_TRUE(bench_.changes(Pin::kTxd).empty());
  EXPECT_EQ(bench_.count(R::kUartParity), 1);
  EXPECT_EQ(bench_.last(R::kUartParity).a, 0);
  EXPECT_TRUE(answers());
}

TEST_F(RsuUart, StopBitDropsTheTelegram) {
  bench_.send(0x01, {});
  bench_.send(0x00, {true, true});
  bench_.set(bench_.now(), Pin::kRxd, 1);
  silence();
  EXPECT_EQ(bench_.last(R::kUartFraming).a, 1);
  EXPECT_EQ(bench_.count(R::kUartParity), 0) << "wrong both: framing";
  EXPECT_TRUE(answers());
}

TEST_F(RsuUart, BreakIsOneCharacterWithoutStopBit) {
  bench_.set(bench_.now(), Pin::kRxd, 0);
  silence(1000);
  bench_.set(bench_.now(), Pin::kRxd, 1);
  EXPECT_EQ(bench_.count(R::kUartFraming), 1);
  bench_.send(read_telegram(0x000, 1));  // no silence yet
  silence();
  EXPECT_TRUE(bench_.changes(Pin::kTxd).empty());
  EXPECT_TRUE(answers());
}

// G = 7 half characters of 11 bits at 26 cycles: 1001 cycles. A start edge at idle_since + G + 1 is in time.
TEST_F(RsuUart, LongestSilenceWithinATelegram) {
  const Bytes telegram = read_telegram(0x000, 1);
  for (const Cycle gap : {1001, 1002, 1003}) {
    bench_.forget_events();
    bench_.send(part_of(telegram, 0, 3));
    bench_.run_cycles(gap);
    bench_.send(part_of(telegram, 3, 3));
    silence();
    const bool heard = !bench_.changes(Pin::kTxd).empty();
    EXPECT_EQ(heard, gap <= 1002) << gap;  // the end as calculated is the end as the line has it here
    EXPECT_EQ(bench_.count(R::kTelegramCut), heard ? 0 : 2) << "the second half is no telegram either";
    if (!heard) {
      EXPECT_EQ(bench_.events()[0].reason, R::kTelegramCut);
      EXPECT_EQ(bench_.events()[0].a, 3);
      EXPECT_EQ(bench_.events()[0].b, 6);
    }
    silence(500);
  }
}

TEST_F(RsuUart, IntervalByRegister) {
  const Bytes telegram = read_telegram(0x000, 1);
  const auto heard_with = [&](Cycle gap, int code_within = 0) {
    bench_.forget_events();
    bench_.send(part_of(telegram, 0, 2));
    if (code_within != 0) bench_.poke(0x019, static_cast<std::uint8_t>(code_within));
    bench_.send(part_of(telegram, 2, 1));
    bench_.run_cycles(gap);
    bench_.send(part_of(telegram, 3, 3));
    silence(3000);
    return !bench_.changes(Pin::kTxd).empty();
  };
  bench_.talk(write_telegram(0x019, {0x01}));
  EXPECT_TRUE(heard_with(286));
  EXPECT_FALSE(heard_with(290));
  EXPECT_FALSE(heard_with(290, 0x07)) << "taken at the first character";
  bench_.talk(write_telegram(0x019, {0x07}));
  EXPECT_TRUE(heard_with(28'600));
  bench_.run_cycles(30'000);
  bench_.talk(write_telegram(0x019, {0x08}));
  EXPECT_FALSE(heard_with(1003)) << "above 07: UIV";
}

// UA3 at 1.8432 Mbit/s: each code, by the strap and by B019. 3.5, 1, 2, 5, 10, 20, 50 and 100 characters of 286 cycles;
// a start edge one cycle beyond them is in time.
TEST(RsuUartInterval, OfEachCodeByStrapAndByRegister) {
  const Cycle intervals[] = {1001, 286, 572, 1430, 2860, 5720, 14'300, 28'600};
  const Bytes telegram = read_telegram(0x000, 1);
  for (Level code = 0; code < 8; ++code) {
    for (const bool by_register : {false, true}) {
      if (by_register && code == 0) continue;  // 00 is no code: the strap
      SCOPED_TRACE(std::to_string(code) + (by_register ? " B019" : " UIV"));
      Straps straps = uart();
      straps.interval = by_register ? (code == 7 ? 1 : 7) : code;
      RsuBench bench(straps);
      bench.power_on();
      if (by_register) bench.poke(0x019, static_cast<std::uint8_t>(code));
      for (const Cycle late : {1, 2}) {
        bench.forget_events();
        bench.send(part_of(telegram, 0, 3));
        bench.run_cycles(intervals[code] + late);
        bench.send(part_of(telegram, 3, 3));
        bench.run_cycles(30'000);
        EXPECT_EQ(!bench.changes(Pin::kTxd).empty(), late == 1);
        EXPECT_EQ(bench.count(R::kTelegramCut) > 0, late == 2);
      }
    }
  }
}

// 7.1.6, note 4.
TEST_F(RsuUart, EachReservedBitOfTheAddressIsAnError) {
  for (unsigned bit = 11; bit < 16; ++bit) {
    const auto address = static_cast<std::uint16_t>(0x130U | 1U << bit);
    EXPECT_EQ(bench_.talk(read_telegram(address, 1)), with_crc({0xE1, 0x02})) << bit;
    EXPECT_EQ(bench_.talk(exchange_telegram(0, address, {0})), with_crc({0x01, 0x80, 0x02})) << bit;
  }
  EXPECT_EQ(bench_.talk(read_telegram(0x7FF, 1)), with_crc({0x81, 0x00, 0x00}));
}

// 7.1.6, note 2: bit 1 alone has a meaning.
TEST_F(RsuUart, ReservedBitsOfTheFunctionAreNotLookedAt) {
  for (const std::uint8_t function : Bytes{0x01, 0x04, 0x08, 0x10, 0x20, 0x40, 0x80, 0xFF}) {
    EXPECT_EQ(bench_.talk(exchange_telegram(function, 0x130, {0})).at(1), 0x00) << int{function};
    EXPECT_EQ(bench_.talk(exchange_telegram(function, 0x227, {0, 0})).at(1), (function & 0x02) != 0 ? 0x00 : 0x80)
        << int{function};
  }
}

TEST_F(RsuUart, GlitchWithinSilence) {
  const Bytes telegram = read_telegram(0x000, 1);
  bench_.send(part_of(telegram, 0, 3));
  bench_.run_cycles(999);
  bench_.set(bench_.now(), Pin::kRxd, 0);
  bench_.run_cycles(5);
  bench_.set(bench_.now(), Pin::kRxd, 1);
  bench_.run_cycles(5);
  EXPECT_EQ(bench_.count(R::kTelegramCut), 0);
  bench_.run_cycles(10);
  EXPECT_EQ(bench_.count(R::kTelegramCut), 1) << "at its mid-bit";
  EXPECT_TRUE(answers());
}

TEST_F(RsuUart, OtherCardsAreFollowedToTheirEnd) {
  bench_.send(write_telegram(0x200, {1, 2, 3}, 2));
  bench_.send(write_telegram(0x200, {4}, 3));
  silence();
  EXPECT_TRUE(bench_.changes(Pin::kTxd).empty());
  EXPECT_EQ(bench_.peek(0x200), 0);
  EXPECT_TRUE(bench_.events().empty());
  EXPECT_TRUE(answers());
}

TEST_F(RsuUart, StartBytesThatAreNone) {
  for (const std::uint8_t start : Bytes{0x61, 0x81, 0x05}) {
    bench_.send({start, 0x00, 0x00});
    silence();
    EXPECT_EQ(bench_.last(R::kTelegramStart).a, start);
  }
  EXPECT_TRUE(answers());
}

TEST_F(RsuUart, ErrorCodes) {
  Bytes wrong = read_telegram(0x000, 1);
  wrong.back() ^= 0x80;
  EXPECT_EQ(bench_.talk(wrong), with_crc({0xE1, 0x01}));
  EXPECT_EQ(bench_.talk(read_telegram(0x1000, 1)), with_crc({0xE1, 0x02}));
  EXPECT_EQ(bench_.talk(read_telegram(0x0000, 0)), with_crc({0xE1, 0x04}));
  EXPECT_EQ(bench_.talk(read_telegram(0x0000, 246)), with_crc({0xE1, 0x04}));
  EXPECT_EQ(bench_.talk(write_telegram(0x100, {})), with_crc({0xE1, 0x04}));
  EXPECT_EQ(bench_.talk(write_telegram(0x100, Bytes(251, 1))), with_crc({0xE1, 0x0C}));
  EXPECT_EQ(bench_.last(R::kTelegramData).b, 250);
  EXPECT_EQ(bench_.last(R::kTelegramLength).a, 257);
  EXPECT_EQ(bench_.last(R::kTelegramLength).b, 256);
  EXPECT_EQ(bench_.talk(write_telegram(0x7FF, {1, 2})), with_crc({0xE1, 0x04}));
  EXPECT_EQ(bench_.peek(0x100), 0);
}

TEST_F(RsuUart, HalfDuplex) {
  bench_.send(read_telegram(0x000, 1));
  bench_.run_cycles(100);
  const Tick fall = bench_.now();
  bench_.send(read_telegram(0x000, 1));  // during the reply
  silence(300);
  EXPECT_EQ(bench_.count(R::kUartHalfDuplex), 1);
  EXPECT_EQ(bench_.last(R::kUartHalfDuplex).at, (fall / 250 + 3) * 250);
  EXPECT_GT(bench_.last(R::kUartHalfDuplex).a, 100);
  EXPECT_EQ(bench_.sent_since(0), with_crc({0x81, 0x00, 0x01}));
  EXPECT_TRUE(answers());
}

// E + 1 is the first start edge of a next request that is heard.
TEST_F(RsuUart, NextRequestRightAfterTheReply) {
  const Bytes request = read_telegram(0x000, 1);
  bench_.send(request);
  bench_.run_cycles(400);
  const Tick falls = bench_.changes(Pin::kTxd).front().at;
  const Tick end = falls + Tick{5} * 11 * 26 * 250;  // E
  for (const int late : {0, 1}) {
    RsuBench bench(uart());
    bench.power_on();
    bench.run_until(4300 * 250);
    bench.forget_events();
    bench.send(request);
    bench.run_until(end + late * 250 - 2 * 250 - 100);  // seen at E + late
    bench.send(request);
    bench.run_cycles(5000);
    EXPECT_EQ(bench.count(R::kUartHalfDuplex), late == 0 ? 1 : 0);
    EXPECT_EQ(bench.sent_since(end - 250).size(), late == 0 ? 0U : 5U);
  }
}

TEST_F(RsuUart, TxdIsOneInReset) {
  bench_.send(read_telegram(0x000, 1));
  bench_.run_cycles(11 * 26 + 10);
  EXPECT_EQ(bench_.level(Pin::kTxd), 0);
  const Tick at = bench_.now();
  bench_.reset_for(20);
  EXPECT_EQ(bench_.changes(Pin::kTxd).back().at, at);
  EXPECT_EQ(bench_.level(Pin::kTxd), 1);
  bench_.run_cycles(2200);
  EXPECT_TRUE(answers());
}

// --- exchanges without a bus (UA7 to UA14) ---------------------------------------------------------------------------

TEST_F(RsuUart, ExchangeOfInputsBeforeTheInitialisation) {
  EXPECT_EQ(bench_.talk(exchange_telegram(0, 0x130, {1, 0x55})), with_crc({0x01, 0x00, 0x03, 0x19, 0x01, 0x00}));
  EXPECT_EQ(bench_.peek(0x130, 2), (Bytes{1, 0x55}));
  EXPECT_EQ(bench_.count(dpram::Reason::kBeforeInit), 1);
}

TEST_F(RsuUart, ExchangeOfEachArea) {
  const struct {
    std::uint16_t address;
    std::uint8_t function;
    std::uint16_t flag;
    std::uint8_t bit;
  } areas[] = {{0x130, 0, 0x010, 0x01}, {0x227, 2, 0x010, 0x02}, {0x5D0, 0, 0x011, 0x01}, {0x6D0, 0, 0x011, 0x02}};
  for (const auto& area : areas) {
    bench_.forget_events();
    EXPECT_EQ(bench_.talk(exchange_telegram(area.function, area.address, {1, 0, 3, 4})),
              with_crc({0x01, 0x00, 0x03, 0x19, 0x01, 0x00}));
    EXPECT_EQ(bench_.peek(area.address, 4), (Bytes{1, 0, 3, 4}));
    ASSERT_EQ(bench_.count(dpram::Reason::kBeforeInit), 1);
    EXPECT_EQ(bench_.last(dpram::Reason::kBeforeInit).a, area.bit);
    EXPECT_EQ(bench_.last(dpram::Reason::kBeforeInit).b, area.flag);
  }
}

TEST_F(RsuUart, ExchangeErrors) {
  EXPECT_EQ(bench_.talk(exchange_telegram(0, 0x319, {1})), with_crc({0x01, 0x80, 0x02}));
  EXPECT_EQ(bench_.last(R::kTelegramAddress).b, 1);
  EXPECT_EQ(bench_.talk(exchange_telegram(0, 0x227, {1})), with_crc({0x01, 0x80, 0x02}));
  EXPECT_EQ(bench_.last(R::kTelegramAddress).b, 2);
  EXPECT_EQ(bench_.talk(exchange_telegram(0, 0x8130, {1})), with_crc({0x01, 0x80, 0x02}));
  const std::pair<std::uint16_t, std::size_t> most[] = {{0x130, 245}, {0x227, 240}, {0x5D0, 244}, {0x6D0, 244}};
  for (const auto& [address, size] : most) {
    EXPECT_EQ(bench_.talk(exchange_telegram(2, address, Bytes(size + 1, 0))), with_crc({0x01, 0x80, 0x04})) << address;
    EXPECT_EQ(bench_.last(R::kTelegramData).b, size);
    EXPECT_EQ(bench_.talk(exchange_telegram(2, address, Bytes(size, 0)))[1], 0x00) << address;
  }
  EXPECT_EQ(bench_.talk(exchange_telegram(0, 0x130, {})), with_crc({0x01, 0x80, 0x04}));
  EXPECT_EQ(bench_.talk(exchange_telegram(0, 0x000, Bytes(251, 0))), with_crc({0x01, 0x80, 0x0E}));
  Bytes wrong = exchange_telegram(0, 0x130, {0});
  wrong.back() ^= 1;
  EXPECT_EQ(bench_.talk(wrong), with_crc({0x01, 0x80, 0x01}));
}

// 7.1.5, the first field; UA7, UA8.
TEST(RsuUartTarget, IsTheCardAndItsReplyBearsItsAddress) {
  for (const Level own : {Level{1}, Level{2}}) {
    Straps straps = uart();
    straps.address = own;
    RsuBench bench(straps);
    bench.power_on();
    for (std::uint8_t card = 0; card < 4; ++card) {
      const Bytes reply = bench.talk(exchange_telegram(0, 0x130, {0}, card));
      EXPECT_EQ(reply, card == own ? with_crc({card, 0x00, 0x03, 0x19, 0x01, 0x00}) : Bytes{}) << own << " " << card;
    }
  }
}

// UA10 to UA12: one area a reply, in this order; its flag is cleared. The chip clears none of them before a user took
// it.
TEST_F(RsuUart, NewsInTheirOrder) {
  bench_.poke(0x410, 2), bench_.poke(0x411, 0x11), bench_.poke(0x412, 0x12);
  bench_.poke(0x500, 9), bench_.poke(0x501, 8), bench_.poke(0x502, 1), bench_.poke(0x503, 0x23);
  bench_.poke(0x5D0, 0x5E), bench_.poke(0x5D1, 1), bench_.poke(0x5D2, 2), bench_.poke(0x5D3, 240);
  bench_.poke(0x6D0, 0x51), bench_.poke(0x6D1, 1), bench_.poke(0x6D2, 2), bench_.poke(0x6D3, 1), bench_.poke(0x6D4, 7);
  bench_.poke(0x319, 1), bench_.poke(0x31A, 0xAA);
  bench_.poke(0x00E, 0x07), bench_.poke(0x00F, 0x03);
  const auto inputs = [&] { return bench_.talk(exchange_telegram(0, 0x130, {0})); };
  EXPECT_EQ(bench_.talk(exchange_telegram(0, 0x5D0, {0x5F, 0, 0, 0})),
            with_crc({0x01, 0x00, 0x03, 0x19, 0x02, 0x01, 0xAA}))
      << "no news to another exchange";
  EXPECT_EQ(bench_.peek(0x00E), 0x07);
  bench_.poke(0x5D0, 0x5E), bench_.poke(0x5D1, 1), bench_.poke(0x5D2, 2), bench_.poke(0x5D3, 240);
  EXPECT_EQ(inputs(), with_crc({0x01, 0x10, 0x04, 0x10, 0x03, 0x02, 0x11, 0x12}));
  EXPECT_EQ(bench_.peek(0x00E), 0x05);
  EXPECT_EQ(inputs(), with_crc({0x01, 0x20, 0x05, 0x00, 0x04, 0x09, 0x08, 0x01, 0x23}));
  EXPECT_EQ(bench_.peek(0x00E), 0x01);
  EXPECT_EQ(inputs(), with_crc({0x01, 0x04, 0x05, 0xD0, 0x04, 0x5E, 0x01, 0x02, 0xF0})) << "a read carries no data";
  EXPECT_EQ(bench_.peek(0x00F), 0x02);
  EXPECT_EQ(inputs(), with_crc({0x01, 0x08, 0x06, 0xD0, 0x05, 0x51, 0x01, 0x02, 0x01, 0x07}));
  EXPECT_EQ(bench_.peek(0x00F), 0x00);
  EXPECT_EQ(inputs(), with_crc({0x01, 0x00, 0x03, 0x19, 0x02, 0x01, 0xAA}));
  EXPECT_EQ(bench_.peek(0x00E), 0x00);
  EXPECT_EQ(inputs(), with_crc({0x01, 0x00, 0x03, 0x19, 0x02, 0x01, 0xAA})) << "whether new or not";
}

// P6: a telegram over B00A to B00F, one event for each byte that sets bits. The chip's own clearing in an exchange is
// none.
TEST_F(RsuUart, BitsThatOnlyTheChipSetsAreReported) {
  bench_.talk(write_telegram(0x00A, {0x01, 0x02, 0x00, 0x00, 0x07, 0x03}));
  EXPECT_EQ(bench_.count(R::kBitSet), 4);
  EXPECT_EQ(bench_.last(R::kBitSet).a, 0x00F);
  EXPECT_EQ(bench_.last(R::kBitSet).c, 0x03);
  bench_.talk(exchange_telegram(0, 0x130, {0}));
  bench_.talk(write_telegram(0x00E, {0x00, 0x00}));
  EXPECT_EQ(bench_.count(R::kBitSet), 4);
}

// UA12, as the vendor's main loop is reported to compute it: the length byte plus five.
TEST_F(RsuUart, CrcOfEveryReplyCoversItsLengthPlusFive) {
  bench_.poke(0x410, 2), bench_.poke(0x411, 0x11), bench_.poke(0x412, 0x12);
  bench_.poke(0x500, 9), bench_.poke(0x501, 8), bench_.poke(0x502, 2), bench_.poke(0x503, 0x13),
      bench_.poke(0x504, 0x23);
  bench_.poke(0x5D0, 0x5F), bench_.poke(0x5D3, 3);
  bench_.poke(0x6D0, 0x51), bench_.poke(0x6D3, 1);
  bench_.poke(0x319, 1), bench_.poke(0x31A, 0xAA);
  bench_.poke(0x00E, 0x07), bench_.poke(0x00F, 0x03);
  for (const int area : {0x410, 0x500, 0x5D0, 0x6D0, 0x319}) {
    const Bytes reply = bench_.talk(exchange_telegram(0, 0x130, {0}));
    ASSERT_GT(reply.size(), 5U);
    EXPECT_EQ(reply[2] << 8 | reply[3], area);
    EXPECT_EQ(reply.size(), reply[4] + 7U);
    EXPECT_EQ(with_crc(part_of(reply, 0, reply[4] + 5U)), reply);
  }
}

TEST_F(RsuUart, LengthsAreLimited) {
  const auto size_with = [&](std::uint16_t length_cell, std::uint8_t length, std::uint16_t flag_cell,
                             std::uint8_t flag) {
    bench_.poke(length_cell, length);
    bench_.poke(0x00E, 0);
    bench_.poke(0x00F, 0);
    bench_.poke(flag_cell, flag);
    const Bytes reply = bench_.talk(exchange_telegram(0, 0x130, {0}));
    EXPECT_EQ(reply, with_crc(part_of(reply, 0, reply.size() - 2)));
    EXPECT_EQ(reply.at(4) + 7U, reply.size());
    return int{reply.at(4)};
  };
  bench_.poke(0x5D0, 0x5F), bench_.poke(0x6D0, 0x51);
  EXPECT_EQ(size_with(0x410, 255, 0x00E, 0x02), 238);
  EXPECT_EQ(size_with(0x502, 255, 0x00E, 0x04), 203);
  EXPECT_EQ(size_with(0x5D3, 255, 0x00F, 0x01), 244);
  EXPECT_EQ(size_with(0x6D3, 255, 0x00F, 0x02), 244);
  EXPECT_EQ(size_with(0x319, 255, 0x00E, 0x01), 245);
}

TEST(RsuUartParameter, CfgLength) {
  Config config;
  config.uart_cfg_length = 1;
  RsuBench bench(uart(), config);
  bench.power_on();
  const Bytes cfg = {0x00, 0x07, 0x06, 0x1F, 0x2F, 0x1F, 0x2F, 0x1F, 0x2F};
  for (std::size_t i = 0; i < cfg.size(); ++i) bench.poke(static_cast<std::uint16_t>(0x500 + i), cfg[i]);
  bench.poke(0x00E, 0x04);
  const Bytes reply = bench.talk(exchange_telegram(0, 0x130, {0}));
  EXPECT_EQ(part_of(reply, 0, 5), (Bytes{0x01, 0x20, 0x05, 0x00, 0x07}));
  EXPECT_EQ(reply.size(), 16U) << "nine data bytes";
  EXPECT_EQ(reply.size(), reply[4] + 9U) << "the length plus five ends two bytes before the CRC (UA12)";
  EXPECT_NE(part_of(reply, 0, reply[4] + 7U), with_crc(part_of(reply, 0, reply[4] + 5U)));
}

TEST(RsuUartParameter, MinTsdr) {
  Config config;
  config.uart_min_tsdr = 60;
  RsuBench bench(uart(), config);
  bench.power_on();
  const Tick end = bench.now() + Tick{6} * 11 * 26 * 250;
  bench.talk(read_telegram(0x000, 1));
  EXPECT_EQ((bench.changes(Pin::kTxd).front().at - end - 1) / 250, 60 * 26);
}

TEST(RsuUartParameter, Gaps) {
  Config config;
  config.uart_gaps[5] = 100;
  Straps straps = uart();
  straps.interval = 5;
  RsuBench bench(straps, config);
  bench.power_on();
  const Bytes telegram = read_telegram(0x000, 1);
  bench.send(part_of(telegram, 0, 3));
  bench.run_cycles(14'000);
  bench.send(part_of(telegram, 3, 3));
  bench.run_cycles(3000);
  EXPECT_EQ(bench.sent_since(0).size(), 5U);
}

}  // namespace
}  // namespace dsdpv1::conformance
