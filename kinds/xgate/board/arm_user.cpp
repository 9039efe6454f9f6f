#include "kinds/xgate/board/arm_user.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "board/firmware/mailbox.h"
#include "io/input/input_error.hpp"
#include "kinds/board/board_options.hpp"
#include "kinds/board/untold.hpp"
#include "kinds/xgate/host_line.hpp"
#include "kinds/xgate/kind.hpp"
#include "kinds/xgate/pins.hpp"
#include "kinds/xgate/settings.hpp"
#include "tb/kit/user.hpp"

namespace dsdpv1::xgate {
namespace {

/// The module's pins for the board. Nothing is at NE1: a read there has FF, and accesses take no time.
class BoardPins : public user_cpu::HostBus {
 public:
  explicit BoardPins(kit::OwnPins& pins) : pins_(pins) {
    pins_.on_change = [this](Tick at, kit::PinNumber pin, kit::Level level) {
      if (pin == kHostTxd && on_txd) on_txd(at, level != 0);
    };
  }
  ~BoardPins() override { pins_.on_change = nullptr; }
  BoardPins(const BoardPins&) = delete;
  BoardPins& operator=(const BoardPins&) = delete;

  void set_serial(Tick at, dsdpv1::Pin pin, bool level) override { pins_.set(at, bench_pin(pin), level ? 1 : 0); }
  /// Released, it is pulled up.
  bool miso(Tick /*at*/) override { return pins_.level(kMiso) != 0; }

  void begin(Tick at, const user_cpu::Access& /*access*/, const AccessTiming& /*timing*/) override { end_ = at; }
  Tick next_edge() const override { return bus::kNever; }
  void run_edges(Tick /*until*/) override {}
  Tick end() const override { return end_; }
  std::uint8_t read_value() const override { return 0xFF; }
  bool last_read_was_bad() const override { return false; }

 private:
  kit::OwnPins& pins_;
  Tick end_ = 0;
};

arm::BoardOptions options_of(const tb::UserRequest& request, const UserSettings& own, bool spi) {
  arm::BoardOptions options = tb::board_options(request, own);
  if (options.firmware->mailbox)
    throw tb::InputError(request.scenario.file, own.elf.line,
                         fmt::format("elf {} has a mailbox ({}): it is firmware for a DSDPV1, expected some for {}",
                                     options.firmware->path, DSDPV1_MAILBOX_SYMBOL, request.slave.kind->name()));
  tb::Untold missing = tb::untold(request.scenario, request.slave,
                                  {options.firmware->path, "has no mailbox", own.without_mailbox, "XGATE_ERR_"});
  options.notes = std::move(missing.notes);
  request.left_out.merge(missing.left_out);
  options.wiring.interrupt_name = "/INT";
  options.serial = true;
  options.card = 1;
  options.mode = spi ? HostMode::kSpi : HostMode::kUart;
  if (spi) options.wiring.miso = kMiso;
  return options;
}

tb::MakeUser arm_user(const tb::UserRequest& request) {
  const bool spi = chip_settings_of(*request.slave.chip).port == Port::kSpi;
  const auto pins = std::make_shared<BoardPins>(static_cast<kit::OwnPins&>(*request.chip.user_side()));
  return
      [&chip = request.chip, pins, options = options_of(request, user_settings_of(*request.slave.user_cpu.own), spi)](
          const user_cpu::StationConfig&, Tick start) {
        const auto set_chip_reset = [&chip](Tick at, bool released) { chip.set_reset(at, released); };
        return std::make_unique<arm::Board>(*pins, options, set_chip_reset, start);
      };
}

}  // namespace

void add_arm_board() { set_arm_maker(arm_user); }

}  // namespace dsdpv1::xgate
