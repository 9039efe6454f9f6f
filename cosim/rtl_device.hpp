#pragma once
// RTL as the chip of a bench: the RTL drives the pins. A core with the same inputs reports what pins do not show:
// states and events, and when data are X. A two-state simulation has no X: where P5 and section 12 of the
// microarchitecture leave D unknown the RTL drives some value, which the bench must not see.
#include <algorithm>
#include <memory>
#include <vector>

#include "cosim/rtl_chip.hpp"

namespace dsdpv1::cosim {

class RtlDevice : public tb::PinDevice {
 public:
  /// `core`, fresh from ChipKind::make_device, and `rtl` with these parameters. The kind must have an RtlOf.
  RtlDevice(std::unique_ptr<tb::PinDevice> core, std::unique_ptr<Rtl> rtl, const tb::ChipKind& kind,
            const tb::OwnSettings& chip);

  void set(Tick at, PinNumber pin, Level level) override;
  void advance(Tick to) override;
  Tick now() const override { return rtl_.now(); }
  Level level(PinNumber pin) const override {
    return pin == data_ ? d_ : is_unknown(pin) ? tb::kLevelX : rtl_.level(pin);
  }
  Level sample(Tick at) override;
  Tick next_event() const override { return std::min(rtl_.next_event(), core_->next_event()); }
  void watch(const tb::PinSink& sink, tb::PinMask pins) override;
  void on_event(const profibus::EventSink& sink) override { core_->on_event(sink); }
  tb::ChipStatus status() const override { return core_->status(); }
  std::uint8_t address() const override { return core_->address(); }
  std::uint8_t peek(std::uint16_t address) const override { return core_->peek(address); }
  void poke(std::uint16_t address, std::uint8_t value) override { core_->poke(address, value); }

 private:
  struct Change {
    Tick at;
    PinNumber pin;
    Level level;
  };
  bool is_unknown(PinNumber pin) const { return (unknown_ & tb::mask_of(pin)) != 0; }
  void pass_on();
  void pass_on_tick(Tick at);
  void tell(Tick at, PinNumber pin, Level level);

  std::unique_ptr<tb::PinDevice> core_;
  RtlChip rtl_;
  const PinNumber data_;     ///< the output on a bus of data; kNoPin: none
  tb::PinMask unknown_ = 0;  ///< other outputs that the model does not know: they are X
  tb::PinSink sink_;
  tb::PinMask watched_ = 0;
  std::vector<Change> core_changes_, rtl_changes_;  ///< since pass_on; from the core only data
  std::size_t core_next_ = 0, rtl_next_ = 0;
  Level core_d_ = tb::kLevelZ, rtl_d_ = tb::kLevelZ, d_ = tb::kLevelZ;
};

/// The output of a kind's pins that is on a bus.
PinNumber data_output(const tb::PinTable& pins);

}  // namespace dsdpv1::cosim
