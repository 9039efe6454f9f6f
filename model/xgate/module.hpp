#pragma once
// The XGate-DPS10: a module with a UART or SPI for the user's CPU, and a DPV1 slave (docs/xgate.md). Functional:
// frames, order and states are the data sheet's, times on the host's side are parameters. Plain C++17, no heap.
//
//   Module module;                         // /Rst is low
//   module.set_reset(1, false);
//   module.receive(cycle, 0x7E);           // the host's bytes, each at the end of its stop bit
//   while (module.next() <= cycle) module.eval(module.next());
//
// Inputs at cycle n follow eval(n) of a cycle that next() has named. Evaluating only those cycles is the same as
// evaluating every one.
#include <memory>
#include <vector>

#include "model/profibus/state_frame.hpp"
#include "model/xgate/fieldbus.hpp"
#include "model/xgate/host_link.hpp"
#include "model/xgate/leds.hpp"

namespace dsdpv1::xgate {

/// X15, X18, X25.
enum class ModuleState : std::uint8_t {
  kReset,        ///< /Rst is low
  kPower,        ///< the firmware starts, no frames yet
  kReady,        ///< frames are served, silent on PROFIBUS
  kStarted,      ///< a slave: WAIT_PRM, WAIT_CFG, data exchange
  kAsleep,       ///< command 12: silent on PROFIBUS
  kStopped,      ///< command 12: until /Rst
  kConfiguring,  ///< /ISP-CFG was low: the PC tool's protocol, which is in no text
};

class Module {
 public:
  explicit Module(const Config& config = {});
  Module(const Module&) = delete;  // its parts refer to each other
  Module& operator=(const Module&) = delete;

  // --- pins ---------------------------------------------------------------------------------------------------------
  /// /Rst and /ISP-CFG; `low` is their level.
  void set_reset(Cycle now, bool low);
  void set_config_pin(bool low) { config_pin_low_ = low; }
  /// P-RXD, see Station::set_rxd. P-TXD, P-RTS.
  bool set_rxd(profibus::Tick at, bool level) { return bus_.station().set_rxd(at, level); }
  bool txd() const { return bus_.station().txd(); }
  bool rts() const { return bus_.station().rts(); }
  /// /INT is low: something waits for the host (4.4.1; X12, X14).
  bool interrupt() const;
  bool led(Led led) const { return leds_.level(led, shown_leds(), now_); }

  // --- the host -----------------------------------------------------------------------------------------------------
  /// UART: a byte whose stop bit ends at `now`. Answers go to the sink, at rate().
  void receive(Cycle now, std::uint8_t byte);
  void on_byte(const ByteSink& sink) { link_.attach(sink); }
  std::uint32_t rate() const { return link_.rate(); }
  /// SPI: see HostLink.
  std::uint8_t begin_byte() { return serves() ? link_.begin_byte() : HostLink::kIdle; }
  void end_byte(Cycle now, std::uint8_t mosi);
  void cut_byte() { link_.cut_byte(); }

  // --- time ---------------------------------------------------------------------------------------------------------
  /// The rising edge of `now`, of 48 MHz.
  void eval(Cycle now);
  Cycle next() const;

  void on_event(const profibus::EventSink& sink) { log_.attach(sink); }
  ModuleState state() const { return state_; }
  const Fieldbus& bus() const { return bus_; }
  Cycle now() const { return now_; }

  /// For save_chip and restore_chip, as the next two.
  template <class Archive>
  void store(Archive& archive) {
    auto& [settings, log, bus, link, leds, answer, serial, name, state, config_pin, given, dog_on, bitten, dog_value,
           now, opens, shown_until, dog_ends] = *this;
    archive.given(settings, log);
    archive.scratch(answer);
    bus.store(archive);
    archive(link, leds, serial, name, config_pin, given, dog_on, bitten, dog_value);
    archive.within(ModuleState::kReset, ModuleState::kConfiguring, state);
    archive.cycles(now, opens, shown_until, dog_ends);
  }
  void take_over(const Module& observed) {
    log_ = observed.log_;
    link_.take_over(observed.link_);
  }
  const Config config;

 private:
  struct Command;
  static const Command kCommands[];

  bool serves() const { return state_ >= ModuleState::kReady && state_ <= ModuleState::kStopped; }
  bool started() const { return state_ == ModuleState::kStarted; }
  ShownLeds shown_leds() const;
  void watch(Cycle now);
  void feed(Cycle now);
  void carry_out(Cycle now);
  Error run(Cycle now, const Frame& frame);

  // commands.cpp, in the order of 4.5.1
  Error read_device(Cycle now, const Frame& frame);
  Error write_device(Cycle now, const Frame& frame);
  Error set_rate(Cycle now, const Frame& frame);
  Error initialise(Cycle now, const Frame& frame);
  Error set_mode(Cycle now, const Frame& frame);
  Error set_step(Cycle now, const Frame& frame);
  Error set_leds(Cycle now, const Frame& frame);
  Error set_watchdog(Cycle now, const Frame& frame);
  Error exchange(Cycle now, const Frame& frame);
  Error exchange_known(Cycle now, const Frame& frame);
  Error read_prm(Cycle now, const Frame& frame);
  Error read_cfg(Cycle now, const Frame& frame);
  Error read_lengths(Cycle now, const Frame& frame);
  Error answer_requests(Cycle now, const Frame& frame);
  Error diagnose(Cycle now, const Frame& frame);
  Error step_again(Cycle now, unsigned step);
  void wake(Cycle now);
  void answer_outputs();

  profibus::EventLog log_;
  Fieldbus bus_;
  HostLink link_;
  Leds leds_;
  Frame answer_;
  Words serial_, name_;
  ModuleState state_ = ModuleState::kReset;
  bool config_pin_low_ = false;
  bool given_ = false;  ///< command 04 was right
  bool dog_on_ = false, bitten_ = false;
  std::uint8_t dog_value_ = 0;
  Cycle now_ = 0, opens_ = profibus::kNever;
  Cycle shown_until_ = profibus::kNever;  ///< LED2 shows the last command
  Cycle dog_ends_ = profibus::kNever;
};

/// The complete state, for the same Config in this process or another. Throws StateError, leaving the module as it is,
/// if the bytes are not from save() of such a module.
std::vector<std::uint8_t> save(Module& module);
void restore(std::unique_ptr<Module>& module, const std::uint8_t* bytes, std::size_t size);

}  // namespace dsdpv1::xgate
