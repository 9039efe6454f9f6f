#pragma once
// Shared by the SystemC views of all chips: a core's place in simulation time, its outputs as signals, and its reports.
#include <algorithm>
#include <cstdint>
#include <exception>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <systemc>
#include <utility>
#include <vector>

#include "model/profibus/character_run.hpp"
#include "model/profibus/event.hpp"
#include "model/profibus/state_frame.hpp"
#include "model/systemc/module_reports.hpp"
#include "model/systemc/parameters.hpp"
#include "model/systemc/sim_time.hpp"

namespace dsdpv1::systemc {

struct ModuleOptions {
  Tick phase = 0;                 ///< 0..249 ticks: the rising CLK edge of cycle n is at n * 250 + phase (CLK unbound)
  bool report_violations = true;  ///< SC_REPORT_WARNING /dsdpv1/violation for every violated rule of the user's bus
};

/// The part that serves any kind of chip.
class TimedModule : public sc_core::sc_module {
 public:
  Tick phase() const { return phase_; }
  /// The chip's tick at simulation tick `tick`; 0 until the first rising edge.
  Tick chip_tick(Tick tick) const { return tick > zero_ ? tick - zero_ : 0; }
  /// The simulation tick of the chip's tick 0: phase(), unless restore() has moved it.
  Tick zero() const { return zero_; }

 protected:
  TimedModule(const sc_core::sc_module_name& name, Tick phase);

  /// Adds an attribute for each parameter, sc_attribute<std::uint32_t>, to be read.
  template <class Config>
  void list_parameters(Config config) {
    each_parameter(
        config,
        [this](const ParameterRow& row, std::uint32_t value) {
          parameters_.push_back(std::make_unique<sc_core::sc_attribute<std::uint32_t>>(row.name, value));
          add_attribute(*parameters_.back());
        });
  }

  /// A transaction has the bus.
  static bool is_taken(sc_core::sc_mutex& bus) { return bus.trylock() != 0 || bus.unlock() != 0; }

  /// The chip's tick at the present time, or `core`, that of its core, if it is ahead of simulation time.
  Tick at_least(Tick core) const {
    return std::max(fired_as_scheduled() ? scheduled_ : chip_tick(current_tick()), core);
  }

  /// True while the core runs, that is inside of `on_pin` and `on_event`.
  bool is_in_core() const { return in_core_; }
  /// Runs the core. An exception of an observer leaves when the core has returned, so that the core stays consistent.
  template <class Call>
  void in_core(const Call& call) {
    {
      const WhileTrue core(in_core_);
      call();
    }
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  }
  /// Makes a step of a release, whose other steps must be made, too. Returns what it has thrown.
  template <class Call>
  static std::exception_ptr try_to(const Call& call) {
    try {
      call();
    } catch (...) {
      return std::current_exception();
    }
    return nullptr;
  }
  /// Calls an observer from inside of the core.
  template <class Call>
  void tell(const Call& call) {
    try {
      call();
    } catch (...) {
      if (!thrown_) thrown_ = std::current_exception();
    }
  }

  /// An output, `pin` its mask, has another level.
  void note_output(std::uint32_t pin, bool level) {
    changed_ |= pin;
    high_ = level ? high_ | pin : high_ & ~pin;
  }
  /// All `outputs` are driven the first time.
  void begin_outputs(std::uint32_t outputs, std::uint32_t high) {
    changed_ = outputs;
    high_ = high;
  }
  /// Outputs that changed since the last call.
  std::uint32_t take_changed() { return std::exchange(changed_, 0); }
  bool has_changed(std::uint32_t pins) const { return (changed_ & pins) != 0; }
  /// Lets `drive` write this output to the port's signal, if it is bound. After elaboration.
  template <class Port>
  void connect(std::uint32_t pin, Port& port) {
    if (port.size() > 0) wires_.push_back({pin, port[0]});
  }
  /// Writes the last reported levels of those `pins` that are connected.
  void drive(std::uint32_t pins);

  /// Makes `due_` fire at `due`, a tick of the chip, whose present one is `now`; it may fire more often.
  void schedule(Tick now, Tick due);
  /// `due_` has fired at scheduled() in this delta cycle. So no input has changed in it: SystemC fires timed events
  /// when all signals have settled, and changes made at this time come in a later delta cycle.
  bool fired_as_scheduled() const { return sc_core::sc_time_stamp() == scheduled_at_ && due_.triggered(); }
  Tick scheduled() const { return scheduled_; }
  /// Makes `soon_` fire in the next delta cycle. Two events: a notification of one for a later time would be dropped
  /// while one for the next delta cycle is pending.
  void schedule_now() { soon_.notify(sc_core::SC_ZERO_TIME); }
  /// `due_` does not fire until it is scheduled again.
  void unschedule();
  sc_core::sc_event due_{"due"}, soon_{"soon"};

  /// The chip is at tick `now` at the present time.
  void begin_again(Tick now);

 private:
  /// Sets a flag during its lifetime.
  class WhileTrue {
   public:
    explicit WhileTrue(bool& flag) : flag_(flag) { flag = true; }
    ~WhileTrue() { flag_ = false; }
    WhileTrue(const WhileTrue&) = delete;
    WhileTrue& operator=(const WhileTrue&) = delete;

   private:
    bool& flag_;
  };

  Tick phase_, zero_;
  Tick scheduled_ = 0;                                      ///< of the chip; up to now: no notification is pending
  sc_core::sc_time scheduled_at_ = sc_core::sc_max_time();  ///< the same
  struct Wire {
    std::uint32_t pin;
    sc_core::sc_signal_inout_if<bool>* signal;
  };
  std::vector<Wire> wires_;
  std::vector<std::unique_ptr<sc_core::sc_attribute<std::uint32_t>>> parameters_;
  std::uint32_t changed_ = 0;
  std::uint32_t high_ = 0;  ///< the reported levels
  bool in_core_ = false;
  std::exception_ptr thrown_;
};

/// A TimedModule with a chip whose state it saves.
class SavedModule : public TimedModule {
 public:
  /// The module at the present time, for restore() in this or another simulation: the chip, and characters on the line.
  /// Not from `on_pin` and `on_event`. Throws profibus::StateError, and nothing has changed, in the middle of an
  /// access.
  std::vector<std::uint8_t> save();
  /// Continues at the present time, with the same kind of module, part and parameters, as at the save: pins, events and
  /// characters come at the same ticks of the chip (chip_tick()). Signals of inputs have to have the levels of the
  /// save, or change now. After the simulation has started. Throws profibus::StateError, and nothing has changed, if
  /// it is another state.
  void restore(const std::vector<std::uint8_t>& state);

 protected:
  using TimedModule::TimedModule;

  // For save() and restore().
  /// The kind of module; up to 24 characters.
  virtual const char* title() const = 0;
  /// An access is in progress.
  virtual bool is_busy() { return false; }
  /// Brings module and core to the present time, and to a state that the module stores.
  virtual void settle() = 0;
  [[noreturn]] void refuse_to_save(const std::string& why) const;
  /// The state of the core, and back; throws StateError.
  virtual std::vector<std::uint8_t> save_core() const = 0;
  virtual void restore_core(const std::vector<std::uint8_t>& state) = 0;
  virtual Tick core_now() const = 0;
  /// The module's state besides the core, also at another time of the kernel.
  virtual void store_module(profibus::StateWriter& archive) = 0;
  virtual void store_module(profibus::StateReader& archive) = 0;
  /// Simulation ticks in a state.
  template <class Archive>
  void store_time(Archive& archive, Tick& tick) const {
    Tick later = tick - current_tick();
    archive(later);
    tick = current_tick() + later;
  }
};

/// `Core`: a chip, with its types of pins and levels, and describe() of its events.
template <class Core>
class CoreModule : public SavedModule {
 public:
  using Pin = typename Core::Pin;
  using Level = typename Core::Level;

  /// Called for every change of a pin, inputs as the core received them and outputs, in order of time. Ticks are the
  /// chip's: simulation time less the phase. Set it before the simulation starts. It must not call the module. An
  /// exception leaves through the call that ran the core.
  std::function<void(Tick at, Pin pin, Level level)> on_pin;
  /// Called for every event of the core (refusals, state changes, violations) at its time; ticks as for `on_pin`.
  std::function<void(const profibus::Event& event)> on_event;

  /// As `on_pin`, for any number of listeners, for the pins of observe(). Those of an access through a socket come with
  /// their ticks, but as a whole when the access is over, and at once if it is carried out ahead of simulation time: so
  /// they may come before earlier changes of other pins.
  ListenedPort<PinChange<Pin, Level>> pin_changes{"pin_changes"};
  /// As `on_event`, for any number of listeners.
  ListenedPort<profibus::Event> events{"events"};
  /// The accesses through a socket with the chip's addresses, each when it is over or carried out ahead.
  ListenedPort<AccessReport> accesses{"accesses"};

  /// `pin_changes` reports these, too. `late`: the listener accepts changes of L_REQ and L_STA later than others, and
  /// of accesses of the chip that nothing else shows only the last three. Before the simulation starts.
  void observe(std::uint32_t pins, bool late = false) {
    observed_by_ports_ |= pins;
    late_ = late_ && late;
  }
  /// The tick at which a read through a socket samples the data, which no pin shows: before the changes of the read.
  ListenedPort<Tick> samples{"samples"};
  /// The tick to which the core has been advanced: for a look inside, with Engine::kStep at each edge of CLK.
  ListenedPort<Tick> advances{"advances"};
  /// The module is about to be destroyed.
  ListenedPort<ModuleEnd> ending{"ending"};

  /// Levels and status of the core at its last evaluation; sync() of a TLM module advances it to the present time.
  const typename Core::Chip& chip() const { return chip_; }
  const typename Core::Config& config() const { return config_; }
  /// The memory shared with the user, without pins, time or side effects.
  std::uint8_t peek(std::uint16_t address) const { return chip_.peek(address); }
  void poke(std::uint16_t address, std::uint8_t value) { chip_.poke(address, value); }

 protected:
  CoreModule(const sc_core::sc_module_name& name, const typename Core::Config& config, const ModuleOptions& options)
      : SavedModule(name, options.phase),
        chip_(config),
        config_(config),
        report_violations_(options.report_violations) {
    list_parameters(config);
    chip_.on_event(
        {[](void* self, const profibus::Event& event) { static_cast<CoreModule*>(self)->event_happened(event); },
         this});
  }

  ~CoreModule() override { ending.tell_each({}, guard()); }

  /// Only these are reported to `on_pin`.
  void tell_only(std::uint32_t pins) { told_ = pins; }
  /// Those of observe().
  std::uint32_t observed_by_ports() const { return observed_by_ports_; }
  bool accepts_late() const { return late_; }
  /// output_changed() is called for the pins in `asked`. `late`: as Chip::watch.
  template <class... Late>
  void watch(std::uint32_t pins, std::uint32_t asked, Late... late) {
    asked_ = asked;
    chip_.watch(
        {[](void* self, Tick at, Pin pin, Level level) { static_cast<CoreModule*>(self)->pin_changed(at, pin, level); },
         this},
        pins, late...);
  }
  void begin_pins(std::uint32_t outputs, int pins) {
    outputs_ = outputs;
    pins_ = pins;
    std::uint32_t high = 0;
    for (int pin = 0; pin < pins; ++pin)
      if (chip_.level(static_cast<Pin>(pin)) == 1) high |= mask(static_cast<Pin>(pin));
    begin_outputs(outputs, high);
  }
  void set(Tick at, Pin pin, Level level) {
    if (chip_.level(pin) == level) return;
    in_core([&] { set_in_core(at, pin, level); });
  }
  struct PinLevel {
    Pin pin;
    Level level;
  };
  /// All of them, whatever an observer throws.
  void set_all(Tick at, std::initializer_list<PinLevel> pins) {
    in_core([&] {
      for (const PinLevel& each : pins) set_in_core(at, each.pin, each.level);
    });
  }
  void advance(Tick to) {
    in_core([&] {
      chip_.advance(to);
      advances.tell_each(to, guard());
    });
  }
  /// From inside the core: a change of a pin, for the ports only.
  void tell_ports(Tick at, Pin pin, Level level) {
    if ((observed_by_ports_ & mask(pin)) != 0) pin_changes.tell_each({at, pin, level}, guard());
  }
  /// Calls a listener from inside of the core.
  auto guard() {
    return [this](const auto& call) { this->tell(call); };
  }
  std::vector<std::uint8_t> save_core() const override { return chip_.save(); }
  void restore_core(const std::vector<std::uint8_t>& state) override {
    chip_.restore(state.data(), state.size());
    begin_pins(outputs_, pins_);
  }
  Tick core_now() const override { return chip_.now(); }
  Tick chip_now() const { return at_least(chip_.now()); }

  // Telegrams as a whole; see the chip's functions of these names.
  bool core_hears(Tick at, const profibus::CharacterRun& run) {
    bool taken = false;
    in_core([&] { taken = chip_.hear(at, run); });
    return taken;
  }
  void core_leaves_run(Tick at) {
    in_core([&] { chip_.leave_run(at); });
  }
  profibus::CharacterRun hide_core_txd() {
    profibus::CharacterRun run;
    in_core([&] { run = chip_.hide_txd(); });
    return run;
  }
  void show_core_txd(Tick at) {
    in_core([&] { chip_.show_txd(at); });
  }

  /// Called from inside the core. Return false to hide the change.
  virtual bool output_changed(Tick /*at*/, Pin /*pin*/, Level /*level*/) { return true; }
  /// Called from inside the core, before `on_event`.
  virtual void heard(const profibus::Event& /*event*/) {}

  typename Core::Chip chip_;

 private:
  /// The ports report it after the change: late reports of the core come first.
  void set_in_core(Tick at, Pin pin, Level level) {
    if (chip_.level(pin) == level) return;
    if (on_pin && (told_ & mask(pin)) != 0) {
      chip_.advance(at);  // earlier events of the core must precede this change
      tell([&] { on_pin(at, pin, level); });
    }
    chip_.set(at, pin, level);
    tell_ports(at, pin, level);
  }
  void pin_changed(Tick at, Pin pin, Level level) {
    if ((asked_ & mask(pin)) != 0 && !output_changed(at, pin, level)) return;
    note_output(mask(pin), level == 1);
    if (on_pin && (told_ & mask(pin)) != 0) tell([&] { on_pin(at, pin, level); });
    tell_ports(at, pin, level);
  }

  void event_happened(const profibus::Event& event) {
    heard(event);
    if (on_event) tell([&] { on_event(event); });
    events.tell_each(event, guard());
    if (!report_violations_ || profibus::severity(event.reason) != profibus::Severity::kViolation) return;
    const std::string text = std::string(name()) + ": " + profibus::code(event.reason) + ": " + Core::describe(event);
    tell([&] { SC_REPORT_WARNING("/dsdpv1/violation", text.c_str()); });
  }

  const typename Core::Config config_;
  bool report_violations_;
  std::uint32_t told_ = ~std::uint32_t{0};
  std::uint32_t outputs_ = 0;
  int pins_ = 0;
  std::uint32_t observed_by_ports_ = 0;
  bool late_ = true;         ///< all of observe() accept it
  std::uint32_t asked_ = 0;  ///< outputs for which output_changed() is called
};

}  // namespace dsdpv1::systemc
