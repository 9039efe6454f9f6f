// A run of the bench, and its accesses, handshake and line again at the modules by a foreign initiator: ChipRecorder
// finds what the bench has found, with the same margins, at the pins and at the socket with any quantum.
#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>

#include <algorithm>
#include <map>
#include <memory>
#include <sstream>

#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/systemc/chip_recorder.hpp"
#include "model/systemc/host_pins.hpp"
#include "tb/bench/bench.hpp"
#include "tests/systemc/bench.hpp"
#include "tests/systemc/own_process.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::ChipRecorder;
using dsdpv1::systemc::current_tick;
using dsdpv1::systemc::to_time;

namespace {

struct Access {
  Tick begin = 0;
  bool write = false;
  std::uint16_t address = 0;
  std::uint8_t value = 0;
  AccessTiming timing;
};

/// The user's and the line's part of a run: accesses, and changes of the other inputs.
class Play : public tb::Observer {
 public:
  std::vector<Access> accesses;
  Changes handshake, line;

  void pin(std::size_t /*slave*/, tb::Tick at, tb::PinNumber number, tb::Level level) override {
    const auto pin = static_cast<Pin>(number);
    if (!is_input(pin)) return;
    if (pin == Pin::kPbrxd) return line.push_back({at, pin, level});
    if (pin == Pin::kReset || pin == Pin::kRReq || pin == Pin::kRSta) return handshake.push_back({at, pin, level});
    edges_.push_back({at, pin, level});
    if (pin == Pin::kA && level == HostAccess::kIdleAddress) address_ends_ = true;
    if (address_ends_ && is_idle()) end_access();
  }
  void read(std::size_t /*slave*/, tb::Tick sample) override { sample_ = sample; }

 private:
  Level last(Pin pin, Level otherwise) const {
    const auto found =
        std::find_if(edges_.rbegin(), edges_.rend(), [&](const Change& each) { return each.pin == pin; });
    return found == edges_.rend() ? otherwise : found->level;
  }
  bool is_idle() const {
    return last(Pin::kCsr, 1) == 1 && last(Pin::kRd, 1) == 1 && last(Pin::kWr, 1) == 1 &&
           last(Pin::kDIn, kLevelZ) == kLevelZ;
  }
  Tick when(Pin pin, bool end) const {
    const Changes all = only(edges_, pin);
    return end ? all.back().at : all.front().at;
  }
  void end_access() {
    Access access;
    access.write = !only(edges_, Pin::kWr).empty();
    const Pin strobe = access.write ? Pin::kWr : Pin::kRd;
    access.begin = edges_.front().at;
    access.address = static_cast<std::uint16_t>(only(edges_, Pin::kA).front().level);
    AccessTiming& timing = access.timing;
    timing.address_setup = when(strobe, false) - when(Pin::kA, false);
    timing.cs_lead = when(strobe, false) - when(Pin::kCsr, false);
    timing.address_hold = when(Pin::kA, true) - when(strobe, true);
    timing.cs_trail = when(Pin::kCsr, true) - when(strobe, true);
    timing.rd_low = timing.wr_low = when(strobe, true) - when(strobe, false);
    timing.recovery = 0;
    if (access.write) {
      access.value = static_cast<std::uint8_t>(only(edges_, Pin::kDIn).front().level);
      timing.data_setup = when(strobe, true) - when(Pin::kDIn, false);
      timing.data_hold = when(Pin::kDIn, true) - when(strobe, true);
    } else {
      timing.rd_sample = sample_ - when(strobe, false);
    }
    accesses.push_back(access);
    edges_.clear();
    address_ends_ = false;
  }

  Changes edges_;  ///< of the running access
  bool address_ends_ = false;
  Tick sample_ = 0;
};

// --- the bench -------------------------------------------------------------------------------------------------------

const tb::scenario::Scenario& scenario() {
  static const tb::scenario::Scenario once = tb::scenario::parse(R"(
name: Power-on to data exchange
baud: 3M
end: 20ms
slaves:
  - name: demo
    address: 5
    gsd: dsdpv1.gsd
    modules: ["8 bytes in, 8 bytes out"]
    init: {prm_mode: 2, cfg_mode: 2}
    user_cpu: {behaviour: loop_back, cycle: 40us}
    release_reset: 20us
masters:
  - name: plc
    address: 2
    start: 500us
    bus: {min_slave_interval: 0}
    slaves: [{slave: demo, outputs: "01 02 03 04 05 06 07 08"}]
)",
                                                                 DSDPV1_SOURCE_DIR "/scenarios/recorder.yaml");
  return once;
}

std::string line_of(const checks::Rule& rule, const checks::Record& record) {
  std::ostringstream text;
  const auto number = [](const std::optional<Tick>& value) { return value ? std::to_string(*value) : "-"; };
  text << rule.id << " " << record.count << " " << record.violations << " " << number(record.worst_margin) << " "
       << number(record.worst_value) << " " << number(record.at) << "\n";
  return text.str();
}

struct Judged {
  Play play;
  std::string checks;
  std::uint64_t telegrams = 0, violations = 0;
};

const Judged& bench() {
  static Judged once;
  if (!once.checks.empty()) return once;
  tb::RunOptions options;
  options.observers = {&once.play};
  const tb::RunResult result =
      tb::Bench(scenario(), options, tb::make_pin_execution()).run([](tb::Tick) { return true; });
  for (const tb::CheckResult& each : result.checks)
    if (std::string(each.rule->id) != "LOOK_IN_WINDOW") once.checks += line_of(*each.rule, each.record);
  once.telegrams = result.telegrams;
  once.violations = result.violations;
  return once;
}

// --- the platform ----------------------------------------------------------------------------------------------------

/// Plays a run: accesses at their times, decoupled, and synchronised before it moves a pin.
struct Player : sc_core::sc_module {
  tlm_utils::simple_initiator_socket<Player> socket{"socket"};
  sc_core::sc_signal<bool> reset{"reset"}, r_req{"r_req"}, r_sta{"r_sta"}, pbrxd{"pbrxd", true};
  int ahead = 0;

  Player(const sc_core::sc_module_name& name, const Play& play) : sc_module(name) {
    thread([this, &play] { run(play); });
    thread([this, &play] {
      for (const Change& each : play.line) wait_until(each.at), pbrxd.write(each.level != 0);
    });
  }

 private:
  void run(const Play& play) {
    const sc_core::sc_time quantum = tlm::tlm_global_quantum::instance().get();
    auto pin = play.handshake.begin();
    for (const Access& access : play.accesses) {
      for (; pin != play.handshake.end() && pin->at <= access.begin; ++pin) move(*pin);
      if (to_time(access.begin) - sc_core::sc_time_stamp() > quantum) wait_until(access.begin);
      transport(access);
    }
    for (; pin != play.handshake.end(); ++pin) move(*pin);
  }
  void move(const Change& change) {
    wait_until(change.at);
    (change.pin == Pin::kReset ? reset : change.pin == Pin::kRReq ? r_req : r_sta).write(change.level != 0);
  }
  void transport(const Access& access) {
    tlm::tlm_generic_payload payload;
    auto* timing = new systemc::AccessTimingExtension;  // owned by the payload
    timing->timing = access.timing;
    payload.set_extension(timing);
    std::uint8_t byte = access.value;
    payload.set_command(access.write ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND);
    payload.set_address(access.address);
    payload.set_data_ptr(&byte);
    payload.set_data_length(1);
    payload.set_streaming_width(1);
    const sc_core::sc_time before = sc_core::sc_time_stamp();
    sc_core::sc_time delay = to_time(access.begin) - before;
    socket->b_transport(payload, delay);
    if (sc_core::sc_time_stamp() == before) ++ahead;
  }
};

Config config() { return static_cast<const tb::Dsdpv1Settings&>(*scenario().slaves.front().chip); }

struct AtSocket {
  Player player;
  systemc::TlmModule chip{"chip", options()};
  explicit AtSocket(const Play& play) : player("player", play) {
    player.socket.bind(chip.host_socket);
    chip.RESET(player.reset), chip.R_REQ(player.r_req), chip.R_STA(player.r_sta), chip.PBRXD(player.pbrxd);
  }
  static systemc::TlmOptions options() {
    systemc::TlmOptions options;
    options.chip = config();
    return options;
  }
};

struct AtPins {
  Player player;
  systemc::PinModule chip{"chip", options()};
  systemc::HostPins host{"host"};
  sc_core::sc_signal<sc_dt::sc_uint<11>> a;
  sc_core::sc_signal_rv<8> d;
  sc_core::sc_signal<bool> csr, rd, wr, l_req, l_sta, intr0, pbtxd, pbrts, pbf, br, ready;
  explicit AtPins(const Play& play) : player("player", play) {
    player.socket.bind(host.socket);
    chip.RESET(player.reset), chip.R_REQ(player.r_req), chip.R_STA(player.r_sta), chip.PBRXD(player.pbrxd);
    chip.A(a), chip.D(d), chip.CSR(csr), chip.RD(rd), chip.WR(wr), chip.L_REQ(l_req), chip.L_STA(l_sta);
    chip.INTR0(intr0), chip.PBTXD(pbtxd), chip.PBRTS(pbrts), chip.PBF(pbf), chip.BR(br), chip.READY(ready);
    host.A(a), host.D(d), host.CSR(csr), host.RD(rd), host.WR(wr);
  }
  static systemc::PinOptions options() {
    systemc::PinOptions options;
    options.chip = config();
    return options;
  }
};

template <class Platform>
std::string recorded(double quantum_us, const std::string& baud = "3M") {
  return in_a_process_of_its_own([&] {
    set_resolution();
    collect_reports();
    tlm::tlm_global_quantum::instance().set(sc_core::sc_time(quantum_us, sc_core::SC_US));
    Platform platform(bench().play);
    systemc::RecorderOptions options;
    options.baud = baud;
    ChipRecorder recorder(options);
    recorder.attach(platform.chip);
    sc_core::sc_start(to_time(scenario().end + 1));
    recorder.finish();
    std::string told;
    for (const tb::CheckResult& each : recorder.result().checks) told += line_of(*each.rule, each.record);
    return told + std::to_string(recorder.result().telegrams) + " telegrams, " +
           std::to_string(recorder.result().violations) + " violations, " +
           (platform.player.ahead != 0 ? "ahead" : "not ahead");
  });
}

std::string of_bench(const char* ahead) {
  return bench().checks + std::to_string(bench().telegrams) + " telegrams, " + std::to_string(bench().violations) +
         " violations, " + ahead;
}

std::string without_tw(const std::string& text) {
  const std::size_t at = text.find("TIMING_TW");
  return text.substr(0, at) + text.substr(text.find('\n', at));
}

}  // namespace

void simulate() {}

TEST(RecorderAndBench, FindTheSameAtTheSocketWithAnyQuantum) {
  EXPECT_GT(bench().play.accesses.size(), 1000U);
  EXPECT_GT(bench().telegrams, 50U);
  EXPECT_EQ(first_difference(recorded<AtSocket>(0), of_bench("not ahead")), "");
  for (const double quantum_us : {1., 10., 100.})
    EXPECT_EQ(first_difference(recorded<AtSocket>(quantum_us), of_bench("ahead")), "") << quantum_us;
}

TEST(RecorderAndBench, FindTheSameAtThePins) {
  EXPECT_EQ(first_difference(without_tw(recorded<AtPins>(0)), without_tw(of_bench("not ahead"))), "");
}

TEST(RecorderAndBench, WithoutARateTheLineIsReadFromWhenTheChipHasFoundIt) {
  const std::string told = recorded<AtSocket>(10, "");
  EXPECT_NE(told.find(" 0 violations"), std::string::npos) << told;
  EXPECT_NE(told.find("HOLD_INTERVAL"), std::string::npos) << told;
}

}  // namespace dsdpv1
