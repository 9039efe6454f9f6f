#include "tb/bench/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <stdexcept>
#include <tuple>

#include "bus/telegram/explain.hpp"
#include "tb/bench/script.hpp"
#include "tb/input/input_error.hpp"
#include "tb/input/units.hpp"
#include "tb/scenario/event_codes.hpp"

namespace tb {

/// Keeps the monitor at the rate of the masters. It hears each edge before the monitor does.
class Bench::BaudFollower : private bus::Listener {
 public:
  explicit BaudFollower(Bench& bench) : bench_(bench) { bench.segment().attach("baud follower", this); }

 private:
  void line_changed(Tick, bool) override {
    for (const Master& each : bench_.masters_)
      if (each.master->running() && each.master->baud() != bench_.monitor_->baud())
        bench_.monitor_->set_baud(each.master->baud());
  }
  Bench& bench_;
};

// --- building --------------------------------------------------------------------------------------------------------

Bench::Bench(const scenario::Scenario& scenario, const RunOptions& options, std::unique_ptr<Execution> execution)
    : scenario_(scenario),
      maker_(chip_maker(scenario)),
      options_(options),
      execution_(std::move(execution)),
      setup_(scenario),
      checks_(scenario, options.checks),
      log_form_(log_form(options.log, options.log_whole, options.open_ended)) {
  checks_.on_violation = [this](const std::string& slave, const checks::Violation& violation, const char* kind) {
    check_violated(slave, violation, kind);
  };
  if (!options.wave.empty()) waves_.emplace(options.wave, segment());
  for (const scenario::Slave& slave : scenario.slaves) add_slave(slave);
  baud_follower_ = std::make_unique<BaudFollower>(*this);
  add_monitor();
  for (const scenario::Master& master : scenario.masters) add_master(master);
  for (const scenario::Master2& master : scenario.masters2) add_master2(master);
  script_ = std::make_unique<Script>(*this);
  add_agents();
  if (!options.log.empty()) log_.emplace(options.log, log_form_);
  if (!options.trace.empty()) trace_.emplace(options.trace);
  if (waves_) waves_->begin();
}

Bench::~Bench() = default;

/// What the bench itself needs a chip watches anyway.
PinMask Bench::watched_pins() const {
  const bool all = !options_.wave.empty() || !options_.trace.empty();
  return all ? all_of(maker_.pins()) : checks_.pins();
}

void Bench::add_slave(const scenario::Slave& slave) {
  user_cpu::StationConfig station = setup_.station(slave);
  std::unique_ptr<ChipView> chip =
      execution_->make_chip(maker_, {slave.name.text, *scenario_.chip, options_.engine, watched_pins()});
  MakeUser make_user = maker_.make_user({scenario_, slave, *chip, gdb_of(slave), left_out_});
  slaves_.push_back(std::make_unique<SlaveStation>(slave, std::move(station), std::move(chip), std::move(make_user)));
  connect(*slaves_.back(), slaves_.size() - 1);
}

const GdbRequest* Bench::gdb_of(const scenario::Slave& slave) const {
  const auto& slaves = scenario_.slaves;
  const auto first = std::find_if(slaves.begin(), slaves.end(),
                                  [this](const scenario::Slave& each) { return maker_.has_debugger(each); });
  return options_.gdb && first != slaves.end() && &*first == &slave ? &*options_.gdb : nullptr;
}

void Bench::connect(SlaveStation& station, std::size_t index) {
  checks_.add(station.name());
  if (waves_) waves_->add_chip(station.name(), maker_.pins(), station.chip());
  station.chip().on_pin = [this, index](Tick at, PinNumber pin, Level level) { pin_changed(index, at, pin, level); };
  station.chip().on_interrupt = [&station](Tick at, bool level) { station.interrupt_changed(at, level); };
  station.chip().on_event = [this, index](const profibus::Event& event) { chip_event(index, event); };
  station.chip().on_read = [this, index](Tick sample) { checks_.read(index, sample); };
  station.quiet_until = [this, &station] { return execution_->quiet_until(station); };
  station.on_error = [this, &station](const user_cpu::ProgramError& error) { program_error(station, error); };
  station.on_text = [this, &station](Tick at, const std::string& line) {
    log(at, station.name(), "text", line);
    if (options_.on_text) options_.on_text(station.name(), line);
  };
  station.on_killed = [this] { periodic_poll_.stop(); };
  station.on_failure = [this, &station](Tick at, const std::string& why, const std::string& registers) {
    user_failed(station, at, why, registers);
  };
  station.on_outputs = [this, &station](Tick at, bool changed) {
    if (changed) log({at, station.name(), "user", "outputs", {}, station.outputs()});
    conditions_changed();
  };
}

void Bench::add_monitor() {
  monitor_ = std::make_unique<bus::Monitor>(segment());
  monitor_->set_baud(scenario_.baud);
  monitor_->on_telegram = [this](const bus::WireTelegram& each) { telegram(each); };
  monitor_->on_flag = [this](const bus::Flag& each) { flagged(each); };
}

void Bench::add_master(const scenario::Master& spec) {
  bus::MasterConfig config;
  config.name = spec.name.text;
  config.address = static_cast<std::uint8_t>(spec.address);
  config.baud = scenario_.baud;
  config.personality = spec.personality;
  config.bus = bus_parameters(spec.bus);
  Master& entry = masters_.emplace_back();
  entry.spec = &spec;
  entry.master = std::make_unique<bus::Master1>(segment(), config);
  for (const scenario::MasterSlave& slave : spec.slaves) {
    const bus::SlaveParameters parameters = setup_.parameters(slave);
    try {
      entry.master->add_slave(parameters);
      bus::Bytes outputs = slave.outputs;
      outputs.resize(static_cast<std::size_t>(parameters.output_length));
      entry.master->set_outputs(parameters.address, outputs);
    } catch (const std::invalid_argument& error) {
      throw InputError(scenario_.file, slave.line, error.what());
    }
    entry.slaves[parameters.address] = parameters.name;
  }
  if (!spec.operate) entry.master->clear();
  connect(entry);
}

void Bench::add_master2(const scenario::Master2& spec) {
  masters2_.push_back(std::make_unique<Class2Station>(*this, spec));
  if (waves_) waves_->add_master(spec.name.text, masters2_.back()->connection_names(), "CLOSED");
}

void Bench::connection_changed(const std::string& master, const std::string& connection, const std::string& state) {
  if (waves_) waves_->master_state(master, connection, now(), state);
}

void Bench::connect(Master& entry) {
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
    log(at, name, "state",
        fmt::format("{} (address {}): {} to {}{}", slaves.at(address), address, bus::name(from), bus::name(to),
                    reason.empty() ? "" : ", " + reason));
    if (waves_) waves_->master_state(name, slaves.at(address), now(), bus::name(to));
    conditions_changed();
  };
  master.on_inputs = [this, &master, &name, slaves = entry.slaves](Tick at, std::uint8_t address) {
    log({at, name, "inputs", slaves.at(address), {}, master.slave(address).inputs});
    conditions_changed();
  };
}

/// The chips are in the timeline already; then in the order of who answers whom, the script last.
void Bench::add_agents() {
  bus::Timeline& timeline = execution_->timeline();
  timeline.add(*monitor_);
  for (const Master& each : masters_) timeline.add(*each.master);
  for (const auto& each : masters2_) timeline.add(each->master());
  for (const auto& slave : slaves_) timeline.add(*slave);
  timeline.add(*script_);
  timeline.add(periodic_poll_);
}

// --- what happens ----------------------------------------------------------------------------------------------------

void Bench::log(Tick at, const std::string& station, const std::string& kind, const std::string& text) {
  log({at, station, kind, text});
}

void Bench::log(LogEntry entry) {
  if (!log_) return;
  entry.at = std::max(entry.at, now());
  log_->add(entry);
}

std::string Bench::in_log(const bus::Bytes& bytes) const { return bytes_text(bytes, log_form_.most_bytes()); }

void Bench::conditions_changed() { conditions_changed(now()); }

/// In the TLM view chips act before the timeline has come to their tick.
void Bench::conditions_changed(Tick at) { script_->conditions_changed(std::max(at, now())); }

void Bench::pin_changed(std::size_t index, Tick at, PinNumber pin, Level level) {
  checks_.pin(index, at, pin, level);
  const PinInfo& info = maker_.pins()[pin];
  if (trace_ && !info.input) trace_->change(index, slaves_[index]->name(), at, info, level);
  if (waves_) waves_->pin(index, at, pin, level);
}

void Bench::chip_event(std::size_t index, const profibus::Event& event) {
  if (event.reason == profibus::Reason::kDpState && waves_)
    waves_->dp_state(index, event.at, name(static_cast<profibus::DpState>(event.b)));
  if (event.reason == profibus::Reason::kRmEntry && waves_)
    waves_->rm_entry(index, event.at, profibus::kC2FirstSap - event.a, maker_.describe(event));
  happened({event.at, slaves_[index]->name(), profibus::code(event.reason), profibus::severity(event.reason),
            maker_.describe(event)});
  conditions_changed(event.at);
}

void Bench::check_violated(const std::string& slave, const checks::Violation& violation, const char* kind) {
  const std::string id = maker_.rules()[violation.check.index].id;
  ++counts_[slave][id];
  if (log_)
    log_->finding(
        {std::max(violation.found, now()), slave, kind,
         fmt::format("at {} ns: {}  [{}]", nanoseconds(violation.at), violation.text, checks::history_text(violation)),
         id});
  conditions_changed(violation.found);
}

void Bench::program_error(const SlaveStation& station, const user_cpu::ProgramError& error) {
  happened({error.at, station.name(), error.code, profibus::Severity::kRefusal, error.text});
  conditions_changed();
}

void Bench::user_failed(const SlaveStation& station, Tick at, const std::string& why, const std::string& registers) {
  happened({at, station.name(), scenario::kFirmwareFault, profibus::Severity::kViolation, why});
  registers_ = registers;
}

bool Bench::stopped() const { return periodic_poll_.stopped() || !registers_.empty(); }

void Bench::telegram(const bus::WireTelegram& telegram) {
  const std::string words = telegram.decoded.readable ? bus::explain_line(telegram.decoded.telegram) : "not readable";
  if (log_) log(log_entry(telegram, words));
  if (waves_) waves_->telegram(now(), words);
  checks_.telegram(now(), telegram);
  if (telegram.tsdr) {
    for (const auto& slave : slaves_)
      if (slave->chip().status().address == telegram.station) slave->tsdr().add(telegram.tsdr_bits());
  }
  conditions_changed();
}

void Bench::flagged(const bus::Flag& flag) {
  // An unanswered request is how masters find out that nobody is there.
  const bool wrong = flag.kind != bus::FlagKind::kUnanswered;
  happened({flag.at, "bus", scenario::flag_code(flag.kind),
            wrong ? profibus::Severity::kViolation : profibus::Severity::kInfo, flag.text});
  conditions_changed();
}

void Bench::happened(Occurrence occurrence) {
  ++counts_[occurrence.station][occurrence.code];
  occurrence.allowed =
      occurrence.severity == profibus::Severity::kViolation && allows(scenario_, occurrence.code, occurrence.station);
  if (occurrence.severity == profibus::Severity::kViolation && !occurrence.allowed) ++violations_;
  if (occurrence.severity == profibus::Severity::kRefusal) refusals_.count(occurrence);
  log({occurrence.at, occurrence.station, occurrence.allowed ? "allowed" : name(occurrence.severity), occurrence.text,
       occurrence.code});
  if (occurrences_.size() < RunResult::kKept)
    occurrences_.push_back(std::move(occurrence));
  else
    ++occurrences_dropped_;
}

// --- for the script --------------------------------------------------------------------------------------------------

const std::unique_ptr<SlaveStation>& Bench::find_slave(const std::string& name) const {
  const auto found =
      std::find_if(slaves_.begin(), slaves_.end(), [&name](const auto& slave) { return slave->name() == name; });
  if (found == slaves_.end()) throw std::out_of_range("no slave " + name);
  return *found;
}

bus::Master1& Bench::master(const std::string& name) {
  for (Master& each : masters_)
    if (name.empty() || each.spec->name.text == name) return *each.master;
  throw std::out_of_range("no master " + name);
}

Class2Station* Bench::class2(const std::string& name) {
  for (const auto& each : masters2_)
    if (each->name() == name) return each.get();
  return nullptr;
}

Class2Station& Bench::owner_of(const std::string& connection) {
  for (const auto& each : masters2_)
    if (each->has(connection)) return *each;
  throw std::out_of_range("no connection " + connection);
}

const bus::Connection& Bench::connection(const std::string& name) const {
  for (const auto& each : masters2_)
    if (each->has(name)) return each->connection(name);
  throw std::out_of_range("no connection " + name);
}

const bus::Master1* Bench::master_of(const std::string& slave) const {
  for (const Master& each : masters_) {
    for (const auto& [address, name] : each.slaves)
      if (name == slave) return each.master.get();
  }
  return nullptr;
}

std::optional<std::uint8_t> Bench::listed_address(const std::string& slave) const {
  for (const Master& each : masters_) {
    for (const auto& [address, name] : each.slaves)
      if (name == slave) return address;
  }
  return std::nullopt;
}

std::uint64_t Bench::count(const std::string& slave, const std::string& code) const {
  const auto station = counts_.find(slave);
  if (station == counts_.end()) return 0;
  const auto entry = station->second.find(code);
  return entry == station->second.end() ? 0 : entry->second;
}

const Reply* Bench::last_reply(const std::string& asker, scenario::ActionKind service) const {
  const auto replies = replies_.find(asker);
  if (replies == replies_.end()) return nullptr;
  const auto reply = replies->second.find(service);
  return reply == replies->second.end() ? nullptr : &reply->second;
}

void Bench::keep_reply(const std::string& asker, scenario::ActionKind service, Reply reply) {
  replies_[asker][service] = std::move(reply);
  conditions_changed();
}

void Bench::change_baud(int index) {
  for (Master& each : masters_) each.master->change_baud(index);
  for (const auto& each : masters2_) each->master().change_baud(index);
}

// --- running ---------------------------------------------------------------------------------------------------------

RunResult Bench::run(const std::function<bool(Tick)>& poll) {
  const auto begin = std::chrono::steady_clock::now();
  periodic_poll_.poll = [&](Tick at) {
    if (log_) log_->flush(at - 1);
    return keep_outputs(at) && poll(at);
  };
  execution_->run(scenario_.end, [this] { return stopped(); });
  RunResult result = collect();
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  finish_outputs();
  return result;
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
  for (const Master& each : masters_)
    result.masters.push_back({each.spec->name.text, each.spec->address, each.master->cycles(),
                              each.master->min_slave_interval_us(), each.spec->bus.min_slave_interval.has_value()});
  for (const auto& slave : slaves_) {
    slave->chip().sync(result.simulated);
    SlaveResult entry = slave->result();
    if (const bus::Master1* master = master_of(slave->name())) {
      const bus::SlaveView& view = master->slave(*listed_address(slave->name()));
      entry.master_state = bus::name(view.state);
      entry.master_reason = view.reason;
      entry.inputs = view.inputs;
    }
    result.slaves.push_back(std::move(entry));
  }
  checks_.finish(result.simulated);
  result.checks = checks_.results();
  result.violations = violations_ + checks_.failures();
  result.expectations = script_->finish(result.simulated, result.interrupted);
  result.occurrences = occurrences_;
  std::stable_sort(result.occurrences.begin(), result.occurrences.end(), [](const Occurrence& a, const Occurrence& b) {
    return std::tie(a.at, a.station) < std::tie(b.at, b.station);
  });
  result.occurrences_dropped = occurrences_dropped_;
  result.refused = refusals_.list();
  const bool met = std::all_of(result.expectations.begin(), result.expectations.end(),
                               [](const ExpectationResult& each) { return each.passed || each.left_out; });
  result.passed = met && result.violations == 0 && !result.interrupted;
  return result;
}

/// Once a second of wall time what was written goes to disk, for the case that the process is killed. False: an output
/// cannot be written any more (a full disk), so the run need not go on.
bool Bench::keep_outputs(Tick at) {
  const auto now = std::chrono::steady_clock::now();
  if (now >= next_save_) {
    next_save_ = now + std::chrono::seconds(1);
    if (waves_) waves_->save(at);
    if (log_) log_->save();
    if (trace_) trace_->save();
  }
  return !(waves_ && waves_->failed()) && !(log_ && log_->failed()) && !(trace_ && trace_->failed());
}

/// A run that one of them has ended early leaves none of them.
void Bench::finish_outputs() {
  if (waves_) waves_->check();
  if (log_) log_->check();
  if (trace_) trace_->check();
  if (waves_) waves_->finish(std::max(now(), stopped() ? now() : scenario_.end));
  if (log_) log_->finish();
  if (trace_) trace_->finish();
}

}  // namespace tb
