#pragma once
// The XGate-DPS10: a module with a UART or SPI for the user's CPU, and a DPV1 slave (docs/xgate.md). Functional:
// frames, order and states are the data sheet's, times on the host's side are parameters. Plain C++17, no heap.
//
//   Module module;                         // /Rst is low
//   module.set_reset(1, false);
//   module.receive(cycle, 0x7E);           // the host's bytes, each at the end of its stop bit
//   while (module.next() <= cycle) module.eval(module.next());
//
// Inputs at cycle n follow eval(n), if next() has named n. Evaluating only named cycles is the same as evaluating every
// one.
#include <memory>
#include <vector>

#include "model/profibus/state_frame.hpp"
#include "model/xgate/firmware.hpp"

namespace dsdpv1::xgate {

class Module {
 public:
  explicit Module(const Config& settings = {});
  Module(const Module&) = delete;  // its parts refer to each other
  Module& operator=(const Module&) = delete;

  // --- pins ---------------------------------------------------------------------------------------------------------
  /// /Rst and /ISP-CFG; `low` is their level.
  void set_reset(Cycle now, bool low);
  void set_config_pin(bool low) { firmware_.set_config_pin(low); }
  /// P-RXD, see Station::set_rxd. P-TXD, P-RTS.
  bool set_rxd(profibus::Tick at, bool level) { return station_.set_rxd(at, level); }
  bool txd() const { return station_.txd(); }
  bool rts() const { return station_.rts(); }
  /// /INT is low.
  bool interrupt() const { return firmware_.interrupt(); }
  bool led(Led led) const { return firmware_.led(led, now_); }

  // --- the host: see Firmware ---------------------------------------------------------------------------------------
  void receive(Cycle now, std::uint8_t byte) { firmware_.receive(now, byte); }
  void on_byte(const ByteSink& sink) { firmware_.on_byte(sink); }
  std::uint32_t rate() const { return firmware_.rate(); }
  std::uint8_t begin_byte() { return firmware_.begin_byte(); }
  void end_byte(Cycle now, std::uint8_t mosi) { firmware_.end_byte(now, mosi); }
  void cut_byte() { firmware_.cut_byte(); }

  // --- time ---------------------------------------------------------------------------------------------------------
  /// The rising edge of `now`, of 48 MHz.
  void eval(Cycle now);
  Cycle next() const;

  void on_event(const profibus::EventSink& sink) { log_.attach(sink); }
  ModuleState state() const { return firmware_.state(); }
  const Fieldbus& bus() const { return firmware_.bus(); }

  /// For save_chip and restore_chip, as the next two.
  template <class Archive>
  void store(Archive& archive) {
    auto& [settings, log, user, station, firmware, now] = *this;
    archive.given(settings, log);
    station.store(archive, user);
    archive(firmware);
    archive.cycles(now);
  }
  void take_over(const Module& observed) {
    log_ = observed.log_;
    firmware_.take_over(observed.firmware_);
  }
  const Config config;

 private:
  profibus::EventLog log_;
  profibus::UserSide user_;
  profibus::Station station_;
  Firmware firmware_;
  Cycle now_ = 0;
};

/// The complete state, for the same Config in this process or another. Throws StateError, leaving the module as it is,
/// if the bytes are not from save() of such a module.
std::vector<std::uint8_t> save(Module& module);
void restore(std::unique_ptr<Module>& module, const std::uint8_t* bytes, std::size_t size);

}  // namespace dsdpv1::xgate
