#include "tb/bench/slave_station.hpp"

#include <algorithm>
#include <utility>

namespace tb {

SlaveStation::SlaveStation(const scenario::Slave& slave, user_cpu::StationConfig station,
                           std::unique_ptr<ChipView> chip)
    : slave_(slave), station_(std::move(station)), chip_(std::move(chip)) {}

namespace {

user_cpu::AcyclicObject object_of(const scenario::Dpv1Object& object) {
  const auto bit = [](bool wanted, unsigned value) { return wanted ? value : 0U; };
  const unsigned services = bit(object.read, DSDPV1_MAY_READ) | bit(object.write, DSDPV1_MAY_WRITE) |
                            bit(object.transport, DSDPV1_MAY_TRANSPORT);
  return {static_cast<std::uint8_t>(object.slot),       static_cast<std::uint8_t>(object.index),
          static_cast<std::uint8_t>(services),          object.classes,
          static_cast<std::uint8_t>(object.min_length), object.data};
}

user_cpu::AcyclicOptions acyclic_options(const scenario::Dpv1User& user) {
  user_cpu::AcyclicOptions options;
  for (const scenario::Dpv1Object& object : user.objects) options.objects.push_back(object_of(object));
  if (user.im0) options.im0 = *user.im0;
  options.answering = user.answering;
  options.delay = user.delay;
  options.error_code_1 = static_cast<std::uint8_t>(user.error_code_1);
  options.error_code_2 = static_cast<std::uint8_t>(user.error_code_2);
  return options;
}

}  // namespace

user_cpu::ProgramOptions SlaveStation::options() const {
  const scenario::UserCpu& user = slave_.user_cpu;
  user_cpu::ProgramOptions options;
  options.station = station_;
  options.start_delay = user.start_delay;
  options.period = user.cycle;
  options.inputs = user.behaviour;
  options.constant = user.constant;
  options.policy = user.overwrite_inputs ? DSDPV1_INPUT_NEWEST : DSDPV1_INPUT_WHEN_CONSUMED;
  options.prm = user.judge_prm;
  options.cfg = user.judge_cfg;
  options.judge_delay = user.judge_delay;
  options.judge_in_handler = user.judge_in_handler;
  options.retry_delay = user.retry_delay;
  options.acyclic = acyclic_options(user.dpv1);
  return options;
}

void SlaveStation::hold_in_reset(Tick now) {
  if (program_) add_counters(before_reset_);
  cpu_.reset();
  program_.reset();
  outputs_seen_ = 0;
  chip_->reset_host(now);
  chip_->set_reset(now, false);
}

void SlaveStation::release_reset(Tick now) {
  chip_->set_reset(now, true);
  auto timing = static_cast<const user_cpu::CpuTiming&>(slave_.user_cpu.timing);
  timing.access = static_cast<const user_cpu::AccessTiming&>(slave_.user_cpu.access);
  if (slave_.user_cpu.fsmc) {
    const user_cpu::FsmcAccess fsmc = user_cpu::access_timing(user_cpu::with({}, *slave_.user_cpu.fsmc));
    timing.access = fsmc.read;
    timing.write_access = fsmc.write;
  }
  program_ = std::make_unique<user_cpu::UserProgram>(options());
  program_->on_error = [this](const user_cpu::DriverError& error) {
    if (on_driver_error) on_driver_error(error);
  };
  cpu_ = std::make_unique<user_cpu::NativeCpu>(chip_->host_bus(), timing, program_->entry(), now);
}

void SlaveStation::command(Tick now, const user_cpu::Command& command) {
  if (!program_) return;  // held in reset: nobody listens
  program_->post(command);
  cpu_->wake(now);
}

void SlaveStation::reinitialise(Tick now, std::optional<int> address, const std::optional<bus::Bytes>& cfg) {
  if (address) station_.address = static_cast<std::uint8_t>(*address);
  if (cfg) station_.cfg = *cfg;
  command(now, user_cpu::command::Reinitialise{station_});
}

void SlaveStation::intr0_changed(Tick at, bool level) {
  if (cpu_) cpu_->intr0_changed(at, level);
}

void SlaveStation::run(Tick now) {
  cpu_->run(now);
  const std::uint64_t received = program_->counters().outputs_received;
  if (received == outputs_seen_) return;
  outputs_seen_ = received;
  const bool changed = outputs_ != program_->outputs();
  outputs_ = program_->outputs();
  if (on_outputs) on_outputs(now, changed);
}

void SlaveStation::add_counters(SlaveResult& result) const {
  const user_cpu::ProgramCounters& program = program_->counters();
  const user_cpu::PortCounters& port = program_->port_counters();
  result.longest_user_wait = std::max(result.longest_user_wait, port.longest_wait);
  result.longest_hold = std::max(result.longest_hold, port.longest_hold);
  result.holds += port.holds;
  result.given_up += port.given_up;
  result.bad_reads += cpu_->counters().bad_reads;
  result.exchanges += program.exchanges;
  result.outputs_received += program.outputs_received;
  result.inputs_written += program.inputs_written;
  result.judgements += program.judgements;
  result.driver_errors += program.driver_errors;
}

SlaveResult SlaveStation::result() const {
  SlaveResult result = before_reset_;
  if (program_) add_counters(result);
  result.name = name();
  result.status = chip_->chip().status();
  result.tsdr = tsdr_;
  result.outputs = outputs_;
  return result;
}

}  // namespace tb
