// ChipRecorder at each module with initiators that know nothing of it: verdict and margins do not depend on the
// quantum, and no access is less ahead than without it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>

#include "kinds/systemc/chip_recorder.hpp"
#include "model/systemc/host_pins.hpp"
#include "model/systemc/rsu_pins.hpp"
#include "model/systemc/rsu_tlm.hpp"
#include "model/systemc/spc3_pins.hpp"
#include "model/systemc/spc3_tlm.hpp"
#include "registers/spc3_regs.hpp"
#include "tests/systemc/bench.hpp"
#include "tests/systemc/foreign_initiator.hpp"
#include "tests/systemc/own_process.hpp"
#include "tests/systemc/platform.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::ChipRecorder;
using dsdpv1::systemc::DriverCpu;
using dsdpv1::systemc::RecorderOptions;
using dsdpv1::systemc::to_time;
using sc_core::sc_time;
using testing::HasSubstr;

namespace {

using Mistakes = std::function<void(ForeignInitiator&)>;
const Mistakes kNone = [](ForeignInitiator&) {};

struct Case {
  double quantum_us = 0;
  bool recorded = true;
  Mistakes mistakes = kNone;
  RecorderOptions options = {};
  Tick wr_low = AccessTiming().wr_low;
};

// --- chips and their wiring ------------------------------------------------------------------------------------------

struct Wires {
  sc_core::sc_signal<bool> reset{"reset"}, r_req{"r_req"}, r_sta{"r_sta"};
  ForeignInitiator initiator{"initiator"};
  Wires() {
    initiator.R_REQ(r_req), initiator.R_STA(r_sta);
    thread([this] {
      wait_until(kUs);
      reset.write(true);
    });
  }
  template <class Chip>
  void connect(Chip& chip) {
    chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(r_sta);
  }
};

AccessTiming timing_of(const Case& it) {
  AccessTiming timing;
  timing.wr_low = it.wr_low;
  return timing;
}

template <class Chip, class Options>
struct AtSocket : Wires {
  Chip chip;
  explicit AtSocket(const Case& it) : chip("chip", options(it)) {
    connect(chip);
    initiator.socket.bind(chip.host_socket);
  }
  static Options options(const Case& it) {
    Options options;
    options.access = timing_of(it);
    options.report_violations = false;
    return options;
  }
};

template <class Chip>
struct AtPins : Wires {
  Chip chip;
  systemc::HostPins host;
  sc_core::sc_signal<sc_dt::sc_uint<11>> a;
  sc_core::sc_signal_rv<8> d;
  sc_core::sc_signal<bool> csr, rd, wr, pbrxd{"pbrxd", true}, l_req, l_sta, intr0, pbtxd, pbrts, pbf, br, ready;
  explicit AtPins(const Case& it) : chip("chip", options()), host("host", timing_of(it)) {
    connect(chip);
    chip.A(a), chip.D(d), chip.CSR(csr), chip.RD(rd), chip.WR(wr), chip.PBRXD(pbrxd);
    chip.L_REQ(l_req), chip.L_STA(l_sta), chip.INTR0(intr0), chip.PBTXD(pbtxd), chip.PBRTS(pbrts);
    chip.PBF(pbf), chip.BR(br), chip.READY(ready);
    host.A(a), host.D(d), host.CSR(csr), host.RD(rd), host.WR(wr);
    initiator.socket.bind(host.socket);
  }
  static systemc::PinOptions options() {
    systemc::PinOptions options;
    options.report_violations = false;
    return options;
  }
};

struct AtRsuPins : AtPins<systemc::RsuPinModule> {
  sc_core::sc_signal<bool> xss{"xss", true}, sck, mosi, rxd{"rxd", true}, txd;
  sc_core::sc_signal_resolved miso;
  sc_core::sc_signal<sc_dt::sc_uint<2>> mode, adr;
  sc_core::sc_signal<sc_dt::sc_uint<3>> ubr, uiv;
  explicit AtRsuPins(const Case& it) : AtPins(it) {
    chip.XSS(xss), chip.SCK(sck), chip.MOSI(mosi), chip.MISO(miso), chip.RXD(rxd), chip.TXD(txd);
    chip.MODE(mode), chip.ADR(adr), chip.UBR(ubr), chip.UIV(uiv);
  }
};

/// A user CPU that starts a chip of the SPC3 family without what a start needs, and accesses what is not there.
class Spc3User : public sc_core::sc_module {
 public:
  int accesses = 0, ahead = 0;

  explicit Spc3User(const sc_core::sc_module_name& name) : sc_module(name) {
    SC_HAS_PROCESS(Spc3User);
    SC_THREAD(run);
  }

 private:
  virtual void access(bool write, spc3::Address address, std::uint8_t& value) = 0;
  virtual void pause() = 0;
  void run() {
    wait_until(20 * kUs);
    const std::pair<spc3::Address, std::uint8_t> cells[] = {{spc3::regs::kMode0, 0},
                                                            {spc3::regs::kMode0 + 1, 1},
                                                            {spc3::regs::kOrgAddress, 9},
                                                            {spc3::regs::kMode1S, spc3::regs::kMode1Start},
                                                            {0x700, 1}};
    for (auto [address, value] : cells) access(true, address, value);
    for (int i = 0; i < 100; ++i) {
      std::uint8_t value = 0;
      access(false, spc3::regs::kIrr, value);
      pause();
    }
  }
};

class Spc3SocketUser : public Spc3User {
 public:
  tlm_utils::simple_initiator_socket<Spc3SocketUser> socket{"socket"};
  using Spc3User::Spc3User;

 private:
  void access(bool write, spc3::Address address, std::uint8_t& value) override {
    tlm::tlm_generic_payload payload;
    payload.set_command(write ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND);
    payload.set_address(address);
    payload.set_data_ptr(&value);
    payload.set_data_length(1);
    payload.set_streaming_width(1);
    const sc_time before = sc_core::sc_time_stamp();
    sc_time delay = keeper_.get_local_time();
    socket->b_transport(payload, delay);
    ++accesses;
    ahead += sc_core::sc_time_stamp() == before ? 1 : 0;
    keeper_.set(delay);
    if (keeper_.need_sync()) keeper_.sync();
  }
  void pause() override {
    keeper_.inc(to_time(kUs));
    if (keeper_.need_sync()) keeper_.sync();
  }
  tlm_utils::tlm_quantumkeeper keeper_;
};

/// An SPC3 at its socket.
struct AtSpc3Socket {
  sc_core::sc_signal<bool> reset{"reset", true};
  systemc::Spc3TlmModule chip{"chip", options()};
  Spc3SocketUser initiator{"initiator"};
  explicit AtSpc3Socket(const Case& /*it*/) {
    initiator.socket.bind(chip.host_socket);
    chip.RESET(reset);
    thread([this] {
      wait_until(kUs);
      reset.write(false);
    });
  }
  static systemc::Spc3TlmOptions options() {
    systemc::Spc3TlmOptions options;
    options.report_violations = false;
    return options;
  }
};

/// The same accesses by the pins of the asynchronous Intel bus.
struct AtSpc3Pins : Spc3User {
  sc_core::sc_signal<bool> reset{"reset", true}, xint_mot, mode, divider, xtest0{"xtest0", true},
      xtest1{"xtest1", true}, xcs{"xcs", true}, xrd{"xrd", true}, xwr{"xwr", true}, ale, rxd{"rxd", true}, xcts, xready,
      x_int, xdataexch, txd, rts;
  sc_core::sc_signal<sc_dt::sc_uint<11>> ab;
  sc_core::sc_signal_rv<8> db;
  systemc::Spc3PinModule chip{"chip", options()};
  AtSpc3Pins& initiator = *this;
  explicit AtSpc3Pins(const Case& /*it*/) : Spc3User("initiator") {
    chip.RESET(reset), chip.XINT_MOT(xint_mot), chip.MODE(mode), chip.DIVIDER(divider), chip.XTEST0(xtest0);
    chip.XTEST1(xtest1), chip.XCS(xcs), chip.XRD_R_W(xrd), chip.XWR_E_CLOCK(xwr), chip.ALE_AS(ale), chip.AB(ab);
    chip.DB(db), chip.RXD(rxd), chip.XCTS(xcts), chip.XREADY_XDTACK(xready), chip.X_INT(x_int);
    chip.XDATAEXCH(xdataexch), chip.TXD(txd), chip.RTS(rts);
    thread([this] {
      wait_until(kUs);
      reset.write(false);
    });
  }
  static systemc::Spc3PinOptions options() {
    systemc::Spc3PinOptions options;
    options.report_violations = false;
    return options;
  }

 private:
  void access(bool write, spc3::Address address, std::uint8_t& value) override {
    sc_core::sc_signal<bool>& strobe = write ? xwr : xrd;
    ++accesses;
    ab.write(address);
    xcs.write(false);
    wait(to_time(360));
    strobe.write(false);
    if (write) db.write(sc_dt::sc_lv<8>(int{value}));
    wait(to_time(2400));
    strobe.write(true);
    wait(to_time(360));
    xcs.write(true);
    db.write(sc_dt::sc_lv<8>(sc_dt::SC_LOGIC_Z));
    wait(to_time(1000));
  }
  void pause() override { wait(to_time(kUs)); }
};

using AtTlm = AtSocket<systemc::TlmModule, systemc::TlmOptions>;
using AtRsuTlm = AtSocket<systemc::RsuTlmModule, systemc::RsuTlmOptions>;

// --- runs ------------------------------------------------------------------------------------------------------------

struct Told {
  double share = 0;
  int exit_code = 0;
  std::string checks, summary;
};

std::string text_of(const ChipRecorder& recorder) {
  std::ostringstream text;
  const auto number = [](const std::optional<std::int64_t>& value) { return value ? std::to_string(*value) : "-"; };
  for (const systemc::CheckOutcome& each : recorder.checks())
    if (each.count != 0)
      text << each.id << " " << each.count << " " << each.violations << " " << number(each.margin) << " "
           << number(each.measured) << " " << number(each.at) << "\n";
  return text.str();
}

void make_mistakes(const Case& it, ForeignInitiator& initiator) { it.mistakes(initiator); }
void make_mistakes(const Case& /*it*/, const Spc3User& /*user*/) {}

/// In a separate process.
template <class Platform>
Told run(const Case& it) {
  const std::string text = in_a_process_of_its_own([&] {
    set_resolution();
    collect_reports();
    tlm::tlm_global_quantum::instance().set(sc_time(it.quantum_us, sc_core::SC_US));
    Platform platform(it);
    make_mistakes(it, platform.initiator);
    ChipRecorder recorder(it.options);
    if (it.recorded) recorder.attach(platform.chip);
    sc_core::sc_start(400, sc_core::SC_US);
    std::ostringstream told;
    told << 1.0 * platform.initiator.ahead / platform.initiator.accesses << "\n";
    if (!it.recorded) return told.str();
    recorder.finish();
    told << recorder.exit_code() << "\n" << text_of(recorder) << "\f" << recorder.summary();
    return told.str();
  });
  std::istringstream in(text);
  Told told;
  in >> told.share >> told.exit_code;
  std::getline(in, told.checks);
  std::getline(in, told.checks, '\f');
  std::getline(in, told.summary, '\f');
  return told;
}

/// Lines that begin otherwise.
std::string without(const std::string& text, const std::string& beginning) {
  std::istringstream in(text);
  std::string rest;
  for (std::string line; std::getline(in, line);)
    if (line.rfind(beginning, 0) != 0) rest += line + "\n";
  return rest;
}

const Mistakes kReads = [](ForeignInitiator& initiator) { initiator.reads = true; };

}  // namespace

void simulate() {}

/// The same at each quantum, and as far ahead as without a recorder.
template <class Platform>
void expect_the_same_at_any_quantum(const Told& expected, const char* unlike = "none") {
  for (const double quantum_us : {0., 1., 10., 100.}) {
    const Told told = run<Platform>({quantum_us, true, kReads});
    EXPECT_EQ(first_difference(without(told.checks, unlike), without(expected.checks, unlike)), "") << quantum_us;
    EXPECT_EQ(told.exit_code, expected.exit_code);
    EXPECT_EQ(told.share, run<Platform>({quantum_us, false, kReads}).share) << quantum_us;
  }
}

TEST(ChipRecorder, JudgesTheTlmModuleAtAnyQuantumAlikeAndLeavesItsInitiatorAhead) {
  const Told coupled = run<AtTlm>({0, true, kReads});
  EXPECT_THAT(coupled.checks, HasSubstr("OWNERSHIP_SYNC_WINDOW 10 0 35"));
  EXPECT_THAT(coupled.checks, HasSubstr("TIMING_TS 400 0 683 833"));
  EXPECT_THAT(coupled.checks, HasSubstr("TIMING_TW 200 0 458 833"));
  EXPECT_EQ(coupled.share, 0);
  expect_the_same_at_any_quantum<AtTlm>(coupled);
  expect_the_same_at_any_quantum<AtRsuTlm>(coupled);
  // The pins do not show when the user samples D.
  expect_the_same_at_any_quantum<AtPins<systemc::PinModule>>(coupled, "TIMING_TW");
  expect_the_same_at_any_quantum<AtRsuPins>(coupled, "TIMING_TW");
}

TEST(ChipRecorder, FindsAHandshakeThatDoesNotWaitForTheChip) {
  const Mistakes hurries = [](ForeignInitiator& initiator) { initiator.asks = 50 * kNs; };
  const Told coupled = run<AtTlm>({0, true, hurries});
  EXPECT_THAT(coupled.checks, HasSubstr("OWNERSHIP_SYNC_WINDOW 10 10 -150 600 "));
  EXPECT_THAT(coupled.summary, HasSubstr("OWNERSHIP_SYNC_WINDOW at "));
  EXPECT_EQ(coupled.exit_code, 1);
  EXPECT_EQ(run<AtTlm>({10, true, hurries}).checks, coupled.checks);
  EXPECT_EQ(run<AtPins<systemc::PinModule>>({0, true, hurries}).checks, coupled.checks);
}

TEST(ChipRecorder, FindsAWriteThatIsTooShort) {
  const Mistakes fails = [](ForeignInitiator& initiator) { initiator.fails = true; };
  Case it = {0, true, fails};
  it.wr_low = 149;
  const Told coupled = run<AtTlm>(it);
  EXPECT_THAT(coupled.checks, HasSubstr("TIMING_TS 400 400 -1 149 "));
  EXPECT_EQ(run<AtPins<systemc::PinModule>>(it).checks, coupled.checks);
  it.quantum_us = 10;
  const Told decoupled = run<AtTlm>(it);
  EXPECT_EQ(decoupled.checks, coupled.checks);
  EXPECT_EQ(decoupled.share, 0) << "an access that violates table 15 waits";
}

TEST(ChipRecorder, LimitsAndAllowedViolationsAreThoseOfItsOptions) {
  Case it = {10};
  it.options.limits = {{"TIMING_TS", 100.}, {"COUNT_BY_USER", {}, false}};
  it.options.allowed = {"READY_UNSEEN"};
  const Told told = run<AtTlm>(it);
  EXPECT_THAT(told.checks, HasSubstr("TIMING_TS 400 400 -367 833 "));
  EXPECT_THAT(told.checks, testing::Not(HasSubstr("COUNT_BY_USER")));
  EXPECT_THAT(told.summary, HasSubstr("FAILED: 400 violations"));
  it.options.checks = systemc::RecorderChecks::kReport;
  EXPECT_EQ(run<AtTlm>(it).exit_code, 3) << "nothing judged";
}

TEST(ChipRecorder, SaysThatAnInitiatorWasAheadAndThatItForgotToSynchronise) {
  EXPECT_THAT(run<AtTlm>({10}).summary, HasSubstr("chip: 400, 400 ahead of simulation time, by 5.553 us at most"));
  EXPECT_THAT(run<AtTlm>({0}).summary, HasSubstr("chip: 400\n"));
  const Mistakes forgets = [](ForeignInitiator& initiator) { initiator.forgets_to_synchronise = true; };
  EXPECT_EQ(run<AtTlm>({0, true, forgets}).exit_code, 1);
  const Told told = run<AtTlm>({100, true, forgets});
  EXPECT_THAT(told.summary, HasSubstr("R_REQ moved at 104.000 us, but accesses up to 109.526 us"));
  EXPECT_THAT(told.checks, HasSubstr("OWNERSHIP_NOT_OWNER 400 400 "));
}

TEST(ChipRecorder, JudgesTheSpc3FamilyAtAnyQuantumAlike) {
  const Told coupled = run<AtSpc3Socket>({0, true});
  for (const char* violated : {"START_STATION 1 1", "START_PRESET 1 1", "USE_RAM 105 1"})
    EXPECT_THAT(coupled.checks, HasSubstr(violated));
  EXPECT_EQ(coupled.exit_code, 1);
  expect_the_same_at_any_quantum<AtSpc3Socket>(coupled);
  const Told pins = run<AtSpc3Pins>({0, true});
  for (const char* violated : {"START_STATION 1 1", "START_PRESET 1 1", "USE_RAM 105 1", "BUS_SETUP 105 0 "})
    EXPECT_THAT(pins.checks, HasSubstr(violated));
  EXPECT_EQ(pins.exit_code, 1);
}

// --- the driver at each port, from power-on to data exchange
// ----------------------------------------------------------

struct Exchanged {
  std::string checks, summary, verdict;
  std::uint64_t ahead = 0, ahead_alone = 0;
};

std::uint64_t ahead_of(const DriverCpu& cpu) { return cpu.accesses_ahead(); }
template <class Cpu>
std::uint64_t ahead_of(const Cpu& /*cpu*/) {
  return 0;
}

template <class Platform>
std::string exchange(double quantum_us, bool recorded, const RecorderOptions& options) {
  return in_a_process_of_its_own([&] {
    set_resolution();
    tlm::tlm_global_quantum::instance().set(sc_time(quantum_us, sc_core::SC_US));
    Platform platform;
    ChipRecorder recorder(options);
    if (recorded) recorder.attach(platform.chip);
    constexpr int kSlower = std::is_same_v<Platform, platform::Platform> ? 1 : platform::kSerialSlower;
    sc_core::sc_start(to_time(kSlower * platform::kEnd));
    std::ostringstream told;
    told << ahead_of(platform.cpu) << "\f";
    if (!recorded) return told.str();
    recorder.finish();
    told << text_of(recorder) << "\f" << recorder.summary() << "\f" << recorder.verdict();
    return told.str();
  });
}

template <class Platform>
Exchanged exchanged(double quantum_us, const RecorderOptions& options = {}) {
  Exchanged told;
  std::istringstream in(exchange<Platform>(quantum_us, true, options));
  std::string ahead;
  std::getline(in, ahead, '\f');
  std::getline(in, told.checks, '\f');
  std::getline(in, told.summary, '\f');
  std::getline(in, told.verdict, '\f');
  told.ahead = std::stoull(ahead);
  constexpr bool kMayBeAhead = std::is_same_v<Platform, platform::Platform>;
  if (kMayBeAhead) told.ahead_alone = std::stoull(exchange<Platform>(quantum_us, false, {}));
  return told;
}

template <class Platform>
class RecordedDriver : public testing::Test {};
using Platforms = testing::Types<platform::Platform, platform::SerialPlatform<systemc::SpiDriverCpu>,
                                 platform::SerialPlatform<systemc::UartDriverCpu>>;
TYPED_TEST_SUITE(RecordedDriver, Platforms);

TYPED_TEST(RecordedDriver, PassesWithTheSameMarginsAtAnyQuantumAndIsAheadAsWithoutARecorder) {
  const Exchanged coupled = exchanged<TypeParam>(0);
  EXPECT_EQ(coupled.verdict, "PASSED") << coupled.summary;
  EXPECT_THAT(coupled.checks, HasSubstr("OUTPUTS_FETCHED 1"));
  constexpr bool kMayBeAhead = std::is_same_v<TypeParam, platform::Platform>;
  for (const double quantum_us : kMayBeAhead ? std::vector{1., 10., 100.} : std::vector{10.}) {
    const Exchanged told = exchanged<TypeParam>(quantum_us);
    EXPECT_EQ(first_difference(told.checks, coupled.checks), "") << quantum_us;
    EXPECT_EQ(told.verdict, "PASSED");
    EXPECT_EQ(told.ahead, told.ahead_alone);
    if (kMayBeAhead) EXPECT_GT(told.ahead, 500U);
  }
}

// --- files, lifetimes, exceptions
// --------------------------------------------------------------------------------------

/// A new folder in that of the tests' files.
std::string folder(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / ("recorder_" + name);
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path.string() + "/";
}

std::uintmax_t size_of(const std::string& path) { return std::filesystem::file_size(path); }

std::string text_file(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ChipRecorder, WritesLogWaveWithTheInsideAndCaptureAsTheBenchDoes) {
  RecorderOptions options;
  const std::string files = folder("files");
  options.log = files + "run.log";
  options.wave = files + "run.vcd";
  options.capture = files + "line.pcapng";
  const Exchanged with = exchanged<platform::Platform>(10, options), alone = exchanged<platform::Platform>(10);
  EXPECT_EQ(first_difference(with.checks, alone.checks), "");
  EXPECT_EQ(with.ahead, with.ahead_alone) << "a wave does not keep the initiator from being ahead";
  const std::string log = text_file(options.log), wave = text_file(options.wave);
  for (const char* said : {"chip         info      DP_STATE: DP state WAIT_CFG to DATA_EXCH",
                           "bus          telegram  2 -> 9  request SRD high"})
    EXPECT_THAT(log, HasSubstr(said));
  for (const char* signal : {"R_REQ", "L_STA", " A ", " D ", "dp_state", "telegram"})
    EXPECT_THAT(wave, HasSubstr(signal));
  EXPECT_GT(size_of(options.capture), 1000U);
}

RecorderOptions with_inside(const std::string& path) {
  RecorderOptions options;
  options.checks = systemc::RecorderChecks::kOff;
  options.inside = true;
  options.wave = path;
  return options;
}

TEST(ChipRecorder, ItsWaveHasTheInsideOfAChipThatSteps) {
  const std::string told = in_a_process_of_its_own([] {
    set_resolution();
    collect_reports();
    systemc::TlmOptions steps;
    steps.chip.engine = Engine::kStep;
    Wires wires;
    systemc::TlmModule chip("chip", steps);
    wires.connect(chip);
    wires.initiator.socket.bind(chip.host_socket);
    const RecorderOptions options = with_inside(folder("inside") + "run.vcd");
    ChipRecorder recorder(options);
    recorder.attach(chip);
    sc_core::sc_start(150, sc_core::SC_US);
    recorder.finish();
    return recorder.verdict() + "\n" + text_file(options.wave);
  });
  for (const char* has : {"NOTHING JUDGED", "$scope module inside", "owner", "schip "})
    EXPECT_THAT(told, HasSubstr(has));
}

/// The exception of attach() or the constructor; the simulation does not start.
std::string refusal(const std::function<void(systemc::TlmModule&)>& attach) {
  return in_a_process_of_its_own([&]() -> std::string {
    systemc::TlmModule chip("chip");
    try {
      attach(chip);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "nothing";
  });
}

TEST(ChipRecorder, RefusesOptionsThatAreWrongInOneLine) {
  const auto refused = [](const RecorderOptions& options) {
    return refusal([&](systemc::TlmModule& chip) { ChipRecorder(options).attach(chip); });
  };
  RecorderOptions baud, limit, rule, log;
  baud.baud = "13M";
  limit.limits = {{"TIMING_TX", 1.}};
  rule.limits = {{"CRC_WRITTEN", 1.}};
  log.log = "/no/such/folder/run.log";
  EXPECT_EQ(refused(with_inside(folder("refused") + "run.vcd")),
            "inside is wanted of a module with Engine::kSkip, expected Engine::kStep in its options");
  EXPECT_THAT(refused(baud), HasSubstr("baud is \"13M\", expected 12M, "));
  EXPECT_THAT(refused(limit), HasSubstr("limits has \"TIMING_TX\", expected a check of docs/checks.md for dsdpv1"));
  EXPECT_THAT(refused(rule), HasSubstr("CRC_WRITTEN has a limit, expected none"));
  EXPECT_THAT(refused(log), HasSubstr("/no/such/folder/run.log"));
  EXPECT_THAT(refusal([](systemc::TlmModule& chip) {
                ChipRecorder recorder;
                recorder.attach(chip);
                recorder.attach(chip);
              }),
              HasSubstr("expected a recorder for each"));
  EXPECT_THAT(refusal([](systemc::TlmModule& /*chip*/) { ChipRecorder().summary(); }), HasSubstr("not finished"));
}

TEST(ChipRecorder, TwoOnTwoChipsAndTwoOnOneDoNotMeet) {
  const std::string told = in_a_process_of_its_own([] {
    set_resolution();
    collect_reports();
    tlm::tlm_global_quantum::instance().set(sc_time(10, sc_core::SC_US));
    struct Named : sc_core::sc_module {
      AtTlm at;
      explicit Named(const sc_core::sc_module_name& name) : sc_module(name), at(Case{}) {}
    } right("right"), wrong("wrong");
    wrong.at.initiator.asks = 50 * kNs;
    RecorderOptions wave;
    wave.wave = folder("two") + "right.fst";
    ChipRecorder of_right, of_wrong, again(wave);
    of_right.attach(right.at.chip), of_wrong.attach(wrong.at.chip), again.attach(right.at.chip);
    sc_core::sc_start(400, sc_core::SC_US);
    for (ChipRecorder* each : {&of_right, &of_wrong, &again}) each->finish();
    return std::to_string(right.at.initiator.ahead) + "\f" + text_of(of_right) + "\f" + text_of(of_wrong) + "\f" +
           text_of(again) + "\f" + std::to_string(size_of(wave.wave)) + "\f" + of_wrong.summary();
  });
  std::vector<std::string> parts;
  std::istringstream in(told);
  for (std::string part; std::getline(in, part, '\f');) parts.push_back(part);
  EXPECT_EQ(parts[0], "400");
  EXPECT_EQ(parts[1], run<AtTlm>({0}).checks);
  EXPECT_THAT(parts[2], HasSubstr("OWNERSHIP_SYNC_WINDOW 10 10 "));
  EXPECT_EQ(parts[3], parts[1]);
  EXPECT_GT(std::stoi(parts[4]), 1000);
  EXPECT_THAT(parts[5], HasSubstr("wrong.chip"));
}

TEST(ChipRecorder, EndsWithItsChipAndLeavesAChipThatLivesOn) {
  const std::string told = in_a_process_of_its_own([] {
    set_resolution();
    collect_reports();
    tlm::tlm_global_quantum::instance().set(sc_time(10, sc_core::SC_US));
    RecorderOptions options;
    options.log = folder("ends") + "run.log";
    auto platform = std::make_unique<AtTlm>(Case{});
    ChipRecorder recorder;
    auto brief = std::make_unique<ChipRecorder>(options);
    recorder.attach(platform->chip), brief->attach(platform->chip);
    sc_core::sc_start(200, sc_core::SC_US);
    brief.reset();  // completes its file
    const int before = platform->initiator.accesses;
    sc_core::sc_start(200, sc_core::SC_US);
    const bool goes_on = platform->initiator.accesses > before;
    platform.reset();
    recorder.finish();
    return std::to_string(goes_on) + std::to_string(size_of(options.log) > 0) + "\f" + text_of(recorder);
  });
  EXPECT_EQ(told.substr(0, 3), "11\f");
  EXPECT_EQ(told.substr(3), run<AtTlm>({0}).checks);
}

/// Throws at each third call.
template <class T>
struct Thrower : tlm::tlm_analysis_if<T> {
  int calls = 0;
  void write(const T& /*what*/) override {
    if (++calls % 3 == 0) throw std::runtime_error("from a listener");
  }
};

TEST(ChipRecorder, IsToldWhateverAnotherListenerThrows) {
  const auto told = [](double quantum_us) {
    return in_a_process_of_its_own([=] {
      set_resolution();
      collect_reports();
      tlm::tlm_global_quantum::instance().set(sc_time(quantum_us, sc_core::SC_US));
      AtTlm platform(Case{});
      platform.initiator.fails = true;  // a transaction that throws has no response
      Thrower<systemc::AccessReport> accesses;
      platform.chip.accesses.bind(accesses);
      ChipRecorder recorder;
      recorder.attach(platform.chip);
      sc_core::sc_start(400, sc_core::SC_US);
      recorder.finish();
      return std::to_string(platform.initiator.thrown) + "\f" + std::to_string(recorder.accesses()) + "\f" +
             text_of(recorder);
    });
  };
  const std::string decoupled = told(10);
  EXPECT_THAT(decoupled, testing::StartsWith("133\f400\f"));
  EXPECT_THAT(decoupled, HasSubstr("OWNERSHIP_NOT_OWNER 400 0 "));
  EXPECT_THAT(told(0), testing::StartsWith("133\f400\f"));
}

}  // namespace dsdpv1
