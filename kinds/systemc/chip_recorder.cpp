#include "kinds/systemc/chip_recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <systemc>
#include <utility>

#include "bus/baud.hpp"
#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/chip/core_device.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/dsdpv1/kind.hpp"
#include "kinds/dsdpv1/pins/inside_watch.hpp"
#include "kinds/spc3/inside_watch.hpp"
#include "kinds/spc3/kind.hpp"
#include "kinds/spc3/settings.hpp"
#include "kinds/systemc/recording.hpp"
#include "model/systemc/dsdpv1_pins.hpp"
#include "model/systemc/dsdpv1_tlm.hpp"
#include "model/systemc/spc3_pins.hpp"
#include "model/systemc/spc3_tlm.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/report/result_fields.hpp"
#include "tb/report/summary.hpp"

namespace dsdpv1::systemc {
namespace {

using tb::InputError;

// --- the two families of chips
// -----------------------------------------------------------------------------------------

struct Dsdpv1Family {
  using Base = ChipModule;
  using Inside = tb::InsideWatch;
  static const tb::ChipKind& kind(const Base& chip) { return tb::kind_of(chip.part()); }
  static tb::ChipStatus status(const Base& chip) { return tb::status_of(chip.chip()); }
  static bool steps(const Base& chip) { return chip.config().engine == Engine::kStep; }
  /// The straps are those of a TLM module; signals move them later.
  static std::shared_ptr<const tb::OwnSettings> settings(const Base& chip) {
    auto settings = std::make_shared<tb::Dsdpv1Settings>();
    static_cast<Config&>(*settings) = chip.config();
    const auto level = [&](Pin pin) { return static_cast<int>(chip.chip().level(pin)); };
    settings->mode = static_cast<HostMode>(level(Pin::kMode));
    settings->address = level(Pin::kAdr);
    settings->uart_rate = level(Pin::kUbr);
    settings->interval = level(Pin::kUiv);
    return settings;
  }
};

struct Spc3Family {
  using Base = Spc3Module;
  using Inside = tb::Spc3Inside;
  static const tb::ChipKind& kind(const Base& chip) { return tb::kind_of(chip.config().variant); }
  static tb::ChipStatus status(const Base& chip) { return tb::common_status(chip.chip().status()); }
  static bool steps(const Base& chip) { return chip.config().engine == spc3::Engine::kStep; }
  static std::shared_ptr<const tb::OwnSettings> settings(const Base& chip) {
    auto settings = std::make_shared<tb::Spc3Settings>();
    static_cast<spc3::Config&>(*settings) = chip.config();
    return settings;
  }
};

// --- what a module reports -------------------------------------------------------------------------------------------

/// Bound to a port as long as it lives.
template <class T>
class Listener : public tlm::tlm_analysis_if<T> {
 public:
  Listener(ListenedPort<T>& port, std::function<void(const T&)> call) : port_(port), call_(std::move(call)) {
    port_.bind(*this);
  }
  ~Listener() override { port_.unbind(*this); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  void write(const T& what) override { call_(what); }

 private:
  ListenedPort<T>& port_;
  std::function<void(const T&)> call_;
};

template <class Module>
std::vector<tb::Level> levels_of(const Module& chip, std::size_t pins) {
  std::vector<tb::Level> levels;
  for (std::size_t i = 0; i < pins; ++i) levels.push_back(chip.chip().level(static_cast<typename Module::Pin>(i)));
  return levels;
}

/// A chip as its module shows it, then as it was last.
template <class Family>
class ChipOf : public tb::RecordedChip {
 public:
  explicit ChipOf(typename Family::Base& chip)
      : RecordedChip(levels_of(chip, Family::kind(chip).pins().size())), chip_(&chip) {}

  tb::ChipStatus status() const override { return chip_ != nullptr ? Family::status(*chip_) : last_; }
  std::uint8_t address() const override { return chip_ != nullptr ? chip_->chip().status().address : last_.address; }
  std::uint8_t peek(std::uint16_t address) const override { return chip_ != nullptr ? chip_->peek(address) : 0; }
  void sync(Tick /*now*/) override {}
  void look_inside(Tick at, tb::ChipListener& listener) override { inside_.look(at, chip_->chip(), 0, listener); }
  void leave() {
    last_ = status();
    chip_ = nullptr;
  }

 private:
  typename Family::Base* chip_;
  tb::ChipStatus last_;
  typename Family::Inside inside_;
};

checks::Limits limits_of(const tb::ChipKind& kind, const std::vector<CheckLimit>& wanted) {
  checks::Limits limits(kind.rules());
  for (const CheckLimit& each : wanted) {
    const auto rule = std::find_if(kind.rules().begin(), kind.rules().end(),
                                   [&](const checks::Rule& other) { return other.id == each.id; });
    if (rule == kind.rules().end())
      throw InputError(
          fmt::format("limits has \"{}\", expected a check of docs/checks.md for {}", each.id, kind.name()));
    const checks::CheckId check(static_cast<std::size_t>(rule - kind.rules().begin()));
    limits[check].on = each.on;
    if (!each.limit) continue;
    if (rule->bound == checks::Bound::kRule)
      throw InputError(fmt::format("{} has a limit, expected none: it is kept or not", each.id));
    const double unit = rule->bound == checks::Bound::kMost ? 1 : bus::kTicksPerNs;
    limits[check].value = static_cast<Tick>(*each.limit * unit + (*each.limit < 0 ? -0.5 : 0.5));
  }
  return limits;
}

std::optional<int> baud_of(const std::string& name) {
  if (name.empty()) return std::nullopt;
  const std::optional<int> index = bus::baud_index(name);
  if (!index)
    throw InputError(
        fmt::format("baud is \"{}\", expected 12M, 6M, 3M, 1.5M, 500k, 187.5k, 93.75k, 45.45k, 19.2k or 9.6k", name));
  return index;
}

tb::ChecksMode mode_of(RecorderChecks checks) {
  switch (checks) {
    case RecorderChecks::kFail: return tb::ChecksMode::kFail;
    case RecorderChecks::kReport: return tb::ChecksMode::kReport;
    case RecorderChecks::kOff: break;
  }
  return tb::ChecksMode::kOff;
}

/// The chip's present tick, computed once for each time.
class Present {
 public:
  Tick of(const TimedModule& chip) {
    if (const auto value = sc_core::sc_time_stamp().value(); value != value_) {
      value_ = value;
      tick_ = chip.chip_tick(current_tick());
    }
    return tick_;
  }

 private:
  sc_dt::uint64 value_ = ~sc_dt::uint64{0};
  Tick tick_ = 0;
};

constexpr bool has_host_pins(const ChipModule&) { return true; }
constexpr bool has_host_pins(const PinsOf<Spc3Module>&) { return true; }
constexpr bool has_host_pins(const Spc3TlmModule&) { return false; }

template <class Module>
constexpr bool kIsPins = std::is_same_v<Module, PinModule> || std::is_same_v<Module, Spc3PinModule>;

template <class Base>
void bring_to_now(PinsOf<Base>& /*chip*/) {}  // it is there at each of its events
void bring_to_now(TlmModule& chip) { chip.sync(); }
void bring_to_now(Spc3TlmModule& chip) { chip.sync(); }

}  // namespace

/// A module and its records.
class ChipRecorder::Recording {
 public:
  virtual ~Recording() = default;
  virtual void finish() = 0;
  tb::Recording& records() { return *records_; }

 protected:
  std::unique_ptr<tb::Recording> records_;
};

namespace {

template <class Family, class Module, class Recording>
class Connection : public Recording {
 public:
  Connection(Module& chip, const tb::RecordingOptions& options, const RecorderOptions& given) : chip_(&chip) {
    using PinChange = systemc::PinChange<typename Module::Pin, typename Module::Level>;
    const tb::ChipKind& kind = Family::kind(chip);
    if (options.wave.inside && !Family::steps(chip))
      throw InputError("inside is wanted of a module with Engine::kSkip, expected Engine::kStep in its options");
    auto recorded = std::make_unique<ChipOf<Family>>(chip);
    recorded_ = recorded.get();
    this->records_ = std::make_unique<tb::Recording>(options, kind, Family::settings(chip),
                                                     limits_of(kind, given.limits), given.allowed, std::move(recorded));
    tb::Recording& to = *this->records_;
    chip.observe(to.pins(), to.accepts_late());
    listen(
        chip.pin_changes,
        [this, &to](const PinChange& change) {
          to.pin(present_.of(*chip_), change.at, static_cast<tb::PinNumber>(change.pin), change.level);
        });
    listen(
        chip.events, [this, &to](const profibus::Event& event) { to.event(present_.of(*chip_), event); });
    listen(
        chip.samples, [this, &to](const Tick& at) { to.sample(present_.of(*chip_), at); });
    listen(chip.accesses, [this, &to](const AccessReport& access) { to.accessed(present_.of(*chip_), access); });
    if (to.looks_inside())
      listen(
          chip.advances, [&to](const Tick& now) { to.advanced(now); });
    listen(chip.ending, [this](const ModuleEnd&) { leave(); });
  }
  ~Connection() override { listeners_.clear(); }

  void finish() override {
    if (chip_ == nullptr) return;
    bring_to_now(*chip_);
    leave();
  }

 private:
  template <class T, class Call>
  void listen(ListenedPort<T>& port, Call call) {
    listeners_.push_back(std::make_shared<Listener<T>>(port, std::move(call)));
  }
  /// Also from the module's destructor.
  void leave() {
    const Tick end = present_.of(*chip_);
    recorded_->leave();
    chip_ = nullptr;
    listeners_.clear();
    this->records_->finish(end);
  }

  Module* chip_;
  Present present_;
  ChipOf<Family>* recorded_ = nullptr;
  std::vector<std::shared_ptr<void>> listeners_;
};

}  // namespace

ChipRecorder::ChipRecorder(RecorderOptions options) : options_(std::move(options)) { baud_of(options_.baud); }

ChipRecorder::~ChipRecorder() {
  try {
    finish();
  } catch (const std::exception&) {  // finish() tells it to those who call it
  }
}

template <class Family, class Module>
void ChipRecorder::attach_to(Module& chip) {
  if (recording_) throw std::logic_error("ChipRecorder::attach: there is a chip already, expected a recorder for each");
  if (sc_core::sc_start_of_simulation_invoked())
    throw std::logic_error("ChipRecorder::attach: the simulation has started, expected a call before");
  tb::RecordingOptions options;
  options.name = options_.name.empty() ? chip.name() : options_.name;
  options.wave.path = options_.wave;
  options.wave.inside = options_.inside;
  options.log = options_.log;
  options.capture = options_.capture;
  options.checks = mode_of(options_.checks);
  options.baud = baud_of(options_.baud);
  options.accesses_by_pins = has_host_pins(chip);
  options.view = kIsPins<Module> ? "pins" : "tlm";
  options.engine = Family::steps(chip) ? "step" : "skip";
  recording_ = std::make_unique<Connection<Family, Module, Recording>>(chip, options, options_);
}

void ChipRecorder::attach(PinModule& chip) { attach_to<Dsdpv1Family>(chip); }
void ChipRecorder::attach(TlmModule& chip) { attach_to<Dsdpv1Family>(chip); }
void ChipRecorder::attach(Spc3PinModule& chip) { attach_to<Spc3Family>(chip); }
void ChipRecorder::attach(Spc3TlmModule& chip) { attach_to<Spc3Family>(chip); }

void ChipRecorder::finish() {
  if (recording_) recording_->finish();
}

const tb::RunResult& ChipRecorder::result() const {
  if (!recording_ || !recording_->records().is_finished())
    throw std::logic_error("ChipRecorder: not finished, expected attach() and finish() before");
  return recording_->records().result();
}

std::string ChipRecorder::summary(bool all_checks) const {
  return tb::summary(result(), all_checks ? tb::CheckRows::kAll : tb::CheckRows::kViolated);
}

std::string ChipRecorder::verdict() const { return tb::words(result()); }

int ChipRecorder::exit_code() const { return tb::exit_code(tb::verdict(result())); }

std::string ChipRecorder::result_json() const { return tb::result_json(result()); }

std::vector<CheckOutcome> ChipRecorder::checks() const {
  std::vector<CheckOutcome> outcomes;
  for (const tb::CheckResult& each : result().checks)
    outcomes.push_back({each.rule->id, each.record.count, each.record.violations, each.record.worst_margin,
                        each.record.worst_value, each.record.at});
  return outcomes;
}

std::uint64_t ChipRecorder::accesses() const { return recording_ ? recording_->records().socket().accesses : 0; }

std::uint64_t ChipRecorder::accesses_ahead() const { return recording_ ? recording_->records().socket().ahead : 0; }

}  // namespace dsdpv1::systemc
