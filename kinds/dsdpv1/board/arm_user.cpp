#include "kinds/dsdpv1/board/arm_user.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "board/firmware/elf_image.hpp"
#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "kinds/board/board_options.hpp"
#include "kinds/board/untold.hpp"
#include "kinds/dsdpv1/board/mailbox_link.hpp"
#include "kinds/dsdpv1/board/wiring.hpp"
#include "kinds/dsdpv1/chip/user_maker.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "tb/bench/program_options.hpp"

namespace dsdpv1::tb {
namespace {

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

MakeUser arm_user(const UserRequest& request, user_cpu::HostBus& host) {
  ChipView& chip = request.chip;
  const scenario::UserCpu& user = request.slave.user_cpu;
  const Dsdpv1User& own = tb::own(user);
  arm::BoardOptions options = board_options(request, own);
  if (!options.firmware->mailbox) {
    Untold missing = untold(request.scenario, request.slave,
                            {options.firmware->path, fmt::format("has no mailbox ({})", DSDPV1_MAILBOX_SYMBOL),
                             own.without_mailbox, kDriverErrors, user_cpu::kSpoilReads});
    options.notes = std::move(missing.notes);
    request.left_out.merge(missing.left_out);
  }
  check_objects(request.scenario, request.slave, *options.firmware);
  options.carry_out = [&host](const user_cpu::Command& command) { return user_cpu::carry_out(command, host); };
  if (own.access) options.access = static_cast<const AccessTiming&>(*own.access);
  const auto& settings = static_cast<const Dsdpv1Settings&>(*request.slave.chip);
  if (dsdpv1::has_serial_ports(settings.part)) {
    options.serial = true;
    options.mode = settings.mode;
    hold_straps(options.switches, settings);
    if (settings.mode != HostMode::kParallel) options.card = static_cast<unsigned>(settings.address);
  }
  options.wiring = dsdpv1_wiring(options.card);
  return [&user, &chip, &host, options](const user_cpu::StationConfig& station, Tick start) {
    arm::BoardOptions now = options;
    now.make_mailbox = [settings = program_options(user, station)](std::uint8_t* memory) {
      return std::make_unique<arm::MailboxLink>(memory, settings);
    };
    const auto set_chip_reset = [&chip](Tick at, bool released) { chip.set_reset(at, released); };
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
