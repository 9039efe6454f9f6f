#include "tests/spc3/random_user.hpp"

#include <algorithm>

namespace dsdpv1::spc3_test {
namespace {

spc3::Config config_of(unsigned seed) {
  spc3::Config config;
  config.search_window_ms = 1;
  config.search_window_bits = 400;
  config.violation = seed / 3 % 2;
  config.prm7 = seed / 6 % 2;
  config.prm_taken = seed / 2 % 2;
  config.address_cells = seed / 4 % 2;
  config.event_delay = seed % 2 == 0 ? 32 : 192;
  config.int_delay = seed % 5;
  config.clock = seed % 3 == 1 ? 24 : 48;
  config.ram_seed = seed;
  return config;
}

}  // namespace

// --- rules -----------------------------------------------------------------------------------------------------------

void Rules::reset() {
  imr_ = 0xFFFF;
  mode0_ = 0;
  inactive_until_ = 0;
}

void Rules::writes(Address address, std::uint8_t value) {
  const auto put = [&](std::uint16_t& word) {
    word = static_cast<std::uint16_t>((address & 1U) != 0 ? (word & 0xFF) | value << 8 : (word & 0xFF00) | value);
  };
  if ((address & ~1U) == regs::kImr) put(imr_);
  if ((address & ~1U) == regs::kMode0 && bench_.state() == DpState::kOffline) put(mode0_);
  if (address != regs::kMode1S || (value & regs::kMode1Eoi) == 0 || !interrupts()) return;
  inactive_until_ = bench_.cycle() + 1 + ((mode0_ & regs::kMode0EoiTimeBase) != 0 ? config_.eoi_1ms : 48);  // A13
}

unsigned Rules::word(Address low) const {
  return static_cast<unsigned>(chip().peek(low) | chip().peek(static_cast<Address>(low + 1)) << 8);
}

bool Rules::interrupts() const { return (chip().level(Pin::kXInt) != 0) == ((mode0_ & regs::kMode0IntPol) != 0); }

std::array<std::uint8_t, Rules::kPointers.size() + 1> Rules::pointers() const {
  std::array<std::uint8_t, kPointers.size() + 1> all{};
  std::transform(kPointers.begin(), kPointers.end(), all.begin(), [&](Address cell) { return chip().peek(cell); });
  all.back() = chip().peek(regs::kOrgReadCfgPointer);
  std::sort(all.begin(), all.end());
  return all;
}

void Rules::check() const {
  check_interrupt();
  check_buffers();
  EXPECT_EQ(pointers(), pointers_) << "a permutation of the user's";
  EXPECT_EQ(chip().level(Pin::kXDataExch) == 0, bench_.state() == DpState::kDataExch);
}

void Rules::check_interrupt() const {
  EXPECT_EQ(word(regs::kIr), word(regs::kIrr) & ~imr_);
  if (interrupts()) EXPECT_GE(bench_.cycle(), inactive_until_) << "the inactive time";
}

void Rules::check_buffers() const {
  for (const Address machine : {regs::kDinSm, regs::kDoutSm}) {
    unsigned present = 0;
    for (int place = 0; place < 8; place += 2) present |= 1U << (chip().peek(machine) >> place & 3);
    EXPECT_EQ(present, 0xFU) << "each buffer once, so that D is not the user's, and one nil";
    const unsigned n = chip().peek(machine) >> 2 & 3U, f = chip().peek(machine) >> 6;
    EXPECT_TRUE((n == 0) != (f == 0)) << "D and U are buffers";
  }
  constexpr std::array<int, 6> kCodes = {0x09, 0x06, 0x0D, 0x07, 0x0E, 0x0B};
  EXPECT_NE(std::find(kCodes.begin(), kCodes.end(), chip().peek(regs::kDiagSm)), kCodes.end())
      << "one is the chip's: " << int{chip().peek(regs::kDiagSm)};
}

// --- the user --------------------------------------------------------------------------------------------------------

RandomUser::RandomUser(unsigned seed, Engines engines)
    : random_(seed),
      config_(config_of(seed)),
      twin_(engines == Engines::kStepAndSkip),
      bench_(static_cast<Variant>(seed % 3), config_, engines),
      rules_(bench_, config_) {
  bench_.twins.restored = 3;
  bench_.timeline.add(*this);
}

void RandomUser::play(int acts) {
  bench_.power_on();
  in_reset_ = false;
  begin();
  for (int i = 0; i < acts && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(i);
    act();
    bench_.run_cycles(1);
    rules_.check();
    exchanged_ |= bench_.state() == DpState::kDataExch;
  }
}

void RandomUser::run(Tick now) {
  --left_;
  bench_.twins.compare(now);  // also a saved state in the middle of a telegram
  const unsigned what = below(8);
  if (what < 3)
    load(below(0x18));
  else if (what == 3)
    store(regs::kOrgAddress, 9);
  else
    store(regs::kMode1S, static_cast<std::uint8_t>(1U << below(6)));
  plan();
}

void RandomUser::plan() {
  at_ = bench_.now() + static_cast<Tick>(below(400'000));
  announce();
}

Bytes RandomUser::bytes(unsigned most) {
  Bytes all(below(most + 1));
  for (std::uint8_t& each : all) each = byte();
  return all;
}

std::uint8_t RandomUser::load(unsigned address) {
  ++accesses_;
  return bench_.load(static_cast<Address>(address));
}

void RandomUser::store(unsigned address, std::uint8_t value) {
  ++accesses_;
  const unsigned map = bench_.variant() == Variant::kVpc3 ? 0xFFF : 0x7FF;
  if (!in_reset_) rules_.writes(static_cast<Address>(address & map), value);
  bench_.store(static_cast<Address>(address), value);
}

void RandomUser::begin() {
  Organisation given;
  given.aux_select = static_cast<std::uint8_t>(below(8));
  given.modes = static_cast<std::uint16_t>(regs::kMode0DpMode | (byte() & 0xD8) | (below(64) & 0x36) << 8U);
  given.inputs = static_cast<std::uint8_t>(below(4));
  given.outputs = static_cast<std::uint8_t>(below(4));
  given.user_watchdog = static_cast<std::uint16_t>(below(40));
  store(regs::kMode1S, regs::kMode1GoOffline);
  bench_.run_cycles(2000);
  for (const Address word : {regs::kMode0, regs::kImr})
    for (unsigned half = 0; half < 2; ++half)
      rules_.writes(static_cast<Address>(word + half),
                    static_cast<std::uint8_t>(word == regs::kMode0 ? given.modes >> 8 * half : 0U));
  bench_.initialise(given);
  rules_.take_pointers();
  store(regs::kWdBaudControl, static_cast<std::uint8_t>(below(3)));
  if (below(2) == 0) load(regs::kNewDin);
  bench_.start();
  for (int i = 0; i < 3; ++i) bench_.ask(60);
  bench_.set_prm(Bytes(below(10), 0), 0xB0, 0, 0, 0, 1);
  bench_.run_cycles(400);
  load(regs::kPrmOk);
  bench_.check_cfg();
  bench_.run_cycles(400);
  load(regs::kCfgOk);
  load(regs::kNewDin);
  bench_.run_cycles(2);
}

void RandomUser::act() {
  const unsigned what = below(400);
  if (what == 0) return reset();
  if (what < 8) return bench_.run_until(bench_.now() + static_cast<Tick>(below(3'000'000)));
  if (what < 10) return bench_.run_ms(below(twin_ ? 13 : 60));  // a cycle of step each; BAUD_CONTROL has 10 or 40 ms
  if (bench_.state() != DpState::kDataExch && below(30) == 0) return begin();
  if (what < (twin_ ? 200U : 40U)) return telegram();
  access();
}

void RandomUser::telegram() {
  constexpr std::array<int, 13> kSaps = {kDefaultSap, kDefaultSap, kDefaultSap, 55, 56, 57, 58, 59, 60, 60, 61, 62, 33};
  const int sap = kSaps.at(below(13));
  const auto master = static_cast<std::uint8_t>(below(20) == 0 ? 7 : 2);
  left_ = static_cast<int>(below(6));
  plan();
  if (below(6) == 0) return telegram_for_others();
  const auto wd = static_cast<std::uint8_t>(below(8) == 0 ? 0x08 : 0x00);
  switch (sap) {
    case 58:
      return bench_.control(static_cast<std::uint8_t>(1U << below(8)), static_cast<std::uint8_t>(below(2)), master);
    case 61: {
      const Bytes user = below(3) == 0 ? Bytes{} : bytes(70);
      const auto status = static_cast<std::uint8_t>((below(8) == 0 ? 0x40 : 0x80) | (byte() & 0x30) | wd);
      bench_.set_prm(user, status, byte(), 1, byte(), 1, master);
      return;
    }
    case 62: bench_.ask(62, bytes(70), master); return;
    case 55: bench_.ask(55, below(2) == 0 ? bytes(6) : Bytes{5, 0x0C, 0xC9, 0, 1}, master); return;
    case kDefaultSap: bench_.repeat(sap, Bytes(bench_.organisation.outputs, byte()), master, below(2) == 0); return;
    default: bench_.repeat(sap, below(9) == 0 ? bytes(3) : Bytes{}, master, below(2) == 0); return;
  }
}

// With live address cells it may become one for this chip.
void RandomUser::telegram_for_others() {
  const auto other = static_cast<std::uint8_t>(below(4) == 0 ? below(126) : 9);
  if (below(4) == 0) bench_.store(regs::kOrgAddress, other);
  bench_.requester.send(bench_.timeline, bus::make_telegram(other, 2, 0x6D, bytes(20)), {.wants_answer = false});
  bench_.run_cycles(2000);
  bench_.store(regs::kOrgAddress, bench_.address);
}

void RandomUser::access() {
  switch (below(12)) {
    case 0: return write();
    case 1: load(below(6) == 0 ? below(0x1000) : below(0x40)); return;
    case 2: load(regs::kPrmOk); return;
    case 3: load(regs::kCfgOk); return;
    case 4: load(regs::kNewDin); return;
    case 5: load(regs::kNextDout); return;
    case 6: load(regs::kNewDiag); return;
    case 7: return store(regs::kIar + below(2), byte());
    case 8: return store(regs::kMode1S, regs::kMode1Eoi);
    case 9: return store(regs::kMode1S, static_cast<std::uint8_t>(1U << below(8)));
    case 10: return store(regs::kImr + below(2), byte());
    default: load(0x0E + below(7)); return;
  }
}

// Any cell; of the pointers two, so that they stay a permutation.
void RandomUser::write() {
  const unsigned address = below(6) == 0 ? below(0x1000) : below(0x40);
  const auto is_pointer = [&](Address cell) { return (address & 0x7FF) == cell; };
  if (std::none_of(Rules::kPointers.begin(), Rules::kPointers.end(), is_pointer) &&
      !is_pointer(regs::kOrgReadCfgPointer))
    return store(address, byte());
  exchange_pointers();
}

void RandomUser::exchange_pointers() {
  const Address one = Rules::kPointers.at(below(13)), other = Rules::kPointers.at(below(13));
  const std::uint8_t first = load(one), second = load(other);
  store(one, second);
  store(other, first);
}

void RandomUser::reset() {
  in_reset_ = true;
  bench_.twins.set(bench_.now() + below(250), Pin::kReset, 1);
  rules_.reset();
  bench_.run_cycles(below(10));
  bench_.twins.set(bench_.now() + below(250), Pin::kReset, 0);
  bench_.run_cycles(5);
  in_reset_ = false;
}

}  // namespace dsdpv1::spc3_test
