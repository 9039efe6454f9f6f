#include "kinds/spc3/board/arm_user.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "board/firmware/mailbox.h"
#include "io/input/input_error.hpp"
#include "kinds/board/board_options.hpp"
#include "kinds/board/untold.hpp"
#include "kinds/spc3/kind.hpp"
#include "kinds/spc3/settings.hpp"
#include "model/spc3/pins.hpp"

namespace dsdpv1::tb {
namespace {

arm::Wiring wiring(bool spi) {
  arm::Wiring wiring;
  wiring.interrupt_name = "X/INT";
  wiring.reset_high = true;
  wiring.wait = !spi;
  if (spi) wiring.miso = number(spc3::Pin::kMiso);
  wiring.lamps = {number(spc3::Pin::kXDataExch)};
  return wiring;
}

/// Its driver knows a DSDPV1 only.
void refuse_mailbox(const UserRequest& request, const BoardKeys& board, const arm::Firmware& firmware) {
  if (firmware.mailbox)
    throw InputError(request.scenario.file, board.elf.line,
                     fmt::format("elf {} has a mailbox ({}): it is firmware for a DSDPV1, expected some for {}",
                                 firmware.path, DSDPV1_MAILBOX_SYMBOL, request.slave.kind->name()));
}

MakeUser arm_user(const UserRequest& request, user_cpu::HostBus& pins) {
  const Spc3User& own = spc3_user_of(request.slave.user_cpu);
  arm::BoardOptions options = board_options(request, own);
  refuse_mailbox(request, own, *options.firmware);
  Untold missing = untold(request.scenario, request.slave,
                          {options.firmware->path, "has no mailbox", own.without_mailbox, "SPC3_ERR_"});
  options.notes = std::move(missing.notes);
  request.left_out.merge(missing.left_out);
  const bool spi = static_cast<const Spc3Settings&>(*request.slave.chip).bus == spc3::Bus::kSpi;
  options.wiring = wiring(spi);
  options.serial = spi;
  if (spi) {
    options.mode = HostMode::kSpi;
    options.card = 1;
  }
  return [&chip = request.chip, &pins, options](const user_cpu::StationConfig&, Tick start) {
    const auto set_chip_reset = [&chip](Tick at, bool released) { chip.set_reset(at, released); };
    return std::make_unique<arm::Board>(pins, options, set_chip_reset, start);
  };
}

}  // namespace

void add_spc3_arm_board() { set_spc3_arm_maker(arm_user); }

}  // namespace dsdpv1::tb
