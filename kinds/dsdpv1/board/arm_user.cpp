#include "kinds/dsdpv1/board/arm_user.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "board/firmware/elf_image.hpp"
#include "board/gdb/gdb_server.hpp"
#include "board/gdb/history_player.hpp"
#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "kinds/dsdpv1/board/board.hpp"
#include "kinds/dsdpv1/chip/untold.hpp"
#include "kinds/dsdpv1/chip/user_maker.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "tb/bench/program_options.hpp"

namespace dsdpv1::tb {
namespace {

/// The values were validated when the scenario was read.
arm::Switches switches_of(const Dsdpv1User& user) {
  arm::Switches switches;
  for (const Name& text : user.switches) {
    const Switch one = *parse_switch(text.text);
    const auto bit = static_cast<std::uint16_t>(1U << one.pin);
    switches.held.at(one.port) |= bit;
    if (one.high) switches.levels.at(one.port) |= bit;
  }
  return switches;
}

/// The straps of a DSDPV1-RSU, which the processor also reads (R13): MODE at PC10 PC11, ADR PB0 PB1, UBR PD8 to PD10,
/// UIV PE13 to PE15, bit 0 at the lower pin (p).
void hold_straps(arm::Switches& switches, const Dsdpv1Settings& chip) {
  struct Place {
    unsigned port, pin, count;
  };
  static constexpr std::array<Place, 4> kPlaces = {{{2, 10, 2}, {1, 0, 2}, {3, 8, 3}, {4, 13, 3}}};
  const Straps levels = straps_of(chip);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const Place& at = kPlaces.at(i);
    switches.held.at(at.port) |= static_cast<std::uint16_t>(((1U << at.count) - 1) << at.pin);
    switches.levels.at(at.port) |= static_cast<std::uint16_t>(static_cast<unsigned>(levels.at(i)) << at.pin);
  }
}

/// Limited by the room in the mailbox.
void check_objects(const scenario::Scenario& scenario, const scenario::Slave& slave, const arm::Firmware& firmware) {
  const std::size_t count = slave.user_cpu.dpv1.objects.size();
  if (firmware.mailbox && count > DSDPV1_MAILBOX_OBJECTS)
    throw InputError(scenario.file, slave.user_cpu.dpv1.line,
                     fmt::format("dpv1 has {} objects, allowed on an ARM board are {}", count, DSDPV1_MAILBOX_OBJECTS));
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
std::shared_ptr<const arm::Firmware> firmware_of(const scenario::Scenario& scenario, const Name& elf) {
  try {
    return arm::load_firmware(scenario::resolve(scenario, elf));
  } catch (const InputError& error) {
    throw InputError(scenario.file, elf.line, std::string("elf ") + error.what());
  }
}

MakeUser arm_user(const UserRequest& request, user_cpu::HostBus& host) {
  ChipView& chip = request.chip;
  const scenario::UserCpu& user = request.slave.user_cpu;
  const Dsdpv1User& own = tb::own(user);
  arm::BoardOptions options;
  options.firmware = firmware_of(request.scenario, own.elf);
  if (!options.firmware->mailbox) {
    Untold missing = untold(request.scenario, request.slave, options.firmware->path,
                            fmt::format("has no mailbox ({})", DSDPV1_MAILBOX_SYMBOL));
    options.notes = std::move(missing.notes);
    request.left_out.merge(missing.left_out);
  }
  check_objects(request.scenario, request.slave, *options.firmware);
  options.timing.millicycles_per_instruction = static_cast<std::uint32_t>(own.cpi.value_or(0) * 1000);
  if (own.fsmc) options.fsmc = static_cast<const user_cpu::FsmcOverride&>(*own.fsmc);
  if (own.access) options.access = static_cast<const AccessTiming&>(*own.access);
  options.switches = switches_of(own);
  const auto& settings = static_cast<const Dsdpv1Settings&>(*request.slave.chip);
  if (dsdpv1::has_serial_ports(settings.part)) {
    options.serial = true;
    options.mode = settings.mode;
    hold_straps(options.switches, settings);
    if (settings.mode != HostMode::kParallel) options.card = static_cast<unsigned>(settings.address);
  }
  if (const GdbRequest* gdb = request.gdb)
    options.make_debugger = [gdb, elf = options.firmware->path](arm::DebugTarget& target) {
      return make_debugger(*gdb, target, elf);
    };
  return [&user, &chip, &host, options](const user_cpu::StationConfig& station, Tick start) {
    arm::BoardOptions now = options;
    now.program = program_options(user, station);
    now.chip = [&chip](Tick at) -> const ChipView& {
      chip.sync(at);
      return chip;
    };
    const auto set_chip_reset = [&chip](Tick at, bool level) { chip.set_reset(at, level); };
    return std::make_unique<arm::Board>(host, std::move(now), set_chip_reset, start);
  };
}

/// Of a program of this computer.
user_cpu::PlaceOf lines_of(const std::string& program) {
  constexpr std::size_t kMostMb = 256;
  const ReadFile file = try_read_file(program, kMostMb);
  const auto lines = std::make_shared<arm::SourceLines>(arm::ElfImage(),
                                                        std::vector<std::uint8_t>(file.text.begin(), file.text.end()));
  return [lines](std::uint32_t address) {
    const arm::SourceLine line = lines->line_of(address);
    return user_cpu::Place{line.file, line.line, line.function, address};
  };
}

}  // namespace

void add_arm_board() {
  set_arm_maker(arm_user);
  set_line_reader(lines_of);
}

}  // namespace dsdpv1::tb
