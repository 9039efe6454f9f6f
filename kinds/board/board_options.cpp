#include "kinds/board/board_options.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "board/firmware/elf_image.hpp"
#include "board/gdb/gdb_server.hpp"
#include "board/gdb/history_player.hpp"
#include "io/input/input_error.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {
namespace {

/// The values were validated when the scenario was read.
arm::Switches switches_of(const BoardKeys& board) {
  arm::Switches switches;
  for (const keys::Name& text : board.switches) {
    const Switch one = *parse_switch(text.text);
    const auto bit = static_cast<std::uint16_t>(1U << one.pin);
    switches.held.at(one.port) |= bit;
    if (one.high) switches.levels.at(one.port) |= bit;
  }
  return switches;
}

/// Flash with the program that the file has now; empty if that is no firmware.
std::vector<std::uint8_t> flash_of(const std::string& elf) {
  constexpr arm::MemoryRange kFlash = arm::FirmwareMemory().flash;
  std::vector<std::uint8_t> flash(kFlash.size, 0xFF);
  try {
    for (const arm::Segment& segment : arm::load_elf(elf).segments)
      if (kFlash.holds(segment.address, segment.bytes.size()))
        std::copy(segment.bytes.begin(), segment.bytes.end(), flash.begin() + (segment.address - kFlash.start));
  } catch (const InputError&) {
    flash.clear();
  }
  return flash;
}

std::unique_ptr<arm::Debugger> make_debugger(const GdbRequest& gdb, arm::DebugTarget& target, const std::string& elf) {
  arm::HistoryPlayer::MakeDebugger server;
  user_cpu::DebugHistory* const way_back = gdb.goes_back ? gdb.history.get() : nullptr;
  if (gdb.port) {
    server = [&gdb, way_back, elf](arm::DebugTarget& noted, std::uint64_t board) {
      return std::make_unique<arm::GdbServer>(
          noted, arm::GdbOptions{*gdb.port, gdb.stopped, gdb.say, way_back, board, [elf] { return flash_of(elf); }});
    };
  }
  return std::make_unique<arm::HistoryPlayer>(target, *gdb.history, server);
}

/// Errors name the scenario's line as well as the file.
std::shared_ptr<const arm::Firmware> firmware_of(const scenario::Scenario& scenario, const keys::Name& elf) {
  try {
    return arm::load_firmware(scenario::resolve(scenario, elf));
  } catch (const InputError& error) {
    throw InputError(scenario.file, elf.line, std::string("elf ") + error.what());
  }
}

}  // namespace

arm::BoardOptions board_options(const UserRequest& request, const BoardKeys& board) {
  arm::BoardOptions options;
  options.firmware = firmware_of(request.scenario, board.elf);
  options.timing.millicycles_per_instruction = static_cast<std::uint32_t>(board.cpi.value_or(0) * 1000);
  if (board.fsmc) options.fsmc = static_cast<const user_cpu::FsmcOverride&>(*board.fsmc);
  options.switches = switches_of(board);
  options.chip = [&chip = request.chip](bus::Tick at) -> const ChipView& {
    chip.sync(at);
    return chip;
  };
  if (const GdbRequest* gdb = request.gdb)
    options.make_debugger = [gdb, elf = options.firmware->path](arm::DebugTarget& target) {
      return make_debugger(*gdb, target, elf);
    };
  return options;
}

}  // namespace dsdpv1::tb
