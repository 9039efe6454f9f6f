// Saved modules continue in another simulation, at another time of the kernel: the same pins, events, characters and
// bytes read, at the same ticks of the chip.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <sstream>
#include <string>

#include "model/systemc/host_registers.hpp"
#include "tests/systemc/foreign_cpu.hpp"
#include "tests/systemc/own_process.hpp"
#include "tests/systemc/platform.hpp"
#include "tests/systemc/rsu_board.hpp"
#include "tests/systemc/spc3_board.hpp"
#include "tests/systemc/spc3_initiator.hpp"

namespace dsdpv1 {

using platform::Platform;
using profibus::StateError;
using sc_core::sc_time;
using systemc::BusCharacter;
using testing::HasSubstr;
using State = std::vector<std::uint8_t>;

namespace {

// --- a bench that begins at any tick ---------------------------------------------------------------------------------

constexpr Tick kBegin = -1;

/// Pins, events and more of a module, with the chip's tick of each line.
class Story {
 public:
  template <class Module>
  void listen(Module& chip) {
    chip.on_pin = [this](Tick at, auto pin, auto level) { say(at) << "pin " << int(pin) << " " << level << "\n"; };
    chip.on_event = [this](const profibus::Event& event) { say(event.at) << profibus::code(event.reason) << "\n"; };
  }
  std::ostream& say(Tick at) { return text_ << at << " "; }
  void forget() { text_.str(""); }
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

/// The lines after a tick, in order of time.
std::string after(const std::string& story, Tick tick) {
  std::istringstream in(story);
  std::multimap<Tick, std::string> lines;
  for (std::string line; std::getline(in, line);)
    if (const Tick at = std::stoll(line); at > tick) lines.emplace(at, line + "\n");
  std::string rest;
  for (const auto& [at, line] : lines) rest += line;
  return rest;
}

std::string hex(const State& state) {
  std::string text;
  for (const std::uint8_t byte : state) text += {"0123456789abcdef"[byte >> 4], "0123456789abcdef"[byte & 15]};
  return text;
}
State bytes(const std::string& hex) {
  State state;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    state.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return state;
}

struct Whole {
  std::string story;
  std::map<Tick, std::string> states;  ///< as hexadecimal text, or why there is none
};

/// The whole run of a bench, saved at these ticks.
template <class Bench>
Whole run_whole(const std::vector<Tick>& times, Tick end) {
  const std::string text = in_a_process_of_its_own([&] {
    set_resolution();
    collect_reports();
    Bench bench(kBegin, 0);
    std::string states;
    thread([&] {
      for (const Tick time : times) {
        wait_until(time);
        try {
          states += std::to_string(time) + " " + hex(bench.chip.save()) + "\n";
        } catch (const StateError& error) {
          states += std::to_string(time) + " " + error.what() + "\n";
        }
      }
    });
    sc_core::sc_start(systemc::to_time(end));
    return states + "\n" + bench.story.text();
  });
  Whole whole;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line) && !line.empty();)
    whole.states[std::stoll(line)] = line.substr(line.find(' ') + 1);
  whole.story = text.substr(text.find("\n\n") + 2);
  return whole;
}

/// The rest of the run, in a new simulation that begins some nanoseconds before.
template <class Bench>
std::string run_rest(const State& state, Tick from, Tick end) {
  return in_a_process_of_its_own([&] {
    set_resolution();
    collect_reports();
    const Tick begin = 2500 + from % 250;  // the same phase of CLK
    Bench bench(from, begin - from);
    sc_core::sc_start(systemc::to_time(begin));
    bench.chip.restore(state);
    bench.story.forget();
    sc_core::sc_start(systemc::to_time(end + begin - from) - sc_core::sc_time_stamp());
    return bench.story.text();
  });
}

/// `least`: so many of the times are not in an access.
template <class Bench>
void expect_the_same(const std::vector<Tick>& times, Tick end, int least) {
  const Whole whole = run_whole<Bench>(times, end);
  EXPECT_EQ(first_difference(run_whole<Bench>({}, end).story, whole.story), "");  // a save changes nothing
  int saved = 0;
  for (const auto& [from, state] : whole.states) {
    if (state.find("not saved, because an access is in progress") != std::string::npos) continue;
    ++saved;
    const std::string rest = after(whole.story, from);
    EXPECT_EQ(first_difference(after(run_rest<Bench>(bytes(state), from, end), from), rest), "") << "from " << from;
    EXPECT_GT(rest.size(), 1000U);
  }
  EXPECT_GE(saved, least);
}

// --- the DSDPV1 ------------------------------------------------------------------------------------------------------

/// The pins of a platform from power-on to data exchange.
const Changes& recorded() {
  static const Changes all = [] {
    std::istringstream in(in_a_process_of_its_own([] {
      set_resolution();
      Platform platform(false, kOutputPins | systemc::kHostPins | mask(Pin::kPbrxd));
      std::string text;
      platform.chip.on_pin = [&](Tick at, Pin pin, Level level) {
        text += std::to_string(at) + " " + std::to_string(int(pin)) + " " + std::to_string(level) + "\n";
      };
      sc_core::sc_start(systemc::to_time(platform::kEnd));
      return text;
    }));
    Changes changes;
    for (int pin = 0, level = 0, at = 0; in >> at >> pin >> level;)
      changes.push_back({at, static_cast<Pin>(pin), static_cast<Level>(level)});
    return changes;
  }();
  return all;
}

template <bool kWithClk>
struct Pins : PinBench {
  Story story;
  sc_core::sc_signal<bool> clk;

  Pins(Tick from, Tick shift) : PinBench("chip") {
    story.listen(chip);
    if (kWithClk) chip.CLK(clk), thread([this] { run_clk(); });
    thread([this, from, shift] {
      for (const Change& each : recorded()) {
        if (!is_input(each.pin)) continue;
        if (each.at > from) wait_until(each.at + shift);
        drive(each.pin, each.level);
      }
    });
  }
  void run_clk() {
    for (Tick edge = 0;; edge += 250) {
      wait_until(edge);
      clk.write(true);
      wait_until(edge + 125);
      clk.write(false);
    }
  }
};

/// In the requests, the answers and between them; one a microsecond after power-on.
std::vector<Tick> times_of_platform(int every = 1) {
  std::vector<Tick> times = {2 * kUs + 7};
  for (int i = 0; i < platform::kExchanges + 7; i += every)
    times.push_back(platform::kBusBegins + i * platform::kBetween + 2 * kUs + i * 37'339 % (45 * kUs) + 11);
  return times;
}

TEST(SavedPinModule, ContinuesWithTheSamePinsAndEvents) {
  expect_the_same<Pins<false>>(times_of_platform(), platform::kEnd, 20);
}

TEST(SavedPinModule, ContinuesWithAClk) { expect_the_same<Pins<true>>(times_of_platform(5), platform::kEnd, 5); }

/// Transactions, wires and telegrams of the platform.
template <bool kRuns>
struct Tlm : tlm::tlm_analysis_if<BusCharacter> {
  Story story;
  systemc::TlmModule chip{"chip", options()};
  sc_core::sc_signal<bool> reset, r_req, r_sta;
  ForeignCpu<> cpu;

  Tlm(Tick from, Tick shift) : cpu("cpu", [this, from, shift](ForeignCpu<>&) { access(from, shift); }) {
    cpu.socket.bind(chip.host_socket);
    chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(r_sta);
    chip.bus_out.bind(*this);
    story.listen(chip);
    thread([this, from, shift] { move_wires(from, shift); });
    thread([this, from, shift] { ask(from, shift); });
  }

 private:
  static systemc::TlmOptions options() {
    systemc::TlmOptions options;
    options.observed = mask(Pin::kPbrts) | mask(Pin::kReady);
    if (!kRuns) options.observed |= kOutputPins | mask(Pin::kPbrxd) | systemc::kHostPins;
    return options;
  }
  void move_wires(Tick from, Tick shift) {
    for (const Change& each : recorded()) {
      if (each.pin != Pin::kReset && each.pin != Pin::kRReq && each.pin != Pin::kRSta) continue;
      if (each.at > from) wait_until(each.at + shift);
      (each.pin == Pin::kReset ? reset : each.pin == Pin::kRReq ? r_req : r_sta).write(each.level != 0);
    }
  }
  void access(Tick from, Tick shift) {
    const AccessTiming timing;
    std::uint8_t value = 0;
    sc_dt::uint64 address = 0;
    for (const Change& each : recorded()) {
      if (each.pin == Pin::kA) address = static_cast<sc_dt::uint64>(each.level);
      if (each.pin == Pin::kDIn && each.level >= 0) value = static_cast<std::uint8_t>(each.level);
      if ((each.pin != Pin::kRd && each.pin != Pin::kWr) || each.level != 0) continue;
      const Tick begin = each.at - timing.address_setup;
      if (begin <= from) continue;
      wait_until(begin + shift);
      if (each.pin == Pin::kWr)
        cpu.write(address, value);
      else
        story.say(begin) << "read " << address << " " << int{cpu.read(address)} << "\n";
    }
  }
  void ask(Tick from, Tick shift) {
    Tick at = platform::kBusBegins;
    for (const bus::Bytes& request : platform::requests()) {
      if (at > from) {
        wait_until(at + shift);
        for (std::size_t i = 0; i < request.size(); ++i)
          chip.bus_in->write({systemc::to_time(at + shift + static_cast<Tick>(i) * 11 * platform::kBit),
                              systemc::to_time(platform::kBit), request[i]});
      }
      at += platform::kBetween;
    }
  }
  void write(const BusCharacter& character) override {
    story.say(chip.chip_tick(systemc::current_tick())) << "character " << int{character.data} << "\n";
  }
};

TEST(SavedTlmModule, ContinuesWithTheSamePinsEventsCharactersAndReads) {
  expect_the_same<Tlm<false>>(times_of_platform(), platform::kEnd, 10);
}

TEST(SavedTlmModule, ContinuesWithRunsOfCharacters) {
  expect_the_same<Tlm<true>>(times_of_platform(), platform::kEnd, 10);
}

// --- the DSDPV1-RSU --------------------------------------------------------------------------------------------------

constexpr Tick kGoldenEnd = 7'000 * kUs;

const Changes& golden() {
  static const Changes all =
      changes_of(*tb::traces::read_golden(DSDPV1_SOURCE_DIR "/traces", "rsu_spi").trace, true, kGoldenEnd);
  return all;
}

struct RsuPins : RsuBoard {
  Story story;
  RsuPins(Tick from, Tick shift) : RsuBoard("chip", golden(), false, Engine::kSkip, from, shift) { story.listen(chip); }
};

TEST(SavedRsuPinModule, ContinuesWithTheSamePinsAndEvents) {
  std::vector<Tick> times;
  for (Tick i = 1; i < 12; ++i) times.push_back(i * 571 * kUs + i * i * 313);
  expect_the_same<RsuPins>(times, kGoldenEnd, 11);
}

/// A transaction of the serial ports: a frame or a telegram.
struct Sent {
  Tick at;
  std::vector<std::uint8_t> bytes;
};

/// The frames of XSS in a golden.
std::vector<Sent> frames() {
  std::vector<Sent> all;
  std::map<Pin, bool> level = {{Pin::kXss, true}};
  unsigned bits = 0, byte = 0;
  for (const Change& each : golden()) {
    const bool was = std::exchange(level[each.pin], each.level != 0);
    if (each.pin == Pin::kXss && was && !level[Pin::kXss]) all.push_back({each.at, {}}), bits = 0;
    if (each.pin != Pin::kSck || was || level[Pin::kXss]) continue;
    byte = (byte << 1U | unsigned{level[Pin::kMosi]}) & 0xFFU;
    if (++bits % 8 == 0) all.back().bytes.push_back(static_cast<std::uint8_t>(byte));
  }
  return all;
}

struct RsuTlm : tlm::tlm_analysis_if<BusCharacter> {
  Story story;
  systemc::RsuTlmModule chip{"chip", options()};
  sc_core::sc_signal<bool> reset, low;
  ForeignCpu<> cpu;

  RsuTlm(Tick from, Tick shift) : cpu("cpu", [this, from, shift](ForeignCpu<>&) { send(from, shift); }) {
    cpu.socket.bind(chip.spi_socket);
    chip.RESET(reset), chip.R_REQ(low), chip.R_STA(low);
    chip.bus_out.bind(*this);
    story.listen(chip);
    thread([this, from, shift] { move(from, shift); });
  }

 private:
  static systemc::RsuTlmOptions options() {
    systemc::RsuTlmOptions options;
    options.chip.search_window_ms = 5;  // as the golden's
    options.straps.mode = HostMode::kSpi;
    return options;
  }
  void move(Tick from, Tick shift) {
    for (const Change& each : golden())
      if (each.pin == Pin::kReset) {
        if (each.at > from) wait_until(each.at + shift);
        reset.write(each.level != 0);
      }
  }
  void send(Tick from, Tick shift) {
    for (Sent frame : frames()) {
      if (frame.at <= from || frame.bytes.empty()) continue;
      wait_until(frame.at + shift);
      cpu.transport(tlm::TLM_READ_COMMAND, 0, frame.bytes.data(), static_cast<unsigned>(frame.bytes.size()));
      for (const std::uint8_t byte : frame.bytes) story.say(frame.at) << "read " << int{byte} << "\n";
    }
  }
  void write(const BusCharacter& character) override {
    story.say(chip.chip_tick(systemc::current_tick())) << "character " << int{character.data} << "\n";
  }
};

TEST(SavedRsuTlmModule, ContinuesWithTheSameReplies) {
  std::vector<Tick> times;
  for (Tick i = 1; i < 12; ++i) times.push_back(i * 502 * kUs + i * i * 313);
  expect_the_same<RsuTlm>(times, kGoldenEnd, 4);
}

/// The same chip with its UART, byte by byte.
struct RsuUart : tlm::tlm_analysis_if<BusCharacter> {
  Story story;
  systemc::RsuTlmModule chip{"chip", options()};
  sc_core::sc_signal<bool> reset, low;
  ForeignCpu<> cpu{"cpu", [](ForeignCpu<>&) {}};

  RsuUart(Tick from, Tick shift) {
    cpu.socket.bind(chip.uart_socket);
    chip.RESET(reset), chip.R_REQ(low), chip.R_STA(low);
    chip.uart_characters.bind(*this);
    story.listen(chip);
    thread([this, from, shift] { send(from, shift); });
  }

 private:
  static systemc::RsuTlmOptions options() {
    systemc::RsuTlmOptions options;
    options.straps.mode = HostMode::kUart;
    return options;
  }
  void send(Tick from, Tick shift) {
    if (from < kUs) wait_until(kUs);
    reset.write(true);
    for (Tick at = 200 * kUs; at < kUartEnd; at += 150 * kUs) {
      if (at <= from) continue;
      wait_until(at + shift);
      for (const int byte : {0x01, 0x00, 0x14, 0x01, 0x18, 0xCF})  // read B014
        chip.uart_in->write(
            {systemc::to_time(at + shift), sc_core::SC_ZERO_TIME, static_cast<std::uint8_t>(byte), true, true});
    }
  }
  void write(const BusCharacter& character) override {
    story.say(chip.chip_tick(systemc::current_tick())) << "character " << int{character.data} << "\n";
  }

 public:
  static constexpr Tick kUartEnd = 2'000 * kUs;
};

TEST(SavedRsuTlmModule, ContinuesInCharactersOfTheUart) {
  std::vector<Tick> times;
  for (Tick i = 0; i < 14; ++i) times.push_back(210 * kUs + i * 117 * kUs + i * i * 313);
  expect_the_same<RsuUart>(times, RsuUart::kUartEnd, 14);
}

// --- the SPC3 family -------------------------------------------------------------------------------------------------

template <bool kWithClk>
struct Spc3Pins : Spc3Board {
  Story story;
  Spc3Pins(Tick from, Tick shift) : Spc3Board("chip", {}, kWithClk, shift, from) { story.listen(chip); }
};

std::vector<Tick> times_of_spc3() {
  std::vector<Tick> times;
  for (Tick i = 1; i < 14; ++i) times.push_back(i * 9 * kUs + i * i * 313 + 5);
  return times;
}

TEST(SavedSpc3PinModule, ContinuesWithTheSamePinsAndEvents) {
  expect_the_same<Spc3Pins<false>>(times_of_spc3(), kSpc3End, 13);
  expect_the_same<Spc3Pins<true>>(times_of_spc3(), kSpc3End, 13);
}

struct Spc3Tlm : tlm::tlm_analysis_if<BusCharacter> {
  Story story;
  Spc3TlmModule chip{"chip"};
  sc_core::sc_signal<bool> reset{"reset", true};
  ForeignCpu<> cpu;

  Spc3Tlm(Tick from, Tick shift) : cpu("cpu", [this, from, shift](ForeignCpu<>&) { access(from, shift); }) {
    cpu.socket.bind(chip.host_socket);
    chip.RESET(reset);
    chip.bus_out.bind(*this);
    story.listen(chip);
    thread([this, from, shift] { ask(from, shift); });
  }

 private:
  void access(Tick from, Tick shift) {
    if (from < kUs) wait_until(kUs);
    reset.write(false);
    const struct {
      Tick at;
      int address, value;  ///< negative: read
    } accesses[] = {
        {2 * kUs, regs::kOrgAddress, 9}, {3 * kUs, regs::kMode0 + 1, 1}, {4 * kUs, regs::kMode1S, regs::kMode1Start},
        {55 * kUs, regs::kIrr, -1},      {110 * kUs, regs::kIrr, -1},    {150 * kUs, regs::kStatus, -1}};
    for (const auto& each : accesses) {
      if (each.at <= from) continue;
      wait_until(each.at + shift);
      if (each.value >= 0)
        cpu.write(static_cast<sc_dt::uint64>(each.address), static_cast<std::uint8_t>(each.value));
      else
        story.say(each.at) << "read " << int{cpu.read(static_cast<sc_dt::uint64>(each.address))} << "\n";
    }
  }
  void ask(Tick from, Tick shift) {
    for (const Tick at : {20 * kUs, 60 * kUs, 120 * kUs}) {
      if (at <= from) continue;
      wait_until(at + shift);
      Tick start = at + shift;
      for (const int byte : {0x10, 0x09, 0x02, 0x49, 0x54, 0x16}) {
        chip.bus_in->write({systemc::to_time(start), systemc::to_time(1000), static_cast<std::uint8_t>(byte)});
        start += 11'000;
      }
    }
  }
  void write(const BusCharacter& character) override {
    story.say(chip.chip_tick(systemc::current_tick())) << "character " << int{character.data} << "\n";
  }
};

TEST(SavedSpc3TlmModule, ContinuesWithTheSamePinsEventsCharactersAndReads) {
  expect_the_same<Spc3Tlm>(times_of_spc3(), kSpc3End, 10);
}

// --- refused ---------------------------------------------------------------------------------------------------------

/// Why `call` throws.
template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const StateError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(SavedModules, AreRefusedWithAReason) {
  const std::string told = in_a_process_of_its_own([] {
    set_resolution();
    collect_reports();
    Tlm<true> bench(kBegin, 0);
    PinBench pins("pins");
    systemc::TlmOptions slower;
    slower.chip.rts_lead = 5;
    systemc::TlmModule other("other", slower);
    other.RESET(bench.reset), other.R_REQ(bench.r_req), other.R_STA(bench.r_sta);
    ForeignCpu<> cpu("other_cpu", [](ForeignCpu<>&) {});
    cpu.socket.bind(other.host_socket);
    std::string all;
    const auto say = [&](const std::string& text) { all += text + "\n"; };
    say(refusal([&] { bench.chip.restore({1, 2, 3}); }));
    sc_core::sc_start(50, sc_core::SC_US);
    State state = bench.chip.save();
    say(refusal([&] { pins.chip.restore(state); }));
    say(refusal([&] { other.restore(state); }));
    say(refusal([&] { bench.chip.restore({1, 2, 3}); }));
    state[200] ^= 1;
    say(refusal([&] { bench.chip.restore(state); }));
    std::string in_access, from_pin;
    bench.chip.on_event = {};
    thread([&] {
      while (in_access.find("access") == std::string::npos) {
        sc_core::wait(100, sc_core::SC_NS);
        in_access = refusal([&] { bench.chip.save(); });
      }
    });
    bench.chip.on_event = [&](const profibus::Event&) { from_pin = refusal([&] { bench.chip.save(); }); };
    sc_core::sc_start(800, sc_core::SC_US);
    say(in_access);
    say(from_pin);
    return all;
  });
  EXPECT_EQ(told,
            "chip: restore after the simulation has started: sc_start(0) will do\n"
            "the state is of a TlmModule, this chip is a PinModule\n"
            "the state is of a chip whose rts_lead is 4, here it is 5\n"
            "this is no saved state of a chip\n"
            "the state is damaged: its checksum is wrong\n"
            "chip: not saved, because an access is in progress\n"
            "chip: not saved, because the chip is running\n");
}

}  // namespace

/// Before the first simulation of the tests.
void simulate() {
  recorded();
  golden();
}

}  // namespace dsdpv1
