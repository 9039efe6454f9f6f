#include "tests/state/aimed.hpp"

#include <algorithm>
#include <random>
#include <utility>

#include "bus/telegram/telegram.hpp"
#include "bus/wire/uart.hpp"
#include "registers/dsdpv1_regs.hpp"
#include "tests/conformance/host_telegrams.hpp"
#include "tests/state/life.hpp"

namespace dsdpv1::state_test {
namespace {

using bus::Bytes;
using conformance::exchange_telegram;
using conformance::inputs_telegram;
using conformance::read_telegram;
using conformance::write_telegram;

constexpr Tick kCycle = profibus::kTicksPerCycle;
constexpr Tick kStartUp = 4200 * kCycle;  // RAM cleared, B004 written
constexpr Tick kBusBit = 4 * kCycle;      // 12 Mbit/s
constexpr Tick kMs = profibus::kCyclesPerMs * kCycle;

/// Moves the pins one after the other and marks the moments.
class Script {
 public:
  Script(std::string name, const Config& config) { all_.stimulus = {std::move(name), config, {}, 0}; }
  /// Continues from the state of a scenario's pins at `from`.
  Script(std::string name, const Recorded& scenario, Tick from) : Script(std::move(name), scenario.config) {
    const auto behind = std::find_if(scenario.inputs.begin(), scenario.inputs.end(),
                                     [from](const Input& each) { return each.at > from; });
    all_.stimulus.inputs.assign(scenario.inputs.begin(), behind);
    now_ = from;
  }

  Tick now() const { return now_; }
  void wait(Tick ticks) { now_ += ticks; }
  void set(Pin pin, Level level) { all_.stimulus.inputs.push_back({now_, pin, level}); }
  /// The chip is saved here.
  void mark() { all_.moments.push_back({now_, all_.stimulus.inputs.size()}); }
  /// Waits for `count` edges of CLK; the chip is saved at each.
  void mark_cycles(int count) {
    for (int i = 0; i < count; ++i) {
      wait(kCycle - now_ % kCycle);
      mark();
    }
  }
  Aimed done(Tick rest) {
    all_.stimulus.end = now_ + rest;
    return std::move(all_);
  }

 private:
  Aimed all_;
  Tick now_ = 0;
};

class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}
  Tick below(Tick limit) { return static_cast<Tick>(random_() % static_cast<std::uint64_t>(limit)); }
  Tick from_to(Tick least, Tick most) { return least + below(most - least + 1); }
  bool one_in(Tick count) { return below(count) == 0; }
  std::uint8_t byte() { return static_cast<std::uint8_t>(below(256)); }
  Bytes bytes(std::size_t count) {
    Bytes bytes(count);
    for (std::uint8_t& each : bytes) each = byte();
    return bytes;
  }

 private:
  std::mt19937 random_;
};

// --- a user at the parallel port -------------------------------------------------------------------------------------

/// Guarantees no limit: strobes, set-up and hold times are random, and so is the owner of the DPRAM.
class Clumsy {
 public:
  Clumsy(Script& script, Chance& chance) : script_(script), chance_(chance) {}

  void act() {
    switch (chance_.below(8)) {
      case 0:
      case 1:
      case 2: return write();
      case 3:
      case 4:
      case 5: return read();
      case 6: return hold(Pin::kRReq);
      default: return hold(Pin::kRSta);
    }
  }

 private:
  void pause(Tick most) {
    script_.wait(chance_.one_in(3) ? 0 : chance_.below(most));
    if (chance_.one_in(4)) script_.mark();
  }
  void hold(Pin pin) {
    script_.set(pin, static_cast<Level>(chance_.below(2)));
    pause(4 * kCycle);
  }
  void address() { script_.set(Pin::kA, static_cast<Level>(kCells.at(static_cast<std::size_t>(chance_.below(4))))); }
  void write() {
    address();
    script_.set(Pin::kDIn, chance_.one_in(8) ? kLevelZ : static_cast<Level>(chance_.byte()));
    pause(400);
    script_.set(Pin::kCsr, 0);
    script_.set(Pin::kWr, 0);
    pause(500);
    if (chance_.one_in(10)) script_.set(Pin::kCsr, 1);
    script_.set(Pin::kWr, 1);
    pause(300);
    script_.set(Pin::kCsr, 1);
    script_.set(Pin::kDIn, kLevelZ);
    pause(700);
  }
  void read() {
    address();
    pause(100);
    script_.set(Pin::kCsr, 0);
    script_.set(Pin::kRd, 0);
    pause(500);
    if (chance_.one_in(5)) address();
    pause(600);
    script_.set(Pin::kRd, 1);
    script_.set(Pin::kCsr, 1);
    pause(300);
  }

  static constexpr std::array<int, 4> kCells = {0x700, 0x701, 0x00A, 0x014};
  Script& script_;
  Chance& chance_;
};

/// A DSDPV1 after its start-up.
Script started(std::string name) {
  Script script(std::move(name), Config{});
  script.wait(5000);
  script.set(Pin::kReset, 1);
  script.wait(kStartUp);
  return script;
}

Aimed clumsy_user(unsigned seed) {
  Chance chance(seed);
  Script script = started("clumsy_user_seed_" + std::to_string(seed));
  Clumsy user(script, chance);
  for (int i = 0; i < 400; ++i) user.act();
  script.set(Pin::kReset, 0);
  script.mark();
  script.wait(100 * kCycle);
  script.set(Pin::kReset, 1);
  return script.done(kStartUp);
}

/// An address that changes between RD's fall and the edge that latches it.
Aimed exact_read() {
  Script script = started("exact_read");
  script.set(Pin::kRReq, 1);
  script.wait(100 * kCycle);
  script.set(Pin::kRSta, 1);
  script.wait(100 * kCycle - script.now() % kCycle + 20);
  for (int i = 0; i < 2; ++i) {
    script.set(Pin::kA, static_cast<Level>(regs::kVersion + i));
    script.set(Pin::kCsr, 0);
    script.set(Pin::kRd, 0);
    script.wait(100);
    script.set(Pin::kA, regs::kVersion + 2);
    script.mark();
    script.wait(1000);
    script.set(Pin::kRd, 1);
    script.set(Pin::kCsr, 1);
    script.wait(400);
  }
  return script.done(100 * kCycle);
}

/// Pulses shorter and longer than a cycle: the contents of the two flip-flops are saved.
Aimed pulses(Pin pin) {
  Chance chance(3);
  Script script = started(std::string("pulses_of_") + name(pin));
  for (int i = 0; i < 400; ++i) {
    script.set(pin, static_cast<Level>(i % 2));
    script.wait(chance.below(kCycle));
    script.mark();
    if (chance.one_in(4)) script.wait(chance.below(5 * kCycle));
  }
  return script.done(100 * kCycle);
}

// --- a host at the serial ports --------------------------------------------------------------------------------------

constexpr std::uint8_t kNoCommand = 0x20;  // of B010: a bit that remains

/// MOSI of a frame: the request and `reply` more bytes for its reply.
Bytes and_reply(Bytes request, std::size_t reply) {
  request.resize(request.size() + reply, 0xFF);
  return request;
}

/// A DSDPV1-RSU after its start-up.
Script at_port(std::string name, HostMode mode, int rate = 0, Config config = {}) {
  config.part = Part::kRsu;
  Script script(std::move(name), config);
  script.set(Pin::kMode, static_cast<Level>(mode));
  script.set(Pin::kAdr, 1);
  script.set(Pin::kUbr, static_cast<Level>(rate));
  script.set(Pin::kUiv, 1);
  script.wait(5000);
  script.set(Pin::kReset, 1);
  script.mark();
  script.wait(kStartUp);
  return script;
}

void change_straps(Script& script) {
  for (const Pin pin : {Pin::kMode, Pin::kAdr, Pin::kUbr, Pin::kUiv}) {
    script.mark();
    script.set(pin, 3);
    script.wait(50 * kCycle);
  }
}

/// Bits of MOSI, each followed by SCK's rise after `low`; `falls(bit, of the last byte)` continues from there.
template <class Falls>
void clock(Script& script, const Bytes& bytes, Tick low, const Falls& falls) {
  for (const std::uint8_t& byte : bytes)
    for (int bit = 7; bit >= 0; --bit) {
      script.set(Pin::kMosi, static_cast<Level>(byte >> bit & 1));
      script.wait(low);
      script.set(Pin::kSck, 1);
      falls(bit, &byte == &bytes.back());
    }
}

/// Frames with random times, down to several edges in one tick; MISO has its maximum delay.
class Frames {
 public:
  Frames(Script& script, Chance& chance) : script_(script), chance_(chance) {}

  void send(const Bytes& request, std::size_t reply) {
    usual_ = chance_.one_in(3) ? 1000 : chance_.one_in(2) ? 500 : 260;
    together_ = chance_.one_in(3);
    if (usual_ != 260) script_.wait(kCycle - script_.now() % kCycle);  // in step with CLK
    step(Pin::kXss, 0);
    for (const std::uint8_t byte : and_reply(request, reply)) {
      for (int bit = 7; bit >= 0; --bit) {
        if (chance_.one_in(200)) return end();
        step(Pin::kMosi, static_cast<Level>(byte >> bit & 1));
        step(Pin::kSck, 1);
        step(Pin::kSck, 0);
      }
    }
    end();
  }

 private:
  void end() {
    step(Pin::kXss, 1);
    script_.wait(chance_.from_to(0, 60 * kCycle));
    if (chance_.one_in(2)) script_.mark();
  }
  void step(Pin pin, Level level) {
    script_.set(pin, level);
    if (chance_.one_in(100)) script_.mark();
    if (together_ && chance_.one_in(6)) return chance_.one_in(2) ? script_.mark() : void();  // next edge: same tick
    script_.wait(together_ && chance_.one_in(10) ? chance_.from_to(1, 60) : usual_ / 2);
    if (together_ && chance_.one_in(40)) script_.mark();
  }

  Script& script_;
  Chance& chance_;
  Tick usual_ = 260;
  bool together_ = false;
};

Aimed hasty_spi(unsigned seed) {
  Chance chance(seed);
  Config config;
  config.spi_miso_delay = 600;
  config.spi_reply_gap = 3 * (seed % 2);
  config.u_timer = 2000;
  Script script = at_port("hasty_spi_seed_" + std::to_string(seed), HostMode::kSpi, 0, config);
  Frames frames(script, chance);
  for (int i = 0; i < 60; ++i) {
    switch (chance.below(5)) {
      case 0: frames.send(read_telegram(0x700, 3), 7); break;
      case 1: frames.send(write_telegram(0x700, chance.bytes(4)), 4); break;
      case 2: frames.send(write_telegram(0x014, {static_cast<std::uint8_t>(chance.below(4))}), 4); break;
      case 3: frames.send(inputs_telegram(chance.bytes(3)), 8); break;
      default: frames.send(chance.bytes(5), 4); break;
    }
  }
  change_straps(script);
  return script.done(200 * kCycle);
}

/// SCK is far too fast: changes of MISO queue up.
Aimed racing_spi() {
  Config config;
  config.spi_miso_delay = 600;
  Script script = at_port("racing_spi", HostMode::kSpi, 0, config);
  const auto bytes = [&script](const Bytes& all, Tick half, bool marks) {
    clock(script, all, half, [&script, half, marks](int, bool) {
      script.wait(half);
      script.set(Pin::kSck, 0);
      if (marks) script.mark();
    });
  };
  script.set(Pin::kXss, 0);
  script.wait(800);
  bytes(read_telegram(0x001, 200), 700, false);  // longer than the bytes sent, whose number is reported
  for (const Tick half : {400, 35, 130, 33, 55, 65}) bytes({0xFF}, half, true);
  Chance chance(1);
  for (int i = 0; i < 60; ++i) bytes({0x5A}, chance.from_to(3, 12), i % 2 == 0);  // some fall into one cycle
  script.mark_cycles(4);
  script.wait(800);
  for (const Tick low : {20, 20, 500, 20}) {
    script.set(Pin::kXss, 1);
    script.wait(60);
    script.set(Pin::kXss, 0);
    script.wait(low);
    script.mark();
  }
  script.set(Pin::kXss, 1);
  script.mark_cycles(4);
  return script.done(200 * kCycle);
}

/// Frames with two events in the same cycle: a frame that ends with its last bit, and the DPRAM's update from it, byte
/// by byte.
Aimed exact_spi() {
  Config config;
  config.spi_reply_gap = 4;
  Script script = at_port("exact_spi", HostMode::kSpi, 0, config);
  const auto frame = [&script](const Bytes& request, bool ends) {
    script.wait(kCycle - script.now() % kCycle);
    script.set(Pin::kXss, 0);
    script.wait(800);
    clock(script, request, 700, [&script, ends](int bit, bool last) {
      if (ends && last && bit == 0) return;
      script.wait(700);
      script.set(Pin::kSck, 0);
    });
    if (!ends) script.mark_cycles(20);
    script.set(Pin::kXss, 1);
    if (ends) script.mark_cycles(20);
    script.set(Pin::kSck, 0);
    script.wait(300 * kCycle);
  };
  frame(write_telegram(regs::kOwnership, {0x02}), false);
  frame(write_telegram(0x012, {1, 2, 2, 4, 5, 6}), false);
  frame(write_telegram(0x700, {1, 2, 3, 4}), false);
  frame(write_telegram(0x700, {5, 6, 7, 8}), true);
  frame(write_telegram(regs::kChipCommand1, {0x07}), false);
  frame(write_telegram(regs::kUserCommand1, {kNoCommand}), false);
  frame(inputs_telegram({1, 2, 3, 4}), false);
  for (const std::uint16_t cell : {regs::kChipCommand1, regs::kUserCommand1})
    frame(and_reply(read_telegram(cell, 1), 9), false);
  frame(inputs_telegram({1, 2, 3, 4}), true);
  frame(and_reply(read_telegram(0x700, 2), 7), false);
  return script.done(300 * kCycle);
}

/// Edges of SCK coincide with those of CLK when the port loads its data to send, and XSS and SCK change at one tick.
Aimed ties_of_spi() {
  Script script = at_port("ties_of_spi", HostMode::kSpi);
  for (int high = 3; high <= 7; ++high) {
    script.wait(kCycle - script.now() % kCycle);
    script.set(Pin::kXss, 0);
    script.wait(4 * kCycle);
    clock(script, and_reply(read_telegram(0x001, 30), 9), 3 * kCycle, [&script, high](int bit, bool) {
      script.wait(high * kCycle);
      if (bit < 2) script.mark();
      script.set(Pin::kSck, 0);
    });
    for (int bit = 0; bit < 7; ++bit)
      for (const Level level : {Level{1}, Level{0}}) {
        script.wait(4 * kCycle);
        script.set(Pin::kSck, level);
      }
    script.wait(4 * kCycle);
    script.set(Pin::kXss, 1);
    script.mark();
    script.set(Pin::kSck, 1);  // at this tick: the edge counts
    script.wait(4 * kCycle);
    script.set(Pin::kSck, 0);
    script.wait(20 * kCycle);
  }
  script.set(Pin::kXss, 0);  // at the speed at which loaded bytes are sent one byte later
  script.wait(4 * kCycle);
  const auto bytes = [&script](const Bytes& all, Tick half) {
    clock(script, all, half, [&script, half](int, bool) {
      script.wait(half);
      if (script.now() % kCycle == 0 && half < kCycle) script.mark();
      script.set(Pin::kSck, 0);
    });
  };
  bytes(read_telegram(0x000, 9), 3 * kCycle);
  bytes(Bytes(16, 0xFF), 25);
  script.wait(4 * kCycle);
  script.set(Pin::kXss, 1);
  return script.done(100 * kCycle);
}

/// The edge at which the port begins to listen after a reset, and an edge of SCK at the same tick.
Aimed awaking_spi() {
  Script script = at_port("awaking_spi", HostMode::kSpi);
  for (int cycles = 1; cycles < 10; ++cycles) {
    script.wait(kCycle - script.now() % kCycle);
    script.set(Pin::kReset, 0);
    script.set(Pin::kXss, 1);
    script.set(Pin::kSck, 0);
    script.wait(100 * kCycle);
    script.set(Pin::kReset, 1);
    script.wait((cycles - 1) * kCycle + 100);
    script.set(Pin::kXss, 0);
    script.wait(kCycle - 100);
    script.mark();
    script.set(Pin::kSck, 1);
    script.wait(1000);
    script.set(Pin::kSck, 0);
    script.wait(20 * kCycle);
  }
  return script.done(kStartUp);
}

/// Telegrams of the UART, correct and corrupted, and characters in the middle of a reply.
class Characters {
 public:
  Characters(Script& script, Chance& chance, int rate)
      : script_(script), chance_(chance), bit_(kUbrCycles.at(static_cast<std::size_t>(rate)) * kCycle) {}

  /// Not random: the chip is saved at each edge at which the request is checked and carried out.
  void say(const Bytes& request) {
    for (const std::uint8_t& byte : request) {
      const std::uint16_t bits = bus::Character::of(byte).bits;
      for (int i = 0; i < kCharacter; ++i) {
        script_.set(Pin::kRxd, static_cast<Level>(bits >> i & 1));
        if (i == kCharacter - 1 && &byte == &request.back()) script_.mark_cycles(40);
        script_.wait(bit_);
      }
    }
    script_.wait(20 * kCharacter * bit_);
  }

  void ask(const Bytes& request, int reply) {
    const bool spoilt = chance_.one_in(5);
    for (const std::uint8_t byte : request) character(byte, spoilt && chance_.one_in(3));
    for (int i = 0; i < reply + 3; ++i) {
      script_.wait(chance_.below(2 * kCharacter * bit_));
      if (chance_.one_in(6)) script_.mark();
      if (chance_.one_in(30)) character(0x5A, false);
    }
    script_.wait(30 * kCharacter * bit_);
  }

 private:
  static constexpr int kCharacter = 11;
  void character(std::uint8_t byte, bool wrong) {
    std::uint16_t bits = bus::Character::of(byte).bits;
    if (wrong) bits = static_cast<std::uint16_t>(bits ^ 1U << chance_.from_to(1, 10));
    for (int i = 0; i < kCharacter; ++i) {
      script_.set(Pin::kRxd, static_cast<Level>(bits >> i & 1));
      const Tick half = chance_.below(bit_);
      script_.wait(half);
      if (chance_.one_in(40)) script_.mark();
      script_.wait(bit_ - half);
    }
  }

  Script& script_;
  Chance& chance_;
  const Tick bit_;
};

Aimed talking_uart(unsigned seed) {
  constexpr int kRate = 7;
  constexpr std::uint8_t kAllNews = 0x07;  // parameters, configuration, outputs
  Chance chance(seed);
  Script script = at_port("talking_uart_seed_" + std::to_string(seed), HostMode::kUart, kRate);
  Characters host(script, chance, kRate);
  for (int i = 0; i < 40; ++i) {
    switch (chance.below(6)) {
      case 0: host.ask(read_telegram(0x700, 4), 8); break;
      case 1: host.ask(write_telegram(0x700, chance.bytes(4)), 4); break;
      case 2: host.ask(write_telegram(regs::kChipCommand1, {kAllNews}), 4); break;
      case 3: host.ask(write_telegram(regs::kChipCommand2, {0x03}), 4); break;
      case 4: host.ask(exchange_telegram(1, regs::kInput, chance.bytes(6)), 20); break;
      default: host.ask(exchange_telegram(3, regs::kC1, chance.bytes(6)), 20); break;
    }
  }
  change_straps(script);
  return script.done(200 * kCycle);
}

Aimed exact_uart() {
  constexpr int kRate = 7;
  Chance chance(1);
  Script script = at_port("exact_uart", HostMode::kUart, kRate);
  Characters host(script, chance, kRate);
  host.say(write_telegram(regs::kC1, {0x5F, 1, 2, 4, 9, 8, 7, 6}));
  host.say(write_telegram(regs::kOutput, {4, 1, 2, 3, 4}));
  host.say(read_telegram(regs::kC1, 6));
  host.say(write_telegram(0x700, Bytes(255, 0)));  // too long
  host.say(write_telegram(regs::kUserCommand1, {kNoCommand}));
  for (const std::uint16_t news : {regs::kChipCommand2, regs::kChipCommand1}) {
    host.say(write_telegram(news, {0x03}));
    host.say(exchange_telegram(1, regs::kInput, {1, 2, 3}));
    host.say(exchange_telegram(3, regs::kC1, {0x5E, 1, 2, 0}));
    host.say(exchange_telegram(3, regs::kDiag, {1, 2, 3}));
    host.say(write_telegram(regs::kUserCommand1, {kNoCommand}));
    host.say(exchange_telegram(1, regs::kInput, {}));
    host.say(exchange_telegram(1, regs::kInput, {7}));
    host.say(read_telegram(regs::kUserCommand1, 2));
  }
  return script.done(200 * kCycle);
}

// --- a master --------------------------------------------------------------------------------------------------------

/// Continues after the pins of a scenario: from there on, only this master sends on the bus.
class Master {
 public:
  /// `marks`: cycles after a marked telegram at which the chip is saved.
  Master(Script& script, std::uint8_t own, std::uint8_t slave, Tick bit = kBusBit, int marks = 12)
      : script_(script), own_(own), slave_(slave), bit_(bit), marks_(marks) {}

  /// A request with or without SAPs, and time for its answer. `marked`: the chip is saved after and during the request.
  void ask(std::uint8_t function, const Bytes& saps, const Bytes& data, bool marked = true) {
    send(telegram(slave_, function, saps, data), marked);
    script_.wait(kAnswer * bit_);
    if (marked) script_.mark();
  }
  /// Follows a telegram for another station without T_SYN, so the chip ignores it.
  void ask_too_soon(std::uint8_t function, const Bytes& data) {
    send(telegram(slave_ + 1, function, {}, {}), false);
    send(telegram(slave_, function, {}, data), true, kSyn / 3);
    script_.wait(kSyn * bit_);
  }
  void tell_all(const Bytes& saps, const Bytes& data) {
    send(telegram(bus::kBroadcast, 0x46, saps, data), true);
    script_.wait(kSyn * bit_);
  }

 private:
  static constexpr Tick kSyn = 60, kAnswer = 800;  // bits
  Bytes telegram(int to, std::uint8_t function, const Bytes& saps, const Bytes& data) const {
    const auto slave = static_cast<std::uint8_t>(to);
    return bus::encode(saps.empty() ? bus::make_telegram(slave, own_, function, data)
                                    : bus::make_telegram(slave, own_, function, data, saps.at(0), saps.at(1)));
  }
  void send(const Bytes& telegram, bool marked, Tick idle = kSyn) {
    script_.wait(idle * bit_);
    for (const std::uint8_t& byte : telegram) {
      const std::uint16_t bits = bus::Character::of(byte).bits;
      for (int i = 0; i < 11; ++i) {
        script_.set(Pin::kPbrxd, static_cast<Level>(bits >> i & 1));
        if (marked && &byte == &telegram[2]) script_.mark();
        script_.wait(bit_);
      }
    }
    if (marked) script_.mark_cycles(marks_);
  }

  Script& script_;
  const std::uint8_t own_, slave_;
  const Tick bit_;
  const int marks_;
};

constexpr std::uint8_t kSrd = 0x5D, kSrdOther = 0x7D;  // with FCV; FCB 0 and 1
constexpr std::uint8_t kStatus = 0x49;                 // FDL status: no request after it is a repetition (S26)
constexpr unsigned kIdent = 0x0CC9;                    // ident number of the scenarios' slaves

/// Parameters of Set_Prm; `options` is DPV1_Status_1. Their Min T_SDR differs from the slave's present one.
Bytes parameters(std::uint8_t options) {
  return {0xB8, 0x01, 0x01, 0x20, kIdent >> 8, kIdent & 0xFF, 0x01, options, 0, 0};
}

/// The scenario's slave in data exchange; the user has released the DPRAM.
Script in_data_exchange(std::string name, std::uint32_t baud_control_ms = 600) {
  static const Recorded scenario = [] {
    Recorded slave = recorded("power_on_12m").at(0);
    slave.config.intr_gap = 20'000;  // longer than some telegrams
    return slave;
  }();
  Recorded slave = scenario;
  slave.config.baud_control_ms = baud_control_ms;
  Script script(std::move(name), slave, 3 * kMs);  // the scenario guarantees data exchange here
  for (const Pin pin : {Pin::kRd, Pin::kWr, Pin::kCsr, Pin::kPbrxd}) script.set(pin, 1);
  script.set(Pin::kDIn, kLevelZ);
  script.wait(10 * kCycle);
  for (const Pin pin : {Pin::kRReq, Pin::kRSta}) script.set(pin, 0);
  script.wait(2000 * kCycle);  // the last telegram of the scenario's master is over
  Master(script, 2, 5).ask(kStatus, {}, {}, false);
  return script;
}

void take(Script& script) {
  script.set(Pin::kRReq, 1);
  script.wait(200 * kCycle);
  script.set(Pin::kRSta, 1);
}
void give(Script& script) {
  script.set(Pin::kRSta, 0);
  script.set(Pin::kRReq, 0);
}

/// The user writes some cells and returns the DPRAM.
void write(Script& script, const std::vector<std::pair<int, std::uint8_t>>& cells) {
  take(script);
  for (const auto& [address, value] : cells) {
    script.set(Pin::kA, static_cast<Level>(address));
    script.set(Pin::kDIn, value);
    script.wait(300);
    script.set(Pin::kCsr, 0);
    script.set(Pin::kWr, 0);
    script.wait(600);
    script.set(Pin::kWr, 1);
    script.set(Pin::kCsr, 1);
    script.wait(300);
  }
  script.set(Pin::kDIn, kLevelZ);
  script.wait(10 * kCycle);
  give(script);
}

/// The user reads the status.
void read_status(Script& script) {
  take(script);
  for (const int address : {regs::kChipStatus2, regs::kChipStatus4, regs::kChipCommand2, regs::kUserCommand2}) {
    script.set(Pin::kA, static_cast<Level>(address));
    script.wait(300);
    script.set(Pin::kCsr, 0);
    script.set(Pin::kRd, 0);
    script.wait(1000);
    script.set(Pin::kRd, 1);
    script.set(Pin::kCsr, 1);
    script.wait(300);
  }
  give(script);
}

/// A C1 request that the chip refuses, and one while the user has not yet cleared a C2 flag.
Aimed acyclic_flags() {
  const Recorded scenario = recorded("dpv1_c1").at(0);
  Script script("acyclic_flags", scenario, 69 * kMs);
  constexpr Tick kBit = 32 * kCycle;
  script.set(Pin::kPbrxd, 1);
  script.wait(200 * kBit);
  Master master(script, 2, 5, kBit, 100);
  master.ask(kStatus, {}, {}, false);
  master.ask(kSrd, {51, 51}, {0x5E, 1, 1});  // too short: the chip keeps its own answer (V9)
  master.ask(kSrdOther, {51, 51}, {});
  write(script, {{regs::kChipCommand2, regs::kChipCommand2C2}});
  master.ask(kSrd, {51, 51}, {0x5E, 1, 1, 4});
  read_status(script);
  return script.done(2000 * kCycle);
}

/// The user's requests; the chip reads them at the head of an access and uses them later in it.
Aimed commands() {
  Script script = in_data_exchange("commands");
  using Cells = std::vector<std::pair<int, std::uint8_t>>;
  const auto command = [&script](const Cells& cells) {
    write(script, cells);
    script.mark_cycles(90);
    read_status(script);
    script.wait(100 * kCycle);
  };
  command({{regs::kInputCrc, 0xDE}, {regs::kUserCommand1, regs::kUserCommand1Input}});
  command({{regs::kDiagCrc, 0xDE}, {regs::kUserCommand1, regs::kUserCommand1Diag}});
  command({{regs::kUserCommand2, regs::kUserCommand2InputHistory | regs::kUserCommand2InputClear}});
  command({{regs::kDpv1Enable, regs::kDpv1EnableOn}, {regs::kUserCommand1, regs::kUserCommand1Init}});
  script.wait(300 * kCycle);
  read_status(script);
  command({{regs::kInit, 0xFF}, {regs::kUserCommand1, regs::kUserCommand1Init}});
  return script.done(2000 * kCycle);
}

/// Parameters and a configuration that the user judges late, then Fail_Safe: a Data_Exchange without outputs.
Aimed judged_late() {
  Script script = in_data_exchange("judged_late");
  Master master(script, 2, 5);
  const auto judge = [&script](std::uint8_t command) {
    write(script, {{regs::kUserStatus1, 0}, {regs::kUserCommand1, command}});
    script.wait(200 * kCycle);
    script.mark();
  };
  for (int i = 0; i < 2; ++i) {
    master.ask(kSrd, {61, 62}, parameters(0x40));
    judge(regs::kUserCommand1PrmVerdict);
    master.ask(kSrdOther, {60, 62}, {});
  }
  master.ask(kSrd, {62, 62}, {0x17, 0x27});
  judge(regs::kUserCommand1CfgVerdict);
  master.ask(kSrdOther, {}, {1, 2, 3, 4, 5, 6, 7, 8});
  master.tell_all({58, 62}, {0x08, 0x01});
  master.ask(kSrd, {60, 62}, {});
  master.ask(kSrdOther, {}, {});
  return script.done(2000 * kCycle);
}

/// Parameters that the user judges after the rate has been lost: their watchdog waits for the rate (S29).
Aimed waiting_watchdog() {
  Script script = in_data_exchange("waiting_watchdog", 2);
  Master master(script, 2, 5);
  Bytes unlock = parameters(0);
  unlock[0] = 0x40;
  master.ask(kSrd, {61, 62}, unlock, false);
  master.ask(kSrdOther, {61, 62}, parameters(0x04), false);
  script.wait(5 * kMs / 2);
  write(script, {{regs::kUserStatus1, 0}, {regs::kUserCommand1, regs::kUserCommand1PrmVerdict}});
  script.wait(300 * kCycle);
  script.mark();
  master.ask(kStatus, {}, {});
  return script.done(2000 * kCycle);
}

/// An address that is locked, and a master that tries to change it.
Aimed locked_address() {
  Script script = in_data_exchange("locked_address");
  Bytes unlock = parameters(0);
  unlock[0] = 0x40;
  Master(script, 2, 5).ask(kSrdOther, {61, 62}, unlock);
  Master(script, 2, 5).ask(kSrd, {55, 62}, {7, kIdent >> 8, kIdent & 0xFF, 0xFF});
  Master(script, 2, 7).ask(kSrdOther, {55, 62}, {8, kIdent >> 8, kIdent & 0xFF, 0});
  return script.done(2000 * kCycle);
}

/// Repeats each request, as if its answer had been lost.
Aimed repetitions() {
  Script script = in_data_exchange("repetitions");
  Master master(script, 2, 5);
  for (const std::uint8_t function : {kSrd, kSrdOther})
    for (int i = 0; i < 2; ++i) master.ask(function, {}, {1, 2, 3, 4, 5, 6, 7, 8});
  for (const std::uint8_t function : {kSrd, kSrdOther})
    for (int i = 0; i < 2; ++i) master.ask(function, {60, 62}, {});
  master.ask_too_soon(kSrd, {1, 2, 3, 4, 5, 6, 7, 8});
  return script.done(2000 * kCycle);
}

/// The user owns the DPRAM while parameters, a configuration and outputs arrive; then it gets them at once.
Aimed held_mail() {
  Script script = in_data_exchange("held_mail");
  Master master(script, 2, 5);
  script.set(Pin::kRReq, 1);
  script.wait(2 * kCycle);
  script.set(Pin::kRSta, 1);
  script.mark_cycles(4);
  script.wait(10 * kCycle);
  for (int i = 0; i < 3; ++i) master.ask(i % 2 == 0 ? kSrd : kSrdOther, {}, Bytes(8, static_cast<std::uint8_t>(i)));
  master.ask(kSrdOther, {61, 62}, parameters(0));
  master.ask(kSrd, {62, 62}, {0x17, 0x27});
  script.mark();
  for (const Pin pin : {Pin::kRReq, Pin::kRSta}) {
    script.set(pin, 0);
    script.wait(kCycle);
    script.mark_cycles(4);
  }
  script.mark_cycles(120);
  master.ask(kSrdOther, {60, 62}, {});
  return script.done(2000 * kCycle);
}

/// Functions that the chip does not support, and a Slave_Diag that reports them.
Aimed unsupported() {
  Script script = in_data_exchange("unsupported");
  Master master(script, 2, 5);
  master.ask(kSrd, {61, 62}, parameters(0xBF));
  master.tell_all({58, 62}, {0x3F, 0x01});
  master.ask(kSrdOther, {60, 62}, {});
  return script.done(2000 * kCycle);
}

Aimed frozen() {
  Script script = in_data_exchange("frozen");
  Master master(script, 2, 5);
  for (const std::uint8_t command : Bytes{0x08, 0x20, 0x04, 0x10}) {
    master.tell_all({58, 62}, {command, 0x01});
    master.ask(command == 0x20 || command == 0x10 ? kSrdOther : kSrd, {}, Bytes(8, command));
  }
  return script.done(2000 * kCycle);
}

// --- runs of characters, samples -------------------------------------------------------------------------------------

constexpr Tick kCharacter = 11 * kBusBit;

/// A slave in data exchange at 12 Mbit/s; it hears a telegram as a run from `start` on.
Act hears_run(std::string name, const Bytes& telegram, Tick saved, std::function<void(Chip& chip, Tick start)> rest) {
  const Recorded begin = in_data_exchange("").done(0).stimulus;
  const Tick start = begin.end + 60 * kBusBit;
  const auto before = [begin, telegram, start, saved](Chip& chip) {
    play(chip, begin, 0, begin.end);
    chip.hear(start, {start, kBusBit / kCycle, telegram.data(), static_cast<int>(telegram.size())});
    chip.advance(start + saved);
  };
  return {std::move(name), begin.config, before, [start, rest = std::move(rest)](Chip& chip) { rest(chip, start); }};
}

Bytes telegram_to(std::uint8_t slave) {
  return bus::encode(bus::make_telegram(slave, 2, kSrd, {1, 2, 3, 4, 5, 6, 7, 8}));
}

std::vector<Act> runs() {
  const auto to_its_end = [](Chip& chip, Tick start) { chip.advance(start + 60 * kCharacter); };
  const auto is_left = [](Chip& chip, Tick start) {
    const Tick left = start + 7 * kCharacter + 3 * kBusBit;
    chip.leave_run(left);
    chip.set(left + kBusBit / 2, Pin::kPbrxd, 0);
    chip.set(left + 3 * kBusBit, Pin::kPbrxd, 1);
    chip.advance(start + 60 * kCharacter);
  };
  const auto falls_into_reset = [](Chip& chip, Tick start) {
    chip.set(start + 6 * kCharacter, Pin::kReset, 0);
    chip.leave_run(start + 6 * kCharacter);
    chip.advance(start + 60 * kCharacter);
  };
  Bytes broken = telegram_to(5);
  broken[6] ^= 1;
  std::vector<Act> all = {hears_run("run_for_it", telegram_to(5), 5 * kCharacter, to_its_end),
                          hears_run("run_for_another", telegram_to(9), 5 * kCharacter, to_its_end),
                          hears_run("broken_run", broken, 5 * kCharacter + 100, to_its_end),
                          hears_run("left_run", broken, 5 * kCharacter + 100, is_left),
                          hears_run("run_into_reset", telegram_to(5), 5 * kCharacter, falls_into_reset)};
  Act left = hears_run("run_left_by_reset", telegram_to(5), 5 * kCharacter, to_its_end);
  left.before = [before = left.before](Chip& chip) {
    before(chip);
    chip.set(chip.now() + 10, Pin::kReset, 0);
  };
  all.push_back(std::move(left));
  return all;
}

/// A read that was reported as too short when sampled is not reported again at its end.
Act sampled_too_early() {
  const Recorded begin = in_data_exchange("").done(0).stimulus;
  const auto before = [begin](Chip& chip) {
    play(chip, begin, 0, begin.end);
    chip.set(begin.end, Pin::kRReq, 1);
    chip.set(begin.end + 200 * kCycle, Pin::kRSta, 1);
    const Tick falls = begin.end + 300 * kCycle;
    chip.set(falls, Pin::kCsr, 0);
    chip.set(falls, Pin::kRd, 0);
    chip.sample(falls + 100);
  };
  return {"sampled_too_early", begin.config, before, [end = begin.end](Chip& chip) {
            chip.set(end + 300 * kCycle + 200, Pin::kRd, 1);
            chip.advance(end + 400 * kCycle);
          }};
}

/// Channels of second masters that send nothing more: they are closed at their timeout.
Act silent_channels(int ms) {
  static const Recorded scenario = recorded("dpv1_c2_two_masters").at(0);
  const Tick from = ms * kMs;
  const auto before = [from](Chip& chip) {
    play(chip, scenario, 0, from);
    chip.advance(from);
  };
  return {"silent_channels_" + std::to_string(ms), scenario.config, before,
          [from](Chip& chip) { chip.advance(from + 2000 * kMs); }};
}

}  // namespace

std::vector<Act> acts() {
  std::vector<Act> all = runs();
  // both idle; a request each; polled for one and for the other while the user has it
  for (const int ms : {200, 251, 253, 255}) all.push_back(silent_channels(ms));
  all.push_back(sampled_too_early());
  return all;
}

std::vector<Aimed> aimed() {
  std::vector<Aimed> all;
  for (unsigned seed = 1; seed <= 4; ++seed) all.push_back(clumsy_user(seed));
  for (unsigned seed = 1; seed <= 4; ++seed) all.push_back(hasty_spi(seed));
  for (unsigned seed = 1; seed <= 2; ++seed) all.push_back(talking_uart(seed));
  all.push_back(racing_spi());
  all.push_back(exact_spi());
  all.push_back(awaking_spi());
  all.push_back(ties_of_spi());
  all.push_back(exact_uart());
  all.push_back(commands());
  all.push_back(acyclic_flags());
  all.push_back(exact_read());
  for (const Pin pin : {Pin::kRReq, Pin::kRSta}) all.push_back(pulses(pin));
  all.push_back(judged_late());
  all.push_back(waiting_watchdog());
  all.push_back(repetitions());
  all.push_back(held_mail());
  all.push_back(unsupported());
  all.push_back(frozen());
  all.push_back(locked_address());
  return all;
}

}  // namespace dsdpv1::state_test
