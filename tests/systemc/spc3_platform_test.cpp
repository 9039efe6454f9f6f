// A user CPU at the SPC3 family's socket, and a station on its line: accesses, pins and characters are those of the
// core alone, at the same ticks with any quantum and resolution.
#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/tlm_quantumkeeper.h>
#include <systemc>

#include <algorithm>
#include <sstream>

#include "tests/systemc/own_process.hpp"
#include "tests/systemc/spc3_initiator.hpp"

namespace dsdpv1 {

using systemc::BusCharacter;

namespace {

constexpr Tick kBit = 1000;  // 12 Mbit/s
constexpr int kTelegrams = 8;
constexpr std::uint8_t kSlave = 9;
constexpr std::uint16_t kBaudDetect = 0x0004;

/// An access of one byte at its end.
struct Access {
  Tick at;
  bool write;
  spc3::Address address;
  std::uint8_t value;
};

/// A user CPU that starts the chip and polls it with a quantum, and a station that asks for its FDL status.
struct Platform : sc_core::sc_module, tlm::tlm_analysis_if<BusCharacter> {
  Spc3TlmModule chip{"chip"};
  Initiator cpu{"cpu"};
  sc_core::sc_signal<bool> reset{"reset", true}, x_int{"x_int"};
  sc_core::sc_export<tlm::tlm_analysis_if<BusCharacter>> heard{"heard"};
  tlm_utils::tlm_quantumkeeper time;
  std::vector<Access> accesses;
  std::ostringstream inputs, outputs, signals, bus;
  int ahead = 0, detected = 0;

  explicit Platform(const sc_core::sc_module_name& name) : sc_module(name) {
    cpu.socket.bind(chip.host_socket);
    chip.RESET(reset), chip.X_INT(x_int);
    heard.bind(*this);
    chip.bus_out.bind(heard);
    chip.on_pin = [this](Tick at, spc3::Pin pin, spc3::Level level) {
      (spc3::is_input(pin) ? inputs : outputs) << at << " " << int{spc3::number(pin)} << " " << level << "\n";
    };
    thread([this] { run(); });
    thread([this] { send_others(); });
    method_on(x_int.value_changed_event(), [this] { signals << current_tick() << " " << x_int.read() << "\n"; });
    for (int i = 0; i < kTelegrams; ++i) ask(to_time((200 + 60 * i) * kUs));
  }

  void ask(const sc_time& start) {
    const std::uint8_t telegram[] = {0x10, kSlave, 2, 0x49, 0x54, 0x16};
    for (unsigned i = 0; i < sizeof telegram; ++i)
      requests.push_back({to_time(to_tick(start) + i * 11 * kBit), to_time(kBit), telegram[i]});
  }
  /// Half of them are known in advance; of the others each character when it begins.
  void start_of_simulation() override {
    for (std::size_t i = 0; i < requests.size() / 2; ++i) chip.bus_in->write(requests[i]);
  }
  void send_others() {
    for (std::size_t i = requests.size() / 2; i < requests.size(); ++i) {
      wait_until(to_tick(requests[i].start));
      chip.bus_in->write(requests[i]);
    }
  }
  void write(const BusCharacter& character) override {
    bus << current_tick() << " " << to_tick(character.start) << " " << int{character.data} << "\n";
  }

  void run() {
    wait_until(kUs);
    reset.write(false);
    wait_until(2 * kUs);
    time.reset();
    store(regs::kMode0, {0x00, 0x01});  // DP_Mode
    store(regs::kOrgAddress, {kSlave});
    store(regs::kImr, {0xFF & ~kBaudDetect, 0xFF});
    store(regs::kMode1S, {regs::kMode1Start});
    while (time.get_current_time() < to_time(700 * kUs)) {
      const std::vector<std::uint8_t> seen = load(regs::kIrr, 5);
      if ((seen[2] & kBaudDetect) != 0) {
        ++detected;
        store(regs::kIr, {kBaudDetect});
        store(regs::kMode1S, {regs::kMode1Eoi});
      }
      spend(to_time(300));
    }
    time.sync();
  }

  void store(spc3::Address address, const std::vector<std::uint8_t>& bytes) { transport(true, address, bytes); }
  std::vector<std::uint8_t> load(spc3::Address address, std::size_t count) {
    return transport(false, address, std::vector<std::uint8_t>(count));
  }
  std::vector<std::uint8_t> transport(bool write, spc3::Address address, const std::vector<std::uint8_t>& bytes) {
    const Tick begin = to_tick(time.get_current_time());
    const Outcome done = write ? cpu.write(address, bytes, time.get_local_time())
                               : cpu.read(address, bytes.size(), time.get_local_time());
    time.set(to_time(current_tick() + done.delay_left) - sc_core::sc_time_stamp());
    if (done.took == 0) ++ahead;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      accesses.push_back(
          {begin + static_cast<Tick>(i + 1) * kAccess, write, static_cast<spc3::Address>(address + i), done.data[i]});
    if (time.need_sync()) time.sync();
    return done.data;
  }
  void spend(const sc_time& duration) {
    time.inc(duration);
    if (time.need_sync()) time.sync();
  }

  std::string told() const {
    std::ostringstream out;
    for (const Access& access : accesses)
      out << access.at << " " << access.write << " " << access.address << " " << int{access.value} << "\n";
    return out.str() + "outputs\n" + outputs.str() + "signals\n" + signals.str() + "bus\n" + bus.str();
  }

  std::vector<BusCharacter> requests;
};

/// The output changes of a core alone with the platform's inputs and accesses; a read that is another fails.
std::string outputs_of_the_core(const Platform& platform) {
  std::ostringstream outputs;
  spc3::Chip core;
  core.watch({[](void* self, Tick at, spc3::Pin pin, spc3::Level level) {
                *static_cast<std::ostringstream*>(self) << at << " " << int{spc3::number(pin)} << " " << level << "\n";
              },
              &outputs},
             spc3::kOutputPins);
  std::istringstream inputs(platform.inputs.str());
  Tick at = 0;
  int pin = 0, level = 0;
  bool more = static_cast<bool>(inputs >> at >> pin >> level);
  for (const Access& access : platform.accesses) {
    for (; more && at <= access.at; more = static_cast<bool>(inputs >> at >> pin >> level))
      core.set(at, static_cast<spc3::Pin>(pin), static_cast<spc3::Level>(level));
    core.advance(access.at);
    const std::int64_t cycle = access.at / profibus::kTicksPerCycle;
    if (access.write)
      core.store(cycle, access.address, access.value);
    else if (core.load(cycle, access.address) != access.value)
      return "another value is read at " + std::to_string(access.at);
  }
  return outputs.str();
}

struct Told {
  std::string all, core;
  int ahead = 0, accesses = 0, detected = 0;
};

Told run(double quantum_us, double femtoseconds = 1) {
  const std::string text = in_a_process_of_its_own([=] {
    sc_core::sc_set_time_resolution(femtoseconds, sc_core::SC_FS);
    tlm::tlm_global_quantum::instance().set(sc_time(quantum_us, sc_core::SC_US));
    Platform platform("platform");
    sc_core::sc_start(to_time(720 * kUs));
    std::ostringstream out;
    out << platform.ahead << " " << platform.accesses.size() << " " << platform.detected << "\n";
    const bool same = outputs_of_the_core(platform) == platform.outputs.str();
    return out.str() + (same ? "same" : outputs_of_the_core(platform)) + "\n\n" + platform.told();
  });
  Told told;
  std::istringstream(text) >> told.ahead >> told.accesses >> told.detected;
  const std::size_t core = text.find('\n') + 1, all = text.find("\n\n");
  told.core = text.substr(core, all - core);
  told.all = text.substr(all + 2);
  return told;
}

const Told& coupled() {
  static const Told once = run(0);
  return once;
}

TEST(Spc3Platform, IsAnsweredAndInterrupted) {
  EXPECT_EQ(coupled().detected, 1);
  EXPECT_EQ(coupled().ahead, 0);
  const std::string bus = coupled().all.substr(coupled().all.find("bus\n") + 4);
  EXPECT_EQ(std::count(bus.begin(), bus.end(), '\n'), 6 * (kTelegrams - 1));  // the first ends the search
  const std::string signals = coupled().all.substr(coupled().all.find("signals\n") + 8);
  EXPECT_EQ(std::count(signals.begin(), signals.begin() + static_cast<int>(signals.find("bus")), '\n'), 3);
}

TEST(Spc3Platform, IsTheCoreAlone) { EXPECT_EQ(coupled().core, "same"); }

TEST(Spc3Platform, WithAQuantumEverythingHappensAtTheSameTickAndWithAGreaterOneNoLessRunsAhead) {
  int ahead = 0;
  for (const double quantum_us : {0.5, 10., 1000.}) {
    const Told decoupled = run(quantum_us);
    EXPECT_EQ(first_difference(decoupled.all, coupled().all), "") << quantum_us << " us";
    EXPECT_GE(decoupled.ahead, ahead) << quantum_us << " us";
    ahead = decoupled.ahead;
  }
  EXPECT_GT(ahead * 5, coupled().accesses / 5 * 2);  // most transactions: they have about five bytes
}

TEST(Spc3Platform, AtAPicosecondEverythingHappensAtTheSameTick) {
  EXPECT_EQ(first_difference(run(0, 1000).all, coupled().all), "");
  EXPECT_EQ(first_difference(run(10, 1000).all, coupled().all), "");
}

}  // namespace

void simulate() {}

}  // namespace dsdpv1
