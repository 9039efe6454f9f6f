// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// own_slave.cpp: a slave chip with 16 registers on an 8-bit bus, 4 bytes of outputs, 4 of inputs, and INT
#include <array>
#include <iterator>

#include "apps/program.hpp"
#include "tb/kit/slave_kit.hpp"

using namespace dsdpv1;
using kit::Cycle;
using kit::Level;
using kit::PinNumber;
using kit::Tick;
using profibus::kNever;

enum : std::size_t { kStarted, kBadAddress };
const profibus::ReasonRow kReasons[] = {  // severity, code, source, text, advice
    {profibus::Severity::kInfo, "STARTED", "", "started: address {a}, ident {b:4x}",
     "Nothing: the baud search begins."},
    {profibus::Severity::kRefusal, "START_ADDRESS", "", "start refused: address {a} is above 125", "Write 0 to 125."}};

// own_slave.cpp: pins (name, direction, level of rest, wires, bus) and registers
enum : PinNumber { kCs = kit::kOwn, kRd, kWr, kA, kDIn, kDOut, kInt };
const std::vector<kit::Pin> kPins = {{"CS", kit::kInput, 1},
                                     {"RD", kit::kInput, 1},
                                     {"WR", kit::kInput, 1},
                                     {"A", kit::kInput, 0, 4},
                                     {"D_IN", kit::kInput, kit::kReleased, 8, "D"},
                                     {"D_OUT", kit::kOutput, kit::kReleased, 8, "D"},
                                     {"INT", kit::kOutput, 1}};

// Read: 0 the DP state, bit 7 new outputs; 4 to 7 outputs, of which 4 ends INT.
constexpr int kBytes = 4, kRegisters = 16;
enum Register : std::size_t { kCommand, kAddress, kIdentHigh, kIdentLow, kOutputs = 4, kInputs = 8 };
enum Command : std::uint8_t { kStart = 1, kTakeInputs = 2 };

// own_slave.cpp: the port
class RegisterPort : public kit::UserPort {
 public:
  explicit RegisterPort(kit::Chip& chip) : chip_(chip) {}

  void reset() override {
    written_ = {};
    acts_at_ = shows_at_ = kNever;
  }
  // A read drives D as long as CS and RD are low. A write is taken with WR's rise, acts one edge after that which sees
  // it.
  void input(Tick at, PinNumber pin, Level level) override {
    const bool selected = chip_.level(kCs) == 0;
    if (pin == kWr && level == 1 && selected) {
      register_ = static_cast<std::size_t>(chip_.level(kA));
      value_ = static_cast<std::uint8_t>(std::max<Level>(chip_.level(kDIn), 0));
      acts_at_ = profibus::first_edge_after(at) + 1;
    }
    if (pin != kCs && pin != kRd && pin != kA) return;
    const bool reads = selected && chip_.level(kRd) == 0;
    chip_.drive(at, kDOut, reads ? read(at, static_cast<std::size_t>(chip_.level(kA))) : kit::kReleased);
  }
  void eval(Cycle now) override {
    if (now == shows_at_) shows_at_ = kNever;
    if (now != acts_at_) return;
    acts_at_ = kNever;
    written_[register_] = value_;
    if (register_ == kCommand && value_ == kStart) start(now);
    if (register_ == kCommand && value_ == kTakeInputs) chip_.user().new_inputs(now, &written_[kInputs], kBytes);
  }
  void show(Cycle now) override { chip_.drive_at(now, kInt, due().waiting() ? 0 : 1); }
  Cycle next() const override { return std::min(acts_at_, shows_at_); }

 private:
  profibus::Due& due() { return chip_.user().mail().output.due; }
  Level read(Tick at, std::size_t number) {
    if (number == kCommand)
      return static_cast<Level>(static_cast<int>(chip_.slave().state()) | (due().waiting() ? 0x80 : 0));
    if (number < kOutputs || number >= kOutputs + kBytes) return written_[number];
    if (number == kOutputs) {  // one block: the others are those of now
      shown_ = chip_.user().outputs();
      due().clear();
      shows_at_ = profibus::first_edge_after(at);  // INT rises there
    }
    return shown_.bytes[number - kOutputs];
  }
  void start(Cycle now) {
    profibus::SlaveConfig config;
    config.address = written_[kAddress];
    config.ident = static_cast<std::uint16_t>(written_[kIdentHigh] << 8 | written_[kIdentLow]);
    if (config.address > 125) return chip_.say(now, kReasons[kBadAddress], config.address);
    config.max_input = config.max_output = kBytes;
    config.max_cfg = kCfg.size();
    config.prm_mode = config.cfg_mode = profibus::Judging::kExact;  // no user parameters, just this configuration
    config.cfg.assign(kCfg.data(), kCfg.size());
    chip_.say(now, kReasons[kStarted], config.address, config.ident);
    chip_.user().initialise(now, config);
  }

  static constexpr std::array<std::uint8_t, 2> kCfg = {0x13, 0x23};  // 4 bytes of inputs, 4 of outputs
  kit::Chip& chip_;
  std::array<std::uint8_t, kRegisters> written_{};
  profibus::IoBlock shown_;
  std::size_t register_ = 0;
  std::uint8_t value_ = 0;
  Cycle acts_at_ = kNever, shows_at_ = kNever;
};

// own_slave.cpp: the firmware
constexpr Tick kNs = kit::kTicksPerNs;

void write(kit::Cpu& cpu, std::size_t number, std::uint8_t value) {
  cpu.set(kA, static_cast<Level>(number));
  cpu.set(kDIn, value);
  cpu.set(kCs, 0);
  cpu.set(kWr, 0);
  cpu.wait(50 * kNs);
  cpu.set(kWr, 1);
  cpu.wait(50 * kNs);
  cpu.set(kCs, 1);
  cpu.set(kDIn, kit::kReleased);
}

std::uint8_t read(kit::Cpu& cpu, std::size_t number) {
  cpu.set(kA, static_cast<Level>(number));
  cpu.set(kCs, 0);
  cpu.set(kRd, 0);
  cpu.wait(50 * kNs);
  const auto value = static_cast<std::uint8_t>(cpu.level(kDOut));
  cpu.set(kRd, 1);
  cpu.set(kCs, 1);
  cpu.wait(20 * kNs);
  return value;
}

void firmware(kit::Cpu& cpu) {
  cpu.wait(10 * bus::kTicksPerUs);  // the chip leaves RESET in three edges
  write(cpu, kAddress, cpu.station().address);
  write(cpu, kIdentHigh, static_cast<std::uint8_t>(cpu.station().ident >> 8));
  write(cpu, kIdentLow, static_cast<std::uint8_t>(cpu.station().ident & 0xFF));
  write(cpu, kCommand, kStart);
  for (Tick turn = cpu.now();; turn += cpu.period()) {
    cpu.wait_until(turn);
    if (cpu.level(kInt) == 0) {
      std::vector<std::uint8_t> outputs;
      for (std::size_t i = 0; i < kBytes; ++i) outputs.push_back(read(cpu, kOutputs + i));
      cpu.received(outputs);
    }
    std::size_t number = kInputs;
    for (const std::uint8_t byte : cpu.inputs(kBytes)) write(cpu, number++, byte);
    write(cpu, kCommand, kTakeInputs);
    cpu.written();
  }
}

// own_slave.cpp: the kind, and the program
kit::Parts make_parts() {
  kit::Parts parts;
  parts.name = "own_slave";
  parts.title = "16-register slave";
  parts.pins = kPins;
  parts.interrupt = kInt;
  parts.capacities = {0, 2, kBytes, 0};  // user parameters, configuration, inputs and outputs, acyclic data
  parts.reasons = {kReasons, std::size(kReasons)};
  parts.words.ident = "registers 2 and 3";
  parts.words.new_block = "INT";
  parts.port = [](kit::Chip& chip) { return std::make_unique<RegisterPort>(chip); };
  parts.program = firmware;
  return parts;
}

tb::ChipKinds make_kinds() {
  static const kit::Kind kind(make_parts());
  return {&kind};
}

int main(int argc, char** argv) { return app::program(argc, argv, "own_slave", make_kinds); }
