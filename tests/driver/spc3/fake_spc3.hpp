#pragma once
// The RAM and registers of a chip of the SPC3 family as the driver sees them, without time, telegrams and states: a
// test puts there what a telegram would, says what commands answer, and looks at the accesses in their order.
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "driver/spc3/spc3.h"
#include "registers/spc3_regs.hpp"

namespace dsdpv1::spc3 {

struct FakeSpc3 {
  using Bytes = std::vector<std::uint8_t>;
  struct Write {
    std::uint16_t address;
    std::uint8_t value;
  };

  std::array<std::uint8_t, 0x800> ram{};          ///< from 0x016
  std::map<std::uint16_t, std::uint8_t> answers;  ///< of reads below 0x016; others read 00
  std::uint16_t events = 0;                       ///< IRR
  std::function<void(std::uint16_t)> on_command;  ///< a read of 0x009 to 0x014, before its answer
  std::uint16_t ram_end = 0x800;                  ///< beyond it a byte is 400H lower (A3)
  std::vector<Write> writes;
  std::vector<std::uint16_t> commands;

  spc3_port port() { return {this, &read_it, &write_it, nullptr, nullptr}; }

  /// Bytes of the buffer that the cell points to.
  Bytes buffer(std::uint16_t pointer, std::size_t length) const {
    const auto* first = &ram.at(ram.at(pointer) * 8U);
    return {first, first + length};
  }
  void put(std::uint16_t pointer, const Bytes& bytes) {
    std::copy(bytes.begin(), bytes.end(), &ram.at(ram.at(pointer) * 8U));
  }
  /// A telegram: bytes in the buffer, their number, the event.
  void telegram(std::uint16_t length_cell, std::uint16_t event, const Bytes& bytes) {
    ram[length_cell] = static_cast<std::uint8_t>(bytes.size());
    put(static_cast<std::uint16_t>(length_cell + 1), bytes);
    events = static_cast<std::uint16_t>(events | event);
  }
  /// How often a command was given.
  int count(std::uint16_t command) const {
    return static_cast<int>(std::count(commands.begin(), commands.end(), command));
  }
  /// The last value written there, -1 if none was.
  int last(std::uint16_t address) const {
    int value = -1;
    for (const Write& each : writes)
      if (each.address == address) value = each.value;
    return value;
  }

 private:
  static std::uint8_t read_it(void* ctx, std::uint16_t address) { return static_cast<FakeSpc3*>(ctx)->read(address); }
  static void write_it(void* ctx, std::uint16_t address, std::uint8_t value) {
    static_cast<FakeSpc3*>(ctx)->write(address, value);
  }
  std::uint8_t& cell(std::uint16_t address) { return ram.at(address < ram_end ? address : address - 0x400U); }

  std::uint8_t read(std::uint16_t address) {
    if (address >= regs::kOrg) return cell(address);
    if (address == regs::kIrr || address == regs::kIrr + 1)
      return static_cast<std::uint8_t>(events >> (8 * (address - regs::kIrr)));
    if (is_command(address)) {
      commands.push_back(address);
      if (on_command) on_command(address);
      answered(address);
    }
    return answers[address];
  }
  /// An answer other than 01 clears its event (A14).
  void answered(std::uint16_t address) {
    const bool prm = address == regs::kPrmOk || address == regs::kPrmNotOk;
    const bool cfg = address == regs::kCfgOk || address == regs::kCfgNotOk;
    if ((!prm && !cfg) || answers[address] == regs::kVerdictConflict) return;
    events = static_cast<std::uint16_t>(events & ~(prm ? regs::kEventNewPrm : regs::kEventNewCfg));
  }
  static bool is_command(std::uint16_t address) {
    for (const regs::Cell& each : regs::kMap)
      if (each.command && address == each.first) return true;
    return false;
  }
  void write(std::uint16_t address, std::uint8_t value) {
    writes.push_back({address, value});
    if (address >= regs::kOrg) cell(address) = value;
    if (address == regs::kIar) acknowledge(value);
    if (address == regs::kIar + 1) acknowledge(value << 8);
  }
  void acknowledge(int bits) { events = static_cast<std::uint16_t>(events & ~(bits & ~0x0C00)); }
};

}  // namespace dsdpv1::spc3
