// The chip at its pins: a host and a line that break rules, and keep them, so that it makes progress. Compares the
// model with itself: step, skip and dozing change the same pins at the same ticks, report the same, and have the same
// cells.
#include <gtest/gtest.h>

#include "kinds/dsdpv1/random/host_verbs.hpp"
#include "model/dpram/crc16.hpp"
#include "tests/conformance/slave_bench.hpp"
#include "tests/fuzz/input.hpp"

namespace dsdpv1 {
namespace {

using bus::Bytes;
using bus::Tick;

constexpr Tick kCycle = profibus::kTicksPerCycle;
constexpr Tick kLongest = 25'000 * kCycle;  ///< step evaluates each of them
constexpr Tick kSetup = 200, kStrobe = 600, kHold = 200;

/// Sends independently of other stations.
class Master : public bus::Agent, private bus::Listener {
 public:
  explicit Master(bus::Segment& segment) : sender_(segment, segment.attach("master", this)) {}

  /// Nothing while it still sends.
  void send(Tick at, int baud, const std::vector<bus::Character>& characters) {
    if (sender_.busy() || characters.empty()) return;
    sender_.set_timing(bus::baud(baud).bit);
    sender_.send(at, characters);
    announce();
  }
  Tick next() const override { return sender_.next(); }
  void run(Tick now) override { sender_.run(now); }

 private:
  void line_changed(Tick /*at*/, bool /*level*/) override {}
  bool run_begins(const bus::CharacterRun& /*run*/) override { return true; }
  void run_cut(Tick at, bool /*level*/) override {
    sender_.run_cut(at);
    announce();
  }

  bus::UartSender sender_;
};

Config config_of(fuzz::Input& input) {
  const std::uint8_t what = input.byte();
  Config config;
  config.part = static_cast<Part>(what % 3);
  config.u_timer = 20'000;
  config.search_window_ms = 1;
  config.search_window_bits = 150;
  config.baud_control_ms = 2;
  config.ready_cycles = 64;
  if ((what & 4) != 0) config.access_interval = 7 + input.byte();
  if ((what & 8) != 0) config.serial_block_crc = 1;
  if ((what & 16) != 0) config.spi_reply_gap = static_cast<std::uint32_t>(input.below(17));
  if ((what & 32) != 0) config.spi_write_gap = 0;
  return config;
}

class Play {
 public:
  Play(const Config& config, fuzz::Input& input) : input_(input), chip_(segment_, config) {
    timeline_.add(chip_);
    timeline_.add(master_);
  }

  void run() {
    while (!input_.empty() && timeline_.now() < kLongest) act();
    wait(1000 * kCycle);
    for (std::uint16_t cell = 0; cell < regs::kDpramSize; ++cell)
      fuzz::promise(chip_.peek(cell) == chip_.peek_step(cell), "step and skip have the same cells");
  }

 private:
  void act() {
    switch (input_.below(16)) {
      case 0: return wait(static_cast<Tick>(input_.byte()));
      case 1: return wait(static_cast<Tick>(input_.number(2) % 4000) * kCycle);
      case 2: return any_pin();
      case 3: return write(cell(), input_.byte());
      case 4: return read(cell());
      case 5: return take();
      case 6: return give();
      case 7: return reset(static_cast<Tick>(input_.number(2)));
      case 8: return telegram();
      case 9: return characters();
      case 10: return block();
      case 11: return force();
      case 12: return spi();
      case 13: return uart();
      case 14: return initialise();
      default: return bring_up();
    }
  }

  void wait(Tick ticks) {
    timeline_.run_until(timeline_.now() + ticks);
    chip_.compare(timeline_.now());
  }
  void set(Pin pin, Level level) { chip_.set(timeline_.now(), pin, level); }

  // --- pins
  void any_pin() {
    const auto pin = static_cast<Pin>(input_.below(kRsuPinCount));
    if (!is_input(pin) || pin == Pin::kPbrxd) return;  // the line is the segment's
    const int value = static_cast<int>(input_.number(2)) & ((1 << width(pin)) - 1);
    set(pin, pin == Pin::kDIn && input_.byte() % 4 == 0 ? kLevelZ : static_cast<Level>(value));
  }
  void reset(Tick low) {
    set(Pin::kReset, 0);
    wait(low);
    set(Pin::kReset, 1);
  }
  /// Forces the line's level until another input releases it.
  void force() {
    const std::uint8_t how = input_.byte();
    segment_.force(timeline_.now(), how % 3 == 2 ? std::nullopt : std::optional<bool>(how % 3 == 1));
  }

  // --- the parallel host
  int cell() { return static_cast<int>(input_.number(2)) & 0x7FF; }
  void write(int address, int value) {
    set(Pin::kA, static_cast<Level>(address & 0x7FF));
    set(Pin::kDIn, static_cast<Level>(value));
    set(Pin::kCsr, 0);
    wait(kSetup);
    set(Pin::kWr, 0);
    wait(kStrobe);
    set(Pin::kWr, 1);
    wait(kHold);
    set(Pin::kCsr, 1);
    set(Pin::kDIn, kLevelZ);
  }
  void read(int address) {
    set(Pin::kA, static_cast<Level>(address));
    set(Pin::kCsr, 0);
    wait(kSetup);
    set(Pin::kRd, 0);
    wait(static_cast<Tick>(input_.byte()) * 4);
    chip_.sample(timeline_.now());
    set(Pin::kRd, 1);
    wait(kHold);
    set(Pin::kCsr, 1);
  }
  void take() {
    constexpr int kPatience = 100;
    set(Pin::kRReq, 1);
    wait(4 * kCycle);
    for (int i = 0; i < kPatience && (chip_.level(Pin::kLReq) != 0 || chip_.level(Pin::kLSta) != 0); ++i) wait(kCycle);
    set(Pin::kRSta, 1);
    wait(kCycle);
  }
  void give() {
    set(Pin::kRSta, 0);
    set(Pin::kRReq, 0);
  }
  void write_block(int address, int crc_address, const Bytes& bytes, int crc_error) {
    const int crc = dpram::crc16(bytes.data(), static_cast<int>(bytes.size())) ^ crc_error;
    for (std::size_t i = 0; i < bytes.size(); ++i) write(address + static_cast<int>(i), bytes[i]);
    write(crc_address, crc >> 8);
    write(crc_address + 1, crc & 0xFF);
  }
  /// An area that the user hands over: inputs, diagnosis.
  void block() {
    const bool inputs = input_.byte() % 2 == 0;
    Bytes bytes = input_.bytes(1 + input_.below(12));
    const int error = input_.byte() % 8 == 0 ? input_.byte() : 0;
    take();
    if (inputs)
      write_block(regs::kInput, regs::kInputCrc, bytes, error);
    else
      write_block(regs::kDiag, regs::kDiagCrc, bytes, error);
    write(regs::kUserCommand1, inputs ? regs::kUserCommand1Input : regs::kUserCommand1Diag);
    give();
  }
  void initialise() {
    conformance::Init init;
    init.prm_mode = static_cast<std::uint8_t>(input_.below(4));
    init.cfg_mode = static_cast<std::uint8_t>(input_.below(4));
    if (const std::size_t length = input_.below(8); length != 0) init.cfg = input_.bytes(length);
    init.crc_error = input_.byte() % 16 == 0 ? 1 : 0;
    take();
    write_block(regs::kInit, regs::kInitCrc, init.block(), init.crc_error);
    write(regs::kDpv1Enable, input_.byte() % 2 == 0 ? 0x1D : 0);
    write(regs::kUserCommand1, regs::kUserCommand1Init);
    give();
    wait(200 * kCycle);
  }

  // --- the serial hosts of the DSDPV1-RSU
  void play(const std::vector<cosim::PinEdge>& edges) {
    const Tick begin = timeline_.now();
    for (const cosim::PinEdge& each : edges) {
      if (timeline_.now() > kLongest) break;
      timeline_.run_until(std::max(timeline_.now(), begin + each.at));
      set(static_cast<Pin>(each.pin), each.level);
    }
    wait(0);
  }
  cosim::Action frame(cosim::Verb verb) {
    cosim::Action action;
    action.verb = verb;
    const std::uint8_t how = input_.byte();
    action.bytes = input_.bytes(1 + how % 24);
    if (how >= 192) action.bits = input_.byte();
    return action;
  }
  void spi() {
    cosim::Action action = frame(cosim::verb::kSpi);
    const Tick tempo = 600 + input_.byte() % 4 * 100 - (input_.byte() % 16 == 0 ? 150 : 0);
    action.high = action.low = tempo;
    play(cosim::spi_edges(action));
  }
  void uart() {
    cosim::Action action = frame(cosim::verb::kUart);
    action.bits = 0;
    action.rate = 7 - static_cast<int>(input_.below(3));  // the fast ones
    play(cosim::uart_edges(action));
  }

  // --- the line
  int baud() { return static_cast<int>(input_.below(4)); }  // slower ones take longer than an input may
  void send(const Bytes& bytes, const bus::WireFaults& faults = {}) {
    master_.send(timeline_.now(), baud(), bus::characters(bytes, faults));
  }
  void telegram() {
    constexpr std::uint8_t kSaps[] = {51, 55, 56, 57, 58, 59, 60, 61, 62, 49, 48, 47};
    const std::uint8_t address = input_.byte();
    const std::uint8_t to = address % 4 == 0 ? 127 : address % 4 == 1 ? input_.byte() & 0x7FU : 5U;
    const std::uint8_t fc = input_.byte();
    std::optional<std::uint8_t> dsap, ssap;
    if (input_.byte() % 4 != 0) {
      dsap = kSaps[input_.below(sizeof kSaps)];
      ssap = dsap == 51 || *dsap < 50 ? 50 : 62;
    }
    send(bus::encode(bus::make_telegram(to, 2, fc, input_.bytes(input_.below(32)), dsap, ssap)));
  }
  void characters() {
    bus::WireFaults faults;
    const std::uint8_t which = input_.byte();
    if ((which & 1) != 0) faults.wrong_parity_at = input_.byte();
    if ((which & 2) != 0) faults.missing_stop_at = input_.byte();
    if ((which & 4) != 0) {
      faults.gap_before = input_.byte();
      faults.gap_millibits = static_cast<int>(input_.number(2));
    }
    if ((which & 8) != 0) {
      faults.truncate_after = input_.byte();
      faults.truncate_bits = static_cast<int>(input_.below(11));
    }
    if ((which & 16) != 0) {
      faults.glitch_at = input_.byte();
      faults.glitch = {static_cast<int>(input_.number(2)) % 11'000, static_cast<int>(input_.number(2)) % 3000};
    }
    send(input_.bytes(1 + input_.below(48)), faults);
  }
  /// To data exchange, when the chip is initialised as it is by default: FDL status, Set_Prm, Chk_Cfg.
  void bring_up() {
    conformance::Prm prm;
    prm.user = input_.byte() % 2 == 0 ? Bytes{} : input_.bytes(1 + input_.below(8));
    const Bytes telegrams[] = {bus::encode(bus::make_telegram(100, 2, 0x49)),
                               bus::encode(bus::make_telegram(5, 2, 0x6D, prm.bytes(), 61, 62)),
                               bus::encode(bus::make_telegram(5, 2, 0x5D, {0x11, 0x21}, 62, 62)),
                               bus::encode(bus::make_telegram(5, 2, 0x7D, {1, 2}))};
    for (const Bytes& each : telegrams) {
      master_.send(timeline_.now(), 0, bus::characters(each));
      wait(static_cast<Tick>(each.size() * bus::kCharacterBits + 400) * bus::baud(0).bit);
    }
  }

  fuzz::Input& input_;
  bus::Timeline timeline_;
  bus::Segment segment_;
  conformance::TwinChip chip_;
  Master master_{segment_};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  GTEST_FLAG_SET(throw_on_failure, testing::UnitTest::GetInstance()->current_test_info() == nullptr);
  fuzz::Input input(data, size);
  const Config config = config_of(input);
  Play(config, input).run();
  return 0;
}

}  // namespace dsdpv1
