// A DSDPV1-RSU on the bus: what its host hears by SPI and UART of what a master does, and the other way round.
#include <algorithm>

#include "tests/conformance/rsu_bench.hpp"
#include "tests/conformance/slave_bench.hpp"

namespace dsdpv1::conformance {
namespace {

Config rsu() {
  Config config;
  config.part = Part::kRsu;
  return config;
}

constexpr std::uint8_t kUserJudges = 2;

Prm with_dpv1() {
  Prm prm;
  prm.user = {0x80, 0, 0};
  return prm;
}

/// A block of the chip's and where its CRC is.
struct Block {
  std::uint16_t cell;
  Bytes bytes;
  std::uint16_t crc;
};
/// Of each kind one, as the master of these tests sends them.
const Block kNews[] = {{0x319, {1, 0xAA}, 0x40E},
                       {0x410, {3, 0x80, 0, 0}, 0x4FE},
                       {0x500, {1, 1, 2, 0x10, 0x20}, 0x5CB},
                       {0x5D0, {0x5E, 1, 2, 3}, 0x6C4},
                       {0x6D0, {0x5E, 4, 5, 6}, 0x7C4}};

std::ptrdiff_t falls_of_intr0(const SlaveBench& bench) {
  const std::vector<PinChange> changes = bench.changes(Pin::kIntr0);
  return std::count_if(changes.begin(), changes.end(), [](const PinChange& change) { return change.level == 0; });
}

Bytes crc_of(const Bytes& bytes) { return part_of(with_crc(bytes), bytes.size(), 2); }

/// R12: in data exchange, which needed parameters and a configuration since `falls` of INTR0 were counted.
void expect_pins_of_data_exchange(const SlaveBench& bench, std::ptrdiff_t falls) {
  EXPECT_EQ(bench.chip.level(Pin::kReady), 1);
  EXPECT_EQ(bench.chip.level(Pin::kBr), 1);
  EXPECT_EQ(bench.chip.level(Pin::kPbf), 0);
  EXPECT_EQ(falls_of_intr0(bench), falls + 2);
}

/// Initiate, and the poll that connects the first channel.
void connect_c2(SlaveBench& bench) {
  const Bytes initiate = {0x57, 0, 0, 0, 0, 100, 1, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0x0A, 0x0B, 0x0C, 0x0D};
  ASSERT_TRUE(bench.srd(0x31, 0x32, initiate).answered());
  ASSERT_TRUE(bench.srd(0x30, 0x32, {}).answered());
}

/// A slave with one input and one output byte, whose host is at the UART.
class RsuUartOnBus : public ::testing::Test {
 protected:
  RsuUartOnBus() {
    bench_.chip.set(0, Pin::kMode, 2);
    bench_.chip.set(0, Pin::kAdr, 1);
    bench_.chip.set(0, Pin::kUbr, 7);
  }
  void SetUp() override {
    bench_.power_on();
    initialise({});
    ASSERT_TRUE(bench_.set_prm({}).answered());
    ASSERT_TRUE(bench_.check_cfg({0x10, 0x20}).answered());
  }
  void initialise(Init init) {
    init.cfg = {0x10, 0x20};
    write(0x020, init.block());
    write(0x010, {0x04});
    bench_.run_cycles(200);
    ASSERT_EQ(bench_.peek(0x00A) & 1, 1);
    bench_.find_baud();
  }
  void send(const Bytes& bytes) {
    for (const std::uint8_t byte : bytes) {
      const unsigned frame =
          static_cast<unsigned>(byte) << 1 | static_cast<unsigned>(__builtin_popcount(byte) & 1) << 9 | 1U << 10;
      for (int i = 0; i < 11; ++i) {
        bench_.chip.set(bench_.now(), Pin::kRxd, static_cast<Level>(frame >> i & 1));
        bench_.run_cycles(26);
      }
    }
  }
  void write(std::uint16_t address, const Bytes& data) {
    send(write_telegram(address, data));
    bench_.run_cycles(26 * 11 * 8);
  }
  Bytes talk(const Bytes& request) {
    const Tick from = bench_.now();
    send(request);
    bench_.run_cycles(26 * 11 * 40);
    for (const PinChange& change : bench_.changes(Pin::kTxd))
      if (change.at >= from) return sent_since(change.at);
    return {};
  }
  Bytes sent_since(Tick from) {
    const std::vector<PinChange> txd = bench_.changes(Pin::kTxd);
    const auto level_at = [&](Tick at) {
      Level level = 1;
      for (const PinChange& change : txd)
        if (change.at <= at) level = change.level;
      return level;
    };
    Bytes bytes;
    for (Tick start = from; level_at(start) == 0; start += Tick{11} * 26 * 250) {
      unsigned byte = 0;
      for (int i = 1; i < 9; ++i) byte |= static_cast<unsigned>(level_at(start + (i * 26 + 13) * 250)) << (i - 1);
      bytes.push_back(static_cast<std::uint8_t>(byte));
    }
    return bytes;
  }
  SlaveBench bench_{rsu()};
};

// docs/microarchitecture_rsu.md, section 10.
TEST_F(RsuUartOnBus, WorkedExampleToTheCycle) {
  bool beg_is_judgement = false;
  for (int i = 0; i < 12 && !beg_is_judgement; ++i) {
    ASSERT_TRUE(bench_.data_exchange({0xAA}).answered());
    write(0x00E, {0x00});
    write(0x00F, {0x00});
    ASSERT_TRUE(bench_.data_exchange({0xAA}).answered());
    bench_.run_cycles(100 + 5 * i);
    ASSERT_EQ(bench_.peek(0x00E), 0x01);
    ASSERT_EQ(bench_.peek(0x319, 2), (Bytes{0x01, 0xAA}));
    const Cycle start = bench_.now() / 250 + 10;  // S = 10000 of the example
    bench_.run_until((start - 2) * 250 - 100);
    send({0x41, 0x00, 0x01, 0x30, 0x02, 0x01, 0x55, 0xAB, 0x18});
    const auto at = [start](Cycle cycle) { return (start + cycle - 10'000) * 250; };
    // 12571 and 12572 are over already: the last stop bit ends at 12572 as the line has it
    bench_.run_until(at(20'000));
    std::vector<PinChange> txd;
    for (const PinChange& change : bench_.changes(Pin::kTxd))
      if (change.at > at(10'000)) txd.push_back(change);
    ASSERT_FALSE(txd.empty());
    EXPECT_EQ(txd.front().at, at(12'858));
    EXPECT_EQ(sent_since(txd.front().at), (Bytes{0x01, 0x01, 0x03, 0x19, 0x02, 0x01, 0xAA, 0x62, 0x69}));
    EXPECT_EQ(bench_.peek(0x00E), 0x00);
    EXPECT_EQ(bench_.peek(0x130, 2), (Bytes{0x01, 0x55}));
    beg_is_judgement = true;
  }
  EXPECT_EQ(bench_.data_exchange({0xAB}).answer().data, Bytes{0x55}) << "the master has the inputs";
}

TEST_F(RsuUartOnBus, NewParametersAndConfiguration) {
  ASSERT_TRUE(bench_.data_exchange({0xAA}).answered());
  bench_.run_cycles(200);
  const auto exchange = [&] { return talk(exchange_telegram(0, 0x130, {0x01, 0x12})); };
  EXPECT_EQ(part_of(exchange(), 0, 4), (Bytes{0x01, 0x11, 0x04, 0x10}));
  EXPECT_EQ(exchange(), with_crc({0x01, 0x21, 0x05, 0x00, 0x05, 0x01, 0x01, 0x02, 0x10, 0x20}));
  EXPECT_EQ(exchange(), with_crc({0x01, 0x01, 0x03, 0x19, 0x02, 0x01, 0xAA}));
}

// UA1 and SP15: all news of the master stand in the DPRAM with their CRCs, and the chip says nothing until it is asked.
TEST_F(RsuUartOnBus, NothingIsSentUnasked) {
  write(0x005, {0x1D});
  initialise({});
  write(0x00E, {0x00});
  EXPECT_EQ(bench_.chip.level(Pin::kPbf), 1);
  const std::ptrdiff_t falls = falls_of_intr0(bench_);
  const std::size_t sent = bench_.changes(Pin::kTxd).size();
  ASSERT_TRUE(bench_.set_prm(with_dpv1()).short_acknowledge());
  ASSERT_TRUE(bench_.check_cfg({0x10, 0x20}).short_acknowledge());
  ASSERT_TRUE(bench_.data_exchange({0xAA}).answered());
  ASSERT_TRUE(bench_.srd(0x33, 0x33, {0x5E, 1, 2, 3}).short_acknowledge());
  connect_c2(bench_);
  ASSERT_TRUE(bench_.srd(0x30, 0x32, {0x5E, 4, 5, 6}).short_acknowledge());
  bench_.run_cycles(50'000);
  EXPECT_EQ(bench_.changes(Pin::kTxd).size(), sent);
  expect_pins_of_data_exchange(bench_, falls);
  EXPECT_EQ(bench_.peek(0x00E, 2), (Bytes{0x07, 0x03}));
  for (const Block& block : kNews) {
    EXPECT_EQ(bench_.peek(block.cell, static_cast<int>(block.bytes.size())), block.bytes) << block.cell;
    EXPECT_EQ(bench_.peek(block.crc, 2), crc_of(block.bytes)) << block.cell;
  }
  EXPECT_EQ(talk(read_telegram(0x00F, 1)), with_crc({0x81, 0x00, 0x03}));
}

// UA15: judging mode 2, the verdicts by write telegrams to B00C, then B010.
TEST_F(RsuUartOnBus, VerdictByAWrite) {
  Init init;
  init.prm_mode = init.cfg_mode = kUserJudges;
  initialise(init);
  ASSERT_TRUE(bench_.set_prm({}).answered());
  bench_.run_cycles(200);
  EXPECT_EQ(bench_.peek(0x00E) & 0x02, 0x02);
  write(0x00C, {0x00});
  write(0x010, {0x80});
  bench_.run_cycles(200);
  EXPECT_EQ(bench_.dp_state(), DpState::kWaitCfg);
  ASSERT_TRUE(bench_.check_cfg({0x10, 0x20}).answered());
  bench_.run_cycles(200);
  write(0x00C, {0x02});
  write(0x010, {0x40});
  bench_.run_cycles(200);
  EXPECT_EQ(bench_.dp_state(), DpState::kWaitPrm) << "refused";
}

// UA13 and 7.1.6, note 3: bit 0 is DATA_EXCH, also beside the error's bit 7.
TEST_F(RsuUartOnBus, BitZeroOfTheFunctionIsDataExchange) {
  ASSERT_EQ(bench_.dp_state(), DpState::kDataExch);
  EXPECT_EQ(talk(exchange_telegram(0, 0x319, {1})), with_crc({0x01, 0x81, 0x02}));
  EXPECT_EQ(part_of(talk(exchange_telegram(2, 0x227, {0, 0})), 0, 4), (Bytes{0x01, 0x01, 0x03, 0x19}));
  ASSERT_TRUE(bench_.set_prm({}).answered());
  ASSERT_EQ(bench_.dp_state(), DpState::kWaitCfg);
  EXPECT_EQ(talk(exchange_telegram(0, 0x319, {1})), with_crc({0x01, 0x80, 0x02}));
  EXPECT_EQ(part_of(talk(exchange_telegram(2, 0x227, {0, 0})), 0, 4), (Bytes{0x01, 0x00, 0x03, 0x19}));
}

// UA9 and D9: an exchange hands over each type of diagnosis; 00 ends Ext_Diag and leaves Stat_Diag, without a word to
// the master.
TEST_F(RsuUartOnBus, ExchangeOfEachTypeOfDiagnosis) {
  const auto give = [this](const Bytes& block) {
    EXPECT_EQ(part_of(talk(exchange_telegram(2, 0x227, block)), 0, 4), (Bytes{0x01, 0x01, 0x03, 0x19}));
    return bench_.data_exchange({0xAA}).answer().fc;
  };
  const auto read = [this] { return bench_.slave_diag(); };
  EXPECT_EQ(give({0x81, 1, 0x11}), 0x0A);
  EXPECT_EQ(read(), (Bytes{0x08, 0x04, 0, 2, 0x0C, 0xC9, 0x11}));
  EXPECT_EQ(give({0x00, 1, 0x12}), 0x08);
  EXPECT_EQ(read(), (Bytes{0x00, 0x04, 0, 2, 0x0C, 0xC9, 0x12})) << "Ext_Diag has gone";
  EXPECT_EQ(give({0x82, 1, 0x13}), 0x0A);
  EXPECT_EQ(read(), (Bytes{0x00, 0x06, 0, 2, 0x0C, 0xC9, 0x13}));
  EXPECT_EQ(give({0x81, 0}), 0x0A);
  EXPECT_EQ(read(), (Bytes{0x08, 0x06, 0, 2, 0x0C, 0xC9}));
  EXPECT_EQ(give({0x00, 0}), 0x0A) << "Stat_Diag stands";
  EXPECT_EQ(read(), (Bytes{0x00, 0x06, 0, 2, 0x0C, 0xC9}));
  EXPECT_EQ(give({0x02, 0}), 0x0A);
  EXPECT_EQ(read(), (Bytes{0x00, 0x04, 0, 2, 0x0C, 0xC9}));
  EXPECT_EQ(bench_.data_exchange({0xAA}).answer().fc, 0x08);
}

/// The same slave with its host at the SPI port.
class RsuSpiOnBus : public ::testing::Test {
 protected:
  RsuSpiOnBus() {
    bench_.chip.set(0, Pin::kMode, 1);
    bench_.chip.set(0, Pin::kAdr, 1);
  }
  void SetUp() override { bench_.power_on(); }
  /// One frame of XSS and the silence that a write needs after it; the reply, of so many bytes.
  Bytes ask(Bytes mosi, std::size_t reply) {
    const std::size_t request = mosi.size();
    mosi.resize(request + reply, 0xFF);
    Bytes miso;
    bench_.chip.set(bench_.now(), Pin::kXss, 0);
    for (const std::uint8_t out : mosi) {
      unsigned in = 0;
      for (int bit = 7; bit >= 0; --bit) {
        bench_.chip.set(bench_.now(), Pin::kMosi, static_cast<Level>(out >> bit & 1));
        bench_.run_for(600);
        in = in << 1 | (bench_.chip.level(Pin::kMiso) == 1 ? 1U : 0U);
        bench_.chip.set(bench_.now(), Pin::kSck, 1);
        bench_.run_for(600);
        bench_.chip.set(bench_.now(), Pin::kSck, 0);
      }
      miso.push_back(static_cast<std::uint8_t>(in));
    }
    bench_.run_for(600);
    bench_.chip.set(bench_.now(), Pin::kXss, 1);
    bench_.run_for(33'000);
    return part_of(miso, request, reply);
  }
  /// Cells, in one ownership; then the chip's next accesses.
  void write(std::initializer_list<std::pair<std::uint16_t, Bytes>> cells) {
    while (ask(write_telegram(0x014, {0x02}), 4) != with_crc({0xA1, 0x00})) {
    }
    for (const auto& [address, data] : cells)
      EXPECT_EQ(ask(write_telegram(address, data), 4), with_crc({0xA1, 0x00})) << address;
    EXPECT_EQ(ask(write_telegram(0x014, {0x00}), 4), with_crc({0xA1, 0x00}));
    bench_.run_cycles(600);
  }
  Bytes read(std::uint16_t address, std::uint8_t length) {
    const Bytes reply = ask(read_telegram(address, length), length + 4U);
    EXPECT_EQ(reply, with_crc(part_of(reply, 0, length + 2U)));
    EXPECT_EQ(part_of(reply, 0, 2), (Bytes{0x81, 0x00}));
    return part_of(reply, 2, length);
  }
  /// SPI's read and write, as often as an access of the chip refuses it.
  Bytes exchange(const Bytes& inputs, std::size_t outputs) {
    for (;;) {
      const Bytes reply = ask(inputs_telegram(inputs), 5 + outputs);
      if (part_of(reply, 0, 4) == with_crc({0xE1, 0x00})) continue;
      bench_.run_cycles(600);
      return reply;
    }
  }
  void initialise(std::uint8_t judged) {
    Init init;
    init.cfg = {0x10, 0x20};
    init.prm_mode = init.cfg_mode = judged;
    write({{0x005, {0x1D}}, {0x020, init.block()}, {0x010, {0x04}}});
    ASSERT_EQ(read(0x00A, 1), Bytes{0x01});
    bench_.find_baud();
  }
  SlaveBench bench_{rsu()};
};

// SP18 and 6.2.4: each kind of data by its cells and flags, as in parallel mode.
TEST_F(RsuSpiOnBus, BlocksVerdictsAndAcyclicAnswersAreByCells) {
  EXPECT_EQ(bench_.chip.level(Pin::kReady) + bench_.chip.level(Pin::kBr), 0);
  initialise(kUserJudges);
  EXPECT_EQ(bench_.chip.level(Pin::kPbf), 1);
  ASSERT_TRUE(bench_.set_prm(with_dpv1()).short_acknowledge());
  bench_.run_cycles(600);
  EXPECT_EQ(read(0x00E, 1), Bytes{0x02});
  EXPECT_EQ(read(0x410, 4), (Bytes{3, 0x80, 0, 0}));
  write({{0x00E, {0x00}}, {0x00C, {0x00}}, {0x010, {0x80}}});
  EXPECT_EQ(bench_.dp_state(), DpState::kWaitCfg);
  ASSERT_TRUE(bench_.check_cfg({0x10, 0x20}).short_acknowledge());
  bench_.run_cycles(600);
  EXPECT_EQ(read(0x500, 5), (Bytes{1, 1, 2, 0x10, 0x20}));
  write({{0x00E, {0x00}}, {0x00C, {0x00}}, {0x010, {0x40}}});
  ASSERT_EQ(bench_.dp_state(), DpState::kDataExch);
  expect_pins_of_data_exchange(bench_, 0);
  write({{0x130, {1, 0x55}}, {0x227, {0x81, 1, 0xAA}}, {0x010, {0x03}}});
  const Bytes diagnosis = bench_.slave_diag();
  EXPECT_EQ(diagnosis.back(), 0xAA);
  EXPECT_EQ(diagnosis.front(), 0x08) << "Ext_Diag";
  EXPECT_EQ(bench_.data_exchange({0xAA}).answer().data, Bytes{0x55});
  bench_.run_cycles(600);
  EXPECT_EQ(read(0x319, 2), (Bytes{1, 0xAA}));
  ASSERT_TRUE(bench_.srd(0x33, 0x33, {0x5E, 1, 2, 3}).short_acknowledge());
  bench_.run_cycles(600);
  EXPECT_EQ(read(0x00F, 1), Bytes{0x01});
  EXPECT_EQ(read(0x5D0, 4), (Bytes{0x5E, 1, 2, 3}));
  connect_c2(bench_);
  ASSERT_TRUE(bench_.srd(0x30, 0x32, {0x5E, 4, 5, 6}).short_acknowledge());
  bench_.run_cycles(600);
  EXPECT_EQ(read(0x00F, 1), Bytes{0x03});
  EXPECT_EQ(read(0x6D0, 4), (Bytes{0x5E, 4, 5, 6}));
  for (const Block& block : kNews) EXPECT_EQ(read(block.crc, 2), crc_of(block.bytes)) << block.cell;
  write({{0x5D0, {0x5E, 1, 2, 1, 0x77}}, {0x6D0, {0x5E, 4, 5, 1, 0x99}}, {0x00F, {0x00}}, {0x011, {0x03}}});
  EXPECT_EQ(read(0x010, 2), (Bytes{0, 0})) << "the chip has cleared the flags";
  EXPECT_EQ(bench_.srd(0x33, 0x33, {}).answer().data, (Bytes{0x5E, 1, 2, 1, 0x77}));
  EXPECT_EQ(bench_.srd(0x30, 0x32, {}).answer().data, (Bytes{0x5E, 4, 5, 1, 0x99}));
}

// SP16 and 6.3.3: without a claim, in every DP state; inputs of a wrong length are refused, the outputs come all the
// same.
TEST_F(RsuSpiOnBus, ReadAndWriteIsServedInEveryDpState) {
  const Bytes none = with_crc({0xC1, 0x00, 0x00});
  EXPECT_EQ(exchange({0x11}, 0), none) << "OFFLINE";
  initialise(0);
  EXPECT_EQ(bench_.dp_state(), DpState::kWaitPrm);
  EXPECT_EQ(exchange({0x12}, 0), none);
  ASSERT_TRUE(bench_.set_prm({}).answered());
  EXPECT_EQ(bench_.dp_state(), DpState::kWaitCfg);
  EXPECT_EQ(exchange({0x13}, 0), none);
  ASSERT_TRUE(bench_.check_cfg({0x10, 0x20}).answered());
  ASSERT_TRUE(bench_.data_exchange({0xAA}).answered());
  bench_.run_cycles(600);
  const Bytes outputs = with_crc({0xC1, 0x00, 0x01, 0xAA});
  EXPECT_EQ(exchange({0x14}, 1), outputs);
  EXPECT_EQ(bench_.data_exchange({0xAA}).answer().data, Bytes{0x14});
  EXPECT_EQ(exchange({0x15, 0x16}, 1), outputs);
  EXPECT_EQ(bench_.count(profibus::Reason::kInputLength), 1);
  EXPECT_EQ(bench_.data_exchange({0xAA}).answer().data, Bytes{0x14}) << "the earlier ones stay";
  EXPECT_EQ(bench_.count(dsdpv1::Reason::kSpiNoClaim), 1) << "that of B00A's read";
}

}  // namespace
}  // namespace dsdpv1::conformance
