// Habits of platforms around a module and its initiator: the same transactions with each quantum, beside a
// clock, beside another instance, with observers; an initiator that is suspended, reset, or meets an exception.
// docs/systemc.md has the table of modules and tests.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "model/systemc/host_pins.hpp"
#include "model/systemc/host_registers.hpp"
#include "model/systemc/rsu_pins.hpp"
#include "model/systemc/rsu_tlm.hpp"
#include "model/systemc/spc3_tlm.hpp"
#include "registers/spc3_regs.hpp"
#include "tests/systemc/foreign_cpu.hpp"
#include "tests/systemc/own_process.hpp"

namespace dsdpv1 {

using sc_core::sc_time;
using systemc::HostRegisters;
using systemc::to_tick;

namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr sc_dt::uint64 kRegisters = ForeignBus<>::kRegisters;
constexpr int kRounds = 6;

/// A module, its CPU, and the results of the CPU's transactions with their times.
class Bench : public sc_core::sc_module {
 public:
  std::string story;
  int exceptions = 0;
  bool throws = false;  ///< an observer, at its next call that may

  ~Bench() override = default;
  ForeignCpu<>& cpu() { return cpu_; }
  /// A transaction is on its way.
  bool is_busy() const { return busy_; }
  int rounds() const { return rounds_; }
  virtual void observe() = 0;

 protected:
  explicit Bench(const sc_core::sc_module_name& name) : sc_module(name) {}

  virtual void begin() = 0;
  virtual void round(int number) = 0;
  /// A transaction that has an event.
  virtual void provoke() {}

  void send(tlm::tlm_command command, sc_dt::uint64 address, Bytes data) {
    busy_ = true;
    try {
      cpu_.transport(command, address, data.data(), static_cast<unsigned>(data.size()));
    } catch (const std::runtime_error&) {
      ++exceptions;
    }
    busy_ = false;
    story += std::to_string(to_tick(cpu_.now())) + " " + std::to_string(cpu_.response);
    for (const std::uint8_t byte : data) story += " " + std::to_string(byte);
    story += "\n";
  }
  void write(sc_dt::uint64 address, const Bytes& data) { send(tlm::TLM_WRITE_COMMAND, address, data); }
  void read(sc_dt::uint64 address, std::size_t size) { send(tlm::TLM_READ_COMMAND, address, Bytes(size, 0xEE)); }
  /// `in_transactions`: its pins change in transactions only.
  template <class Module>
  void observe(Module& chip, bool in_transactions = false) {
    chip.on_event = [this](const profibus::Event&) { shout(); };
    chip.on_pin = [this, in_transactions](Tick, auto, auto) {
      if (in_transactions) shout();
    };
  }

 private:
  void shout() {
    if (std::exchange(throws, false)) throw std::runtime_error("of an observer");
  }
  void run() {
    busy_ = false;
    begin();
    for (int i = 0; i < kRounds; ++i, ++rounds_) {
      if (throws) provoke();
      round(i);
    }
  }

  bool busy_ = false;
  int rounds_ = 0;
  ForeignCpu<> cpu_{"cpu", [this](ForeignCpu<>&) { run(); }};
};

/// The parallel port, with the handshake as registers.
class ParallelBench : public Bench {
 protected:
  explicit ParallelBench(const sc_core::sc_module_name& name) : Bench(name) {
    cpu().socket.bind(bus.socket);
    bus.registers.bind(registers.socket);
  }
  void begin() override {
    cpu().pass(kUs);
    write(kRegisters + HostRegisters::kRequest, {0});
    write(kRegisters + HostRegisters::kReset, {1});
    cpu().pass(200 * kUs);
  }
  void round(int number) override {
    write(kRegisters + HostRegisters::kRequest, {HostRegisters::kReq});
    cpu().pass(3 * kUs);
    write(kRegisters + HostRegisters::kRequest, {HostRegisters::kReq | HostRegisters::kSta});
    cpu().pass(kUs);
    write(0x130, {1, 2, 3, static_cast<std::uint8_t>(number), 5, 6, 7, 8});
    cpu().pass(kUs);
    read(0x130, 8);
    read(0x800, 1);
    write(kRegisters + HostRegisters::kRequest, {0});
    cpu().pass(2 * kUs);
  }
  void provoke() override { write(0x130, {0}); }  // without the DPRAM

  ForeignBus<> bus{"bus"};
  HostRegisters registers{"registers", {kRegisters}};
};

struct TlmBench : ParallelBench {
  systemc::TlmModule chip{"chip", options()};

  explicit TlmBench(const sc_core::sc_module_name& name) : ParallelBench(name) {
    bus.chip.bind(chip.host_socket);
    registers.connect(chip);
  }
  static systemc::TlmOptions options() {
    systemc::TlmOptions options;
    options.observed = kOutputPins & ~mask(Pin::kDOut);
    return options;
  }
  void observe() override { Bench::observe(chip); }
};

/// `Module`: PinModule or RsuPinModule.
template <class Module>
struct PinsBench : ParallelBench {
  sc_core::sc_signal<sc_dt::sc_uint<11>> a{"a"};
  sc_core::sc_signal_rv<8> d{"d"};
  sc_core::sc_signal<bool> csr{"csr"}, rd{"rd"}, wr{"wr"}, high{"high", true};
  systemc::HostPins host{"host"};
  Module chip{"chip"};

  explicit PinsBench(const sc_core::sc_module_name& name) : ParallelBench(name) {
    bus.chip.bind(host.socket);
    registers.connect(chip);
    host.A(a), host.D(d), host.CSR(csr), host.RD(rd), host.WR(wr);
    chip.A(a), chip.D(d), chip.CSR(csr), chip.RD(rd), chip.WR(wr), chip.PBRXD(high);
  }
  void observe() override { Bench::observe(chip); }
};

struct RsuPinsBench : PinsBench<systemc::RsuPinModule> {
  sc_core::sc_signal<bool> low{"low"};
  sc_core::sc_signal<sc_dt::sc_uint<2>> mode{"mode"}, adr{"adr"};
  sc_core::sc_signal<sc_dt::sc_uint<3>> ubr{"ubr"}, uiv{"uiv"};
  sc_core::sc_signal_resolved miso{"miso"};

  explicit RsuPinsBench(const sc_core::sc_module_name& name) : PinsBench(name) {
    chip.XSS(high), chip.SCK(low), chip.MOSI(low), chip.MISO(miso), chip.RXD(high);
    chip.MODE(mode), chip.ADR(adr), chip.UBR(ubr), chip.UIV(uiv);
  }
};

template <HostMode kMode>
struct RsuBench : Bench {
  systemc::RsuTlmModule chip{"chip", options()};
  sc_core::sc_signal<bool> reset{"reset"}, low{"low"};

  explicit RsuBench(const sc_core::sc_module_name& name) : Bench(name) {
    cpu().socket.bind(kMode == HostMode::kSpi ? chip.spi_socket : chip.uart_socket);
    chip.RESET(reset), chip.R_REQ(low), chip.R_STA(low);
  }
  static systemc::RsuTlmOptions options() {
    systemc::RsuTlmOptions options;
    options.straps.mode = kMode;
    return options;
  }
  void observe() override { Bench::observe(chip, true); }
  void begin() override {
    cpu().pass(kUs);
    reset.write(true);
    cpu().pass(200 * kUs);
  }
  void round(int /*number*/) override {
    const Bytes request = {0x01, 0x00, 0x14, 0x01, 0x18, 0xCF};  // B014, with room for the reply
    Bytes frame = request;
    frame.resize(request.size() + 5, 0xFF);
    if (kMode == HostMode::kSpi)
      send(tlm::TLM_READ_COMMAND, 0, frame);
    else
      write(0, request);
    write(1, {0});  // no such address
    cpu().pass(50 * kUs);
  }
};

struct Spc3Bench : Bench {
  systemc::Spc3TlmModule chip{"chip"};
  sc_core::sc_signal<bool> reset{"reset", true};

  explicit Spc3Bench(const sc_core::sc_module_name& name) : Bench(name) {
    cpu().socket.bind(chip.host_socket);
    chip.RESET(reset);
  }
  void observe() override { Bench::observe(chip); }
  void begin() override {
    cpu().pass(kUs);
    reset.write(false);
    cpu().pass(10 * kUs);
    write(spc3::regs::kOrgAddress, {9});
    write(spc3::regs::kMode0 + 1, {1});
  }
  void round(int number) override {
    write(0x200, {1, 2, static_cast<std::uint8_t>(number), 4});
    read(0x201, 2);
    read(0x200, 4);
    read(0x1000, 1);
    cpu().pass(kUs);
  }
  void provoke() override { read(0x700, 1); }  // beyond the RAM
};

// --- the runs --------------------------------------------------------------------------------------------------------

/// The surroundings of a module.
struct Around {
  double quantum_us = 0;
  bool clock = false, another = false, observers = false;
};

constexpr double kEndUs = 3000;

template <class Module>
std::string run(const Around& around) {
  return in_a_process_of_its_own([&] {
    set_resolution();
    collect_reports();
    tlm::tlm_global_quantum::instance().set(sc_time(around.quantum_us, sc_core::SC_US));
    Module module("module");
    std::unique_ptr<Module> another;
    std::unique_ptr<sc_core::sc_clock> clock;
    if (around.observers) module.observe();
    if (around.another) another = std::make_unique<Module>("another");
    if (around.clock) clock = std::make_unique<sc_core::sc_clock>("clock", sc_time(13, sc_core::SC_NS));
    sc_core::sc_start(kEndUs, sc_core::SC_US);
    if (another && another->story != module.story) return std::string("another story");
    return module.story + std::to_string(module.rounds()) + " rounds, " + std::to_string(reports().size()) + " reports";
  });
}

enum class Trouble { kSuspended, kReset, kThrown };

/// In the middle of the transactions of the third round.
template <class Module>
std::string run_with(Trouble trouble) {
  return in_a_process_of_its_own([=] {
    set_resolution();
    collect_reports();
    Module module("module");
    module.observe();
    sc_core::sc_process_handle process;
    thread([&] {
      process =
          sc_core::sc_process_handle(dynamic_cast<sc_core::sc_object*>(sc_core::sc_find_object("module.cpu.run")));
      while (module.rounds() < 2 || !module.is_busy()) sc_core::wait(10, sc_core::SC_NS);
      if (trouble == Trouble::kThrown) {
        module.throws = true;
      } else if (trouble == Trouble::kReset) {
        process.reset();
      } else {
        process.suspend();
        sc_core::wait(50, sc_core::SC_US);
        process.resume();
      }
    });
    std::string left;
    try {
      sc_core::sc_start(2 * kEndUs, sc_core::SC_US);
    } catch (const std::exception& error) {  // SystemC's report of it
      left = std::string("left sc_start: ") + error.what();
    }
    return module.story + std::to_string(module.rounds()) + " rounds, " + std::to_string(module.exceptions) +
           " exceptions\n" + left;
  });
}

/// The last round of a story: responses and bytes without their times; of a serial port, whose replies count the
/// requests, responses only.
std::string last_round(const std::string& story, int lines, bool serial) {
  std::vector<std::string> all;
  std::istringstream in(story);
  for (std::string line; std::getline(in, line);)
    if (line.find(" rounds, ") == std::string::npos && line.find(' ') != std::string::npos)
      all.push_back(serial ? line.substr(0, line.find(' ', line.find(' ') + 1)).substr(line.find(' ')) + "\n"
                           : line.substr(line.find(' ')) + "\n");
  std::string last;
  for (std::size_t i = all.size() - static_cast<std::size_t>(lines); i < all.size(); ++i) last += all[i];
  return last;
}

template <class Module>
class Citizen : public testing::Test {
 protected:
  static const std::string& alone() {
    static const std::string story = run<Module>({});
    return story;
  }
  static void expect_same(const Around& around) {
    EXPECT_EQ(first_difference(run<Module>(around), alone()), "") << around.quantum_us;
  }
  static void expect_last_round(const std::string& story) {
    constexpr bool kIsSerial = !kIsParallel && !std::is_same_v<Module, Spc3Bench>;
    EXPECT_EQ(last_round(story, kLines, kIsSerial), last_round(alone(), kLines, kIsSerial));
  }
  static constexpr bool kByPins =
      std::is_same_v<Module, PinsBench<systemc::PinModule>> || std::is_same_v<Module, RsuPinsBench>;
  static constexpr bool kIsParallel = std::is_base_of_v<ParallelBench, Module>;
  static constexpr int kLines = kIsParallel                         ? 6
                                : std::is_same_v<Module, Spc3Bench> ? 4
                                                                    : 2;  ///< transactions of a round
};

using Modules = testing::Types<PinsBench<systemc::PinModule>, TlmBench, RsuPinsBench, RsuBench<HostMode::kSpi>,
                               RsuBench<HostMode::kUart>, Spc3Bench>;
struct Names {
  template <class Module>
  static std::string GetName(int index) {
    static const char* const names[] = {"PinModule", "TlmModule", "RsuPinModule", "RsuSpi", "RsuUart", "Spc3TlmModule"};
    return names[index];
  }
};
TYPED_TEST_SUITE(Citizen, Modules, Names);

TYPED_TEST(Citizen, CompletesItsTransactions) {
  EXPECT_THAT(this->alone(), testing::HasSubstr(std::to_string(kRounds) + " rounds, 0 reports"));
  EXPECT_THAT(this->alone(), testing::HasSubstr(" " + std::to_string(tlm::TLM_ADDRESS_ERROR_RESPONSE) + " "));
}

TYPED_TEST(Citizen, IsTheSameWithEachQuantum) {
  for (const double quantum_us : {1., 10., 100.}) this->expect_same({quantum_us});
}

TYPED_TEST(Citizen, IsTheSameBesideAClock) {
  this->expect_same({0, true});
  this->expect_same({10, true});
}

TYPED_TEST(Citizen, IsTheSameBesideAnotherInstance) {
  this->expect_same({0, false, true});
  this->expect_same({10, false, true});
}

TYPED_TEST(Citizen, IsTheSameWithObservers) {
  this->expect_same({0, false, false, true});
  this->expect_same({10, false, false, true});
}

TYPED_TEST(Citizen, CompletesATransactionWhoseInitiatorWasSuspended) {
  const std::string story = run_with<TypeParam>(Trouble::kSuspended);
  EXPECT_THAT(story, testing::HasSubstr(std::to_string(kRounds) + " rounds, 0 exceptions"));
  this->expect_last_round(story);
}

TYPED_TEST(Citizen, ServesAnInitiatorThatWasResetInATransaction) {
  const std::string story = run_with<TypeParam>(Trouble::kReset);
  EXPECT_THAT(story, testing::HasSubstr(std::to_string(kRounds + 2) + " rounds, 0 exceptions"));  // two before
  this->expect_last_round(story);
}

TYPED_TEST(Citizen, ServesAnInitiatorAfterAnExceptionOfAnObserver) {
  const std::string story = run_with<TypeParam>(Trouble::kThrown);
  if (this->kByPins) {  // the module's own process moves the pins
    EXPECT_THAT(story, testing::HasSubstr("left sc_start: "));
    return;
  }
  EXPECT_THAT(story, testing::HasSubstr(std::to_string(kRounds) + " rounds, 1 exceptions"));
  this->expect_last_round(story);
}

}  // namespace

void simulate() {}

}  // namespace dsdpv1
