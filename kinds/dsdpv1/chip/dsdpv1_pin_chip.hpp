#pragma once
// A DSDPV1 with its pins on the segment and its host bus: the core, or RTL.
#include <memory>
#include <optional>
#include <string>

#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/dsdpv1/user_cpu/pin_host_bus.hpp"
#include "kinds/dsdpv1/user_cpu/read_spoiler.hpp"
#include "tb/chip/pin_chip.hpp"

namespace dsdpv1::tb {

/// Pins used on a board.
extern const BoardPins kDsdpv1BoardPins;

class Dsdpv1PinChip : public PinChip, private user_cpu::HostBus {
 public:
  Dsdpv1PinChip(const std::string& name, std::unique_ptr<PinDevice> device, Part part, PinMask watched,
                bus::Segment& segment, bool late = false);

  /// Sets the straps of a DSDPV1-RSU, before anything else.
  void strap(const Straps& levels);
  void reset_host(Tick at) override;
  user_cpu::UserSide* user_side() override { return static_cast<user_cpu::HostBus*>(this); }

 private:
  user_cpu::PinHostBus& pins() {
    device();
    return *pins_;
  }
  void catch_up_host(Tick at) override;
  void host_pin_changed(Tick at, PinNumber pin, Level level) override;
  void tell_spoilt(Tick at) { listener_->action(number_, at, "reads a wrong bit"); }
  void report(Tick at, dsdpv1::Pin first, dsdpv1::Pin last);
  void report_access(Tick at);
  void sck_rises(Tick at);
  void run_edges_singly(Tick until);
  bool run_whole();
  void report_whole(const dsdpv1::HostAccess& access, Tick begin);

  // user_cpu::HostBus
  void set_serial(Tick at, dsdpv1::Pin pin, bool level) override;
  bool miso(Tick at) override;
  void set_r_req(Tick at, bool level) override;
  void set_r_sta(Tick at, bool level) override;
  bool l_req(Tick at) override { return pins().l_req(at); }
  bool l_sta(Tick at) override { return pins().l_sta(at); }
  void looked(const user_cpu::Looks& last) override;
  bool intr0(Tick at) override { return pins().intr0(at); }
  unsigned lamps(Tick at) override { return pins().lamps(at); }
  void spoil_reads() override { spoiler_.arm(); }
  /// RTL may need a larger stack than a program has.
  bool is_used_from_anywhere() const override { return core_ != nullptr; }
  void begin(Tick at, const user_cpu::Access& access, const AccessTiming& timing) override;
  Tick next_edge() const override { return pins_->next_edge(); }
  bool put_off() override;
  void run_edges(Tick until) override;
  Tick end() const override { return pins_->end(); }
  std::uint8_t read_value() const override { return pins_->read_value() ^ wrong_bits_; }
  bool last_read_was_bad() const override { return pins_->last_read_was_bad(); }

  const Part part_;
  dsdpv1::Chip* const core_;  ///< null: RTL, which needs each edge
  std::optional<user_cpu::PinHostBus> pins_;
  user_cpu::ReadSpoiler spoiler_;
  std::uint8_t wrong_bits_ = 0;  ///< of the present or last read
};

/// Text of ChipListener::action for an access or a pin moved by the user CPU.
std::string words_of(const user_cpu::Access& access);
std::string words_of(const char* pin, bool level);

}  // namespace dsdpv1::tb
