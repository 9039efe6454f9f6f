#include "tb/bench/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "io/input/input_error.hpp"
#include "tb/bench/script.hpp"

namespace dsdpv1::tb {

namespace {

void add(Hash& hash, const SlaveResult& slave) {
  const ChipStatus& chip = slave.status;
  for (const std::uint64_t number : {std::uint64_t{chip.address}, std::uint64_t{chip.master}, chip.telegrams_received,
                                     chip.telegrams_answered, chip.data_exchanges, chip.outputs_missed, chip.accesses})
    hash.add(number);
  hash.add(static_cast<std::uint64_t>(chip.dp_state));
  hash.add(static_cast<std::uint64_t>(chip.baud.value_or(-1)));
  hash.add(static_cast<std::uint64_t>(chip.longest_wait));
  if (slave.outputs)
    for (const std::uint8_t byte : *slave.outputs) hash.add(std::uint64_t{byte});
}

}  // namespace

/// Keeps the monitor at the rate of the masters. It receives each edge, or a run, before the monitor does.
class Bench::BaudFollower : private bus::Listener {
 public:
  explicit BaudFollower(Bench& bench) : bench_(bench) { bench.execution_->segment().attach("baud follower", this); }

 private:
  void line_changed(Tick, bool) override { follow(); }
  bool run_begins(const bus::CharacterRun&) override {
    follow();
    return true;
  }
  void follow() {
    for (const MasterStation& each : bench_.stations_.masters)
      if (each.master->running() && each.master->baud() != bench_.monitor_->baud())
        bench_.monitor_->set_baud(each.master->baud());
  }
  Bench& bench_;
};

// --- building --------------------------------------------------------------------------------------------------------

Bench::Bench(const scenario::Scenario& scenario, const RunOptions& options, std::unique_ptr<Execution> execution)
    : scenario_(scenario),
      options_(options),
      execution_(std::move(execution)),
      setup_(scenario),
      observers_(execution_->timeline()),
      exchange_(scenario, stations_, options.host),
      checks_(scenario, options.checks.value_or(scenario.checks.mode), observers_),
      hosts_(scenario, !options.log.empty() || !options.wave.path.empty() || !options.observers.empty(), observers_),
      journal_(scenario, observers_, log_form(options.log, options.log_whole, options.open_ended, options.from)) {
  add_marks();
  observers_.where = [this](std::size_t slave, const user_cpu::Act& act) {
    return stations_.slaves[slave]->where(act);
  };
  replies_.on_change = [this](const auto&, auto, const auto&) { observers_.changed(); };
  if (!options.wave.path.empty()) waves_.emplace(options.wave, execution_->segment(), execution_->timeline());
  for (const scenario::Slave& slave : scenario.slaves) add_slave(slave);
  baud_follower_ = std::make_unique<BaudFollower>(*this);
  add_monitor();
  for (const scenario::Master& master : scenario.masters) add_master(master);
  for (const scenario::Master2& master : scenario.masters2) add_master2(master);
  script_ =
      std::make_unique<Script>(scenario_, stations_, execution_->segment(), journal_, replies_, left_out_, observers_);
  add_agents();
  if (!options.log.empty()) journal_.open(options.log);
  if (!options.trace.empty()) trace_.emplace(options.trace, scenario_, options.from);
  if (!options.capture.path.empty()) capture_.emplace(options.capture, scenario_.baud, options.from);
  add_observers();
  if (waves_) waves_->begin();
}

Bench::~Bench() = default;

bool Bench::needs_all_pins() const {
  const bool wave = !options_.wave.path.empty() && !options_.wave.asleep;
  return wave || !options_.trace.empty() || !options_.observers.empty();
}

/// Pins needed by the bench itself are watched anyway.
PinMask Bench::watched_pins(const scenario::Slave& slave) const {
  if (needs_all_pins()) return all_of(slave.kind->pins());
  return checks_.pins(slave) | hosts_.pins(stations_.slaves.size());
}

/// True if nothing, except perhaps the wave, needs each change of each pin or each cycle.
bool Bench::takes_runs() const { return !options_.wave.inside && options_.trace.empty() && options_.observers.empty(); }

void Bench::add_slave(const scenario::Slave& slave) {
  user_cpu::StationConfig station = setup_.station(slave);
  const char* const port = hosts_.port(stations_.slaves.size());
  const bool late = !needs_all_pins() && port == nullptr;  // checks do not mind
  std::unique_ptr<ChipView> chip = execution_->make_chip(
      *slave.kind, {slave.name.text, *slave.chip, options_.engine, options_.wave.inside, watched_pins(slave), late});
  MakeUser make_user = slave.kind->make_user({scenario_, slave, *chip, gdb_of(slave), left_out_, outside_of(slave)});
  auto& slaves = stations_.slaves;
  slaves.push_back(std::make_unique<SlaveStation>(slaves.size(), slave, std::move(station), std::move(chip),
                                                  std::move(make_user), *execution_, observers_));
  SlaveStation& made = *slaves.back();
  checks_.add(slave, made.chip());
  if (waves_) waves_->add_chip(made.name(), *slave.kind, made.chip(), port);
  const ChipNews wanted = wanted_news(made.chip());
  if (wanted.runs) waves_->take_runs();
  made.chip().listen(observers_, slaves.size() - 1, wanted);
}

/// The wave needs runs, actions and (if shown) internal signals; checks and observers need reads.
ChipNews Bench::wanted_news(const ChipView& chip) const {
  const bool wave = waves_.has_value();
  return {wave && takes_runs() && chip.tells_runs(), checks_.on() || !options_.observers.empty(),
          wave && options_.wave.inside, wave};
}

const GdbRequest* Bench::gdb_of(const scenario::Slave& slave) const {
  const auto& slaves = scenario_.slaves;
  const auto first = std::find_if(slaves.begin(), slaves.end(),
                                  [](const scenario::Slave& each) { return each.kind->has_debugger(each); });
  return options_.gdb && first != slaves.end() && &*first == &slave ? &*options_.gdb : nullptr;
}

user_cpu::OutsideLine* Bench::outside_of(const scenario::Slave& slave) const {
  return options_.outside && options_.outside->slave == slave.name.text ? options_.outside->line : nullptr;
}

void Bench::add_monitor() {
  monitor_ = std::make_unique<bus::Monitor>(execution_->segment());
  monitor_->set_baud(scenario_.baud);
  monitor_->on_telegram = [this](const bus::WireTelegram& each) {
    observers_.tell(&Observer::telegram, HeardTelegram(now(), each));
    observers_.changed();
  };
  if (waves_)
    monitor_->on_character = [this](const bus::ReceivedCharacter& each) {
      observers_.tell(&Observer::character, now(), each);
    };
  monitor_->on_flag = [this](const bus::Flag& each) {
    observers_.tell(&Observer::flag, each);
    observers_.changed();
  };
  monitor_->on_skipped = [this](const bus::ReceivedCharacter& each) { observers_.tell(&Observer::skipped, each); };
}

void Bench::add_master(const scenario::Master& spec) {
  stations_.masters.push_back(make_master(scenario_, spec, setup_, execution_->segment()));
  connect(stations_.masters.back());
}

void Bench::add_master2(const scenario::Master2& spec) {
  auto& masters = stations_.masters2;
  masters.push_back(std::make_unique<Class2Station>(scenario_, spec, stations_, execution_->segment(), journal_,
                                                    replies_, observers_));
  if (waves_) waves_->add_master(spec.name.text, masters.back()->connection_names(), "CLOSED");
}

void Bench::connect(MasterStation& entry) {
  const std::string& name = entry.spec->name.text;
  if (waves_) {
    std::vector<std::string> slaves;
    for (const auto& [address, slave] : entry.slaves) slaves.push_back(slave);
    waves_->add_master(name, slaves, bus::name(bus::SlaveState::kOffline));
  }
  bus::Master1& master = *entry.master;
  master.on_state = [this, &master, &name, slaves = entry.slaves](Tick at, std::uint8_t address, bus::SlaveState from,
                                                                  bus::SlaveState to) {
    const std::string& reason = master.slave(address).step_reason;
    journal_.log(at, name, "state",
                 fmt::format("{} (address {}): {} to {}{}", slaves.at(address), address, bus::name(from), bus::name(to),
                             reason.empty() ? "" : ", " + reason));
    observers_.tell(&Observer::master_state, now(), name, slaves.at(address), std::string(bus::name(to)));
    observers_.changed();
  };
  master.on_inputs = [this, &master, &name, slaves = entry.slaves](Tick at, std::uint8_t address) {
    journal_.log({at, name, "inputs", slaves.at(address), {}, master.slave(address).inputs});
    observers_.changed();
  };
}

void Bench::add_answer_faults() {
  const auto is_one = [](const auto& action) { return action.what == scenario::ActionKind::kAnswerFault; };
  if (!options_.orders && std::none_of(scenario_.script.begin(), scenario_.script.end(), is_one)) return;
  for (const auto& slave : stations_.slaves) {
    stations_.answer_faults.push_back(std::make_unique<AnswerFault>(
        execution_->segment(), slave->chip().station(), [this] { return bus::baud(monitor_->baud()).bit; }));
    execution_->timeline().add(*stations_.answer_faults.back());
  }
}

void Bench::order(const std::string& json) {
  const scenario::Action action = scenario::parse_action(json, "control", scenario_);
  if (scenario::is_for_user_cpu(action.what) && !stations_.slave(action.slave.text).carries_out(action.word))
    throw InputError(
        "control", 0,
        fmt::format("{} is for the program of {}, which cannot be told anything", action.word, action.slave.text));
  script_->order(action);
}

/// The chips are already in the timeline; then stations in the order in which they answer each other, the script last.
void Bench::add_agents() {
  bus::Timeline& timeline = execution_->timeline();
  add_answer_faults();
  timeline.add(*monitor_);
  hosts_.add_to(timeline);
  for (const MasterStation& each : stations_.masters) timeline.add(*each.master);
  for (const auto& each : stations_.masters2) timeline.add(each->master());
  for (const auto& slave : stations_.slaves) timeline.add(*slave);
  timeline.add(*script_);
  timeline.add(periodic_poll_);
}

/// Checks come before the observers that show their findings, the script last, because it acts on what the others have
/// noted. Each observer costs a call at each change of a pin.
void Bench::add_observers() {
  observers_.add(*this);
  observers_.add(exchange_);
  if (checks_.on()) observers_.add(checks_);
  if (hosts_.reads_any()) observers_.add(hosts_);
  if (trace_) observers_.add(*trace_);
  if (waves_) observers_.add(*waves_);
  if (capture_) observers_.add(*capture_);
  if (!options_.marks.empty()) observers_.add(digest_);
  for (Observer* each : options_.observers) observers_.add(*each);
  observers_.add(journal_);
  observers_.add(*script_);
}

// --- events ----------------------------------------------------------------------------------------------------------

void Bench::text(std::size_t slave, Tick at, const std::string& line) {
  if (options_.on_text && at >= options_.from) options_.on_text(stations_.slaves[slave]->name(), line);
}

bool Bench::stopped() const { return periodic_poll_.stopped() || !registers_.empty() || execution_->broken_off(); }

void Bench::telegram(const HeardTelegram& heard) {
  const bus::WireTelegram& telegram = heard.telegram;
  if (!telegram.tsdr) return;
  for (const auto& slave : stations_.slaves)
    if (slave->chip().address() == telegram.station) slave->tsdr().add(telegram.tsdr_bits());
}

// --- running ---------------------------------------------------------------------------------------------------------

RunResult Bench::run(const std::function<bool(Tick)>& poll) {
  const auto begin = std::chrono::steady_clock::now();
  periodic_poll_.poll = [&](Tick at) {
    if (journal_.run_log() != nullptr) journal_.run_log()->flush(at - 1);
    if (capture_ && options_.open_ended) capture_->follow(at);
    digest_.before(at);
    return keep_outputs(at) && poll(at);
  };
  for (std::size_t slave = 0; slave < stations_.slaves.size(); ++slave) {
    const ChipView& chip = stations_.slaves[slave]->chip();
    observers_.tell(&Observer::begins, slave, chip);
  }
  execution_->run(scenario_.end, [this] { return stopped(); });
  RunResult result = collect();
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!leaves_nothing_ && !goes_back()) finish_outputs();
  return result;
}

void Bench::add_marks() {
  for (const Tick at : options_.marks) marks_.add(at);
  if (options_.wave.asleep && sleeps_until() != bus::kNever) marks_.add(sleeps_until());
  marks_.on_mark = [this](Tick at) { marked(at); };
  if (!marks_.empty()) execution_->timeline().add(marks_);
}

void Bench::marked(Tick now) {
  const bool wanted = std::find(options_.marks.begin(), options_.marks.end(), now) != options_.marks.end();
  if (wanted && !options_.on_mark(now, digest(now))) leave_nothing();
  if (waves_ && waves_->asleep() &&
      now == sleeps_until())  // not before the digest, which has the value of a run without a wave
    wake_wave(options_.wave.selection.from, options_.wave.selection.to);
}

void Bench::leave_nothing() {
  leaves_nothing_ = true;
  periodic_poll_.stop();
}

/// When a wave that begins late has to be awake; kNever: at no known time.
Tick Bench::sleeps_until() const {
  const Tick from = options_.wave.selection.from;
  return from == bus::kNever ? bus::kNever : std::max<Tick>(from - kAwakeBefore, 0);
}

void Bench::wake_wave(Tick from, Tick to) {
  for (const auto& slave : stations_.slaves) {
    if (now() > 0) slave->chip().sync(now());
    slave->chip().watch(now(), all_of(slave->kind().pins()));
  }
  waves_->wake(now(), from, to, execution_->segment().level());
}

const WaveRecorder::Trigger* Bench::wave_trigger() const {
  return waves_ && waves_->triggered() ? &*waves_->triggered() : nullptr;
}

void Bench::keep_only_wave() {
  only_wave_ = true;
  options_.on_text = nullptr;
  if (journal_.run_log() != nullptr) journal_.run_log()->mute();
  if (trace_) trace_->mute();
  if (capture_) capture_->mute();
}

/// At `now` only chips of the TLM view have acted; all other agents are added as they are. The line counts by its level
/// just before `now`; the chips' pins at the line do not count, because runs do not move them. `sync` gives each chip
/// its turn at `now`, which is the next one anyway.
std::uint64_t Bench::digest(Tick now) {
  Hash hash;
  hash.add(digest_.before(now));
  hash.add(std::uint64_t{execution_->segment().level_before(now)});
  for (const MasterStation& each : stations_.masters) hash.add(each.master->cycles());
  hash.add(monitor_->statistics().telegrams);
  hash.add(monitor_->statistics().wrong);
  for (const auto& slave : stations_.slaves) slave->chip().sync(now);
  for (const auto& slave : stations_.slaves) {
    const PinTable& pins = slave->kind().pins();
    for (std::size_t pin = 0; pin < pins.size(); ++pin)
      if (!pins[pin].line) hash.add(static_cast<std::uint64_t>(slave->chip().level(static_cast<PinNumber>(pin))));
    add(hash, slave->result());
  }
  return hash.value();
}

RunResult Bench::collect() {
  RunResult result;
  result.scenario = scenario_.name;
  result.file = scenario_.file;
  result.engine = options_.engine_name;
  result.view = options_.view_name;
  result.interrupted = periodic_poll_.stopped() && !options_.open_ended;
  result.simulated = stopped() ? now() : scenario_.end;
  result.fault_registers = registers_;
  result.telegrams = monitor_->statistics().telegrams;
  result.wrong_telegrams = monitor_->statistics().wrong;
  for (const MasterStation& each : stations_.masters)
    result.masters.push_back({each.spec->name.text, each.spec->address, each.master->cycles(),
                              each.master->min_slave_interval_us(), each.spec->bus.min_slave_interval.has_value()});
  for (const auto& slave : stations_.slaves) result.slaves.push_back(collect(*slave, result.simulated));
  checks_.finish(result.simulated);
  result.checks = checks_.results();
  result.checks_mode = checks_.mode();
  result.checks_off = checks_.left_out();
  result.expects_exchange = scenario_.expects_exchange;
  result.violations = journal_.violations() + checks_.failures();
  add_expectations(result);
  journal_.fill(result);
  return result;
}

void Bench::add_expectations(RunResult& result) {
  const bool ended_early = result.interrupted || execution_->broken_off();
  result.expectations = script_->finish(result.simulated, ended_early);
  if (ended_early) return;
  for (ExpectationResult& each : exchange_.finish(result.slaves)) result.expectations.push_back(std::move(each));
}

SlaveResult Bench::collect(SlaveStation& slave, Tick at) const {
  slave.chip().sync(at);
  SlaveResult result = slave.result();
  if (const bus::Master1* master = stations_.master_of(slave.name())) {
    const bus::SlaveView& view = master->slave(*stations_.listed_address(slave.name()));
    result.master_state = bus::name(view.state);
    result.master_reason = view.reason;
    result.inputs = view.inputs;
  }
  result.waits_for = exchange_.waits_for(result);
  return result;
}

/// Once a second of wall time the outputs are flushed to disk, in case the process is killed. Returns false if an
/// output cannot be written any more (a full disk), so that the run can stop.
bool Bench::keep_outputs(Tick at) {
  RunLog* log = journal_.run_log();
  const auto now = std::chrono::steady_clock::now();
  if (now >= next_save_) {
    next_save_ = now + std::chrono::seconds(1);
    if (waves_) waves_->save(at);
    if (log != nullptr) log->save();
    if (trace_) trace_->save();
    if (capture_) capture_->save();
  }
  return !(waves_ && waves_->failed()) && !(log != nullptr && log->failed()) && !(trace_ && trace_->failed()) &&
         !(capture_ && capture_->failed());
}

/// Completes the outputs. check() throws if one failed; then none is left.
void Bench::finish_outputs() {
  RunLog* log = only_wave_ ? nullptr : journal_.run_log();
  if (waves_ && waves_->asleep()) waves_.reset();
  if (waves_) waves_->check();
  if (log != nullptr) log->check();
  if (trace_) trace_->check();
  if (capture_) capture_->check();
  if (waves_) waves_->finish(std::max(now(), stopped() ? now() : scenario_.end));
  if (only_wave_) return;
  if (log != nullptr) log->finish();
  if (trace_) trace_->finish();
  if (capture_) capture_->finish();
}

}  // namespace dsdpv1::tb
