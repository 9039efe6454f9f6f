#pragma once
// Shared by the two SystemC views of the chip: the core, its place in simulation time, and its reports.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <systemc>
#include <vector>

#include "model/dsdpv1/chip.hpp"
#include "model/systemc/sim_time.hpp"

namespace dsdpv1::systemc {

struct ChipOptions {
  Config chip{};
  Tick phase = 0;                 ///< 0..249 ticks: the rising CLK edge of cycle n is at n * 250 + phase (CLK unbound)
  bool report_violations = true;  ///< SC_REPORT_WARNING /dsdpv1/violation for every violated rule of the user's bus
};

/// Base of the modules; not for direct use.
class ChipModule : public sc_core::sc_module {
 public:
  /// Called for every change of a pin, inputs as the core received them and outputs, in order of time. Ticks are the
  /// chip's: simulation time less the phase. Set it before the simulation starts. It must not call the module.
  std::function<void(Tick at, Pin pin, Level level)> on_pin;
  /// Called for every event of the core (refusals, state changes, violations) at its time; ticks as for `on_pin`.
  std::function<void(const profibus::Event& event)> on_event;

  /// Levels and status of the core at its last evaluation. TlmModule::sync() advances it to the present time.
  const Chip& chip() const { return chip_; }
  Part part() const { return options_.chip.part; }
  Tick phase() const { return options_.phase; }
  /// DPRAM access without pins, time or side effects. `address` 0..0x7FF.
  std::uint8_t peek(std::uint16_t address) const { return chip_.peek(address); }
  void poke(std::uint16_t address, std::uint8_t value) { chip_.poke(address, value); }

 protected:
  ChipModule(const sc_core::sc_module_name& name, const ChipOptions& options);

  /// The chip's tick at simulation tick `tick`; 0 until the first rising edge.
  Tick chip_tick(Tick tick) const { return tick > options_.phase ? tick - options_.phase : 0; }
  /// The chip's tick at the present time, or at the core's time if it is ahead of simulation time.
  Tick chip_now() const { return std::max(fired_as_scheduled() ? scheduled_ : chip_tick(current_tick()), chip_.now()); }

  /// output_changed() is called for the pins in `asked`.
  void watch(std::uint32_t pins, std::uint32_t asked);
  void set(Tick at, Pin pin, Level level);
  void advance(Tick to);
  Level sample(Tick at);
  /// MISO as it is strictly before `at`.
  Level miso_before(Tick at);
  bool carry_out(Tick begin, const HostAccess& access, Level& sampled);
  /// True while the core runs, that is inside of `on_pin` and `on_event`.
  bool is_in_core() const { return in_core_; }
  /// Outputs that changed since the last call.
  std::uint32_t take_changed();
  /// Lets `drive` write this output to the port's signal, if it is bound. After elaboration.
  template <class Port>
  void connect(Pin pin, Port& port) {
    if (port.size() > 0) wires_.push_back({mask(pin), port[0]});
  }
  /// Writes the last reported levels of those `pins` that are connected.
  void drive(std::uint32_t pins);
  bool has_changed(std::uint32_t pins) const { return (changed_ & pins) != 0; }
  /// True if an access of the user has violated the timing of table 15 or P8 since the last call.
  bool take_broken_timing();
  /// Called from inside the core. Return false to hide the change.
  virtual bool output_changed(Tick /*at*/, Pin /*pin*/, Level /*level*/) { return true; }

  /// See Chip.
  bool hear(Tick at, const profibus::CharacterRun& run);
  void leave_run(Tick at);
  profibus::CharacterRun hide_txd();
  void show_txd(Tick at);

  /// Makes `due_` fire at `due`, a tick of the chip, whose present one is `now`; it may fire more often.
  void schedule(Tick now, Tick due);
  /// `due_` has fired at scheduled() in this delta cycle. So no input has changed in it: SystemC fires timed events
  /// when all signals have settled, and changes made at this time come in a later delta cycle.
  bool fired_as_scheduled() const { return sc_core::sc_time_stamp() == scheduled_at_ && due_.triggered(); }
  Tick scheduled() const { return scheduled_; }
  /// Makes `due_` fire in the next delta cycle.
  void schedule_now();
  sc_core::sc_event due_;

 private:
  void pin_changed(Tick at, Pin pin, Level level);
  void event_happened(const profibus::Event& event);

  ChipOptions options_;
  Chip chip_;
  Tick scheduled_ = 0;                                      ///< of the chip; up to now: no notification is pending
  sc_core::sc_time scheduled_at_ = sc_core::sc_max_time();  ///< the same; never: `due_` fires in the next delta cycle
  struct Wire {
    std::uint32_t pin;
    sc_core::sc_signal_inout_if<bool>* signal;
  };
  std::vector<Wire> wires_;
  std::uint32_t asked_ = 0;    ///< outputs for which output_changed() is called
  std::uint32_t changed_ = 0;  ///< the first drive is of all outputs
  std::uint32_t high_ = 0;     ///< ... and the reported levels
  bool broken_timing_ = false;
  bool in_core_ = false;
};

}  // namespace dsdpv1::systemc
