#pragma once
// The microcontroller of an XGate-DPS10 (docs/xgate.md), beside a station with its user's side: the chip's
// owner has both (module.hpp). It is evaluated at an edge before the station.
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

class Firmware {
 public:
  /// `config` and the other parts outlive it; `user`, of `station`, has kCapacities.
  Firmware(profibus::EventLog& log, const Config& config, profibus::UserSide& user, profibus::Station& station)
      : config_(config),
        log_(log),
        bus_(log, config, user, station),
        link_(config),
        serial_(config.serial),
        name_(config.name) {}

  // --- pins ---------------------------------------------------------------------------------------------------------
  /// /Rst, after the reset of the slave, and /ISP-CFG; `low` is their level.
  void set_reset(Cycle now, bool low);
  void set_config_pin(bool low) { config_pin_low_ = low; }
  /// /INT is low: something waits for the host (4.4.1; X12, X14).
  bool interrupt() const;
  bool led(Led led, Cycle now) const { return leds_.level(led, shown_leds(), now); }

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
  /// The rising edge of `now`, before the station's.
  void eval(Cycle now);
  /// The next edge after `now` at which it, or a LED, does something.
  Cycle next(Cycle now) const;

  ModuleState state() const { return state_; }
  const Fieldbus& bus() const { return bus_; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [settings, log, bus, link, leds, answer, serial, name, state, config_pin, given, dog_on, bitten, dog_value,
           opens, shown_until, dog_ends] = *this;
    archive.given(settings, log);
    archive.scratch(answer);
    archive(bus, link, leds, serial, name, config_pin, given, dog_on, bitten, dog_value);
    archive.within(ModuleState::kReset, ModuleState::kConfiguring, state);
    archive.cycles(opens, shown_until, dog_ends);
  }
  void take_over(const Firmware& observed) { link_.take_over(observed.link_); }

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

  const Config& config_;
  profibus::EventLog& log_;
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
  Cycle opens_ = profibus::kNever;
  Cycle shown_until_ = profibus::kNever;  ///< LED2 shows the last command
  Cycle dog_ends_ = profibus::kNever;
};

}  // namespace dsdpv1::xgate
