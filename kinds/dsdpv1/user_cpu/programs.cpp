#include "kinds/dsdpv1/user_cpu/programs.hpp"

#include <algorithm>
#include <utility>

#include "kinds/dsdpv1/user_cpu/orders.hpp"
#include "registers/dsdpv1_regs.h"

extern "C" {
#include "driver/dsdpv1_internal.h"
}

namespace dsdpv1::user_cpu {

dsdpv1_config driver_config(const StationConfig& station) {
  dsdpv1_config config{};
  config.address = station.address;
  config.ident = station.ident;
  config.address_change = station.address_change;
  config.freeze = station.freeze;
  config.sync = station.sync;
  config.fail_safe = station.fail_safe;
  config.dpv1 = station.dpv1;
  config.max_input = station.max_input;
  config.max_output = station.max_output;
  config.max_diag = station.max_diag;
  config.max_prm = station.max_prm;
  config.max_cfg = station.max_cfg;
  config.prm_mode = station.prm_mode;
  config.cfg_mode = station.cfg_mode;
  config.cfg = station.cfg.data();
  config.cfg_length = static_cast<std::uint8_t>(std::min<std::size_t>(station.cfg.size(), 255));
  return config;
}

dsdpv1_diag_type diag_type(DiagnosisKind kind) {
  switch (kind) {
    case DiagnosisKind::kExtended: return DSDPV1_DIAG_EXTENDED;
    case DiagnosisKind::kExternal: return DSDPV1_DIAG_EXTERNAL;
    case DiagnosisKind::kExternalGone: return DSDPV1_DIAG_EXTERNAL_GONE;
    case DiagnosisKind::kStatic: return DSDPV1_DIAG_STATIC;
    case DiagnosisKind::kStaticGone: return DSDPV1_DIAG_STATIC_GONE;
  }
  return DSDPV1_DIAG_EXTENDED;
}

ProgramError program_error(const DriverError& error) {
  return {error.at, driver_error_code(error.error),
          std::string("the driver's ") + error.during + " failed: " + dsdpv1_error_text(error.error)};
}

NativeCpu::Program UserProgram::entry() {
  return [this](Cpu& cpu) { run_firmware(cpu); };
}

void UserProgram::run_firmware(Cpu& cpu) {
  cpu_ = &cpu;
  dsdpv1_judge judge{};
  judge.ctx = this;
  judge.prm = [](void* ctx, const std::uint8_t*, std::uint8_t) {
    auto* self = static_cast<UserProgram*>(ctx);
    return self->judge(self->options_.prm);
  };
  judge.cfg = [](void* ctx, const dsdpv1_cfg_block* block) {
    auto* self = static_cast<UserProgram*>(ctx);
    self->input_length_ = block->input_length;
    return self->judge(self->options_.cfg);
  };
  open(judge);
  if (options_.acyclic.any()) {
    acyclic_ = std::make_unique<AcyclicServer>(options_.acyclic);
    check(acyclic_->open(device_), "acyclic_open");
  }
  wait_for_start();
  if (bring_up()) main_loop();
}

/// Executes commands that need no driver meanwhile.
void UserProgram::wait_for_start() {
  const Tick start = cpu_->now() + options_.start_delay;
  const auto needs_no_driver = [](const DriverCommand& command) {
    return std::holds_alternative<command::HostTelegram>(command) ||
           std::holds_alternative<command::SpoilTelegrams>(command);
  };
  while (cpu_->wait_for_wake(start))
    while (!commands_.empty() && needs_no_driver(commands_.front())) run_command();
}

void UserProgram::open(const dsdpv1_judge& judge) {
  if (!std::holds_alternative<std::monostate>(host_.port)) {
    serial_ = std::make_unique<SerialPort>(*cpu_, host_);
    check(serial_->open(device_, judge), "open");
    return;
  }
  port_ = std::make_unique<DriverPort>(*cpu_);
  const dsdpv1_port port = port_->port();
  dsdpv1_open(&device_, &port, &judge);
}

const HoldCounters& UserProgram::port_counters() const {
  if (serial_) return serial_->counters();
  return port_ ? port_->counters() : before_start_;
}

bool UserProgram::bring_up() {
  const auto station = options_.station;
  for (int attempt = 1;; ++attempt) {
    if (check(dsdpv1_wait_ready(&device_), "wait_ready") && initialise(station)) break;
    if (attempt == options_.init_attempts) return false;
    cpu_->wait(options_.retry_delay);
  }
  cpu_->on_intr0([this] { intr0(); });
  service();  // serves events between the initialisation and the line above
  return true;
}

bool UserProgram::initialise(const StationConfig& station) {
  const dsdpv1_config config = driver_config(station);
  if (!check(dsdpv1_initialise(&device_, &config), "initialise")) return false;
  ++counters_.initialisations;
  input_length_.reset();
  return true;
}

void UserProgram::main_loop() {
  for (Tick due = cpu_->now();; due += options_.period) {
    do {
      run_commands();
      wait_while_stopped();
    } while (cpu_->wait_for_wake(due) || !commands_.empty());
    due = std::max(due, cpu_->now() - options_.period);  // a long hold must not cause a burst of exchanges
    service_if_pending();
    exchange();
    poll_acyclic();
    service_if_pending();  // an INTR0 during the exchange found the DPRAM held
  }
}

// ---------------------------------------------------------------------------------------------------------- exchange

void UserProgram::exchange() {
  std::uint8_t buffer[DSDPV1_MAX_IO];
  dsdpv1_exchange_result result{};
  result.outputs = buffer;
  result.capacity = sizeof buffer;
  const std::vector<std::uint8_t> inputs =
      next_inputs_.next(input_length_.value_or(std::uint8_t{0}), outputs_, device_.max_input);
  const bool known = inputs_known();
  const auto length = static_cast<std::uint8_t>(std::min<std::size_t>(inputs.size(), 255));
  static constexpr std::uint8_t kNothing = 0;  // inputs of length 0 are inputs as well
  const std::uint8_t* bytes = !known ? nullptr : inputs.empty() ? &kNothing : inputs.data();
  ++counters_.exchanges;
  check(dsdpv1_exchange(&device_, options_.overwrite_inputs ? DSDPV1_INPUT_NEWEST : DSDPV1_INPUT_WHEN_CONSUMED, bytes,
                        length, &result),
        "exchange");
  if (result.inputs_written) {
    ++counters_.inputs_written;
    inputs_ = inputs;
  }
  if (result.outputs_new) {
    ++counters_.outputs_received;
    outputs_.assign(buffer, buffer + result.length);
  }
  if (result.intr0_missed) service();
}

void UserProgram::poll_acyclic() {
  if (acyclic_) check(acyclic_->poll(cpu_->now()), "acyclic_poll");
}

/// Before the master has sent a configuration the length of the inputs is unknown.
bool UserProgram::inputs_known() const {
  return next_inputs_.are_set() || (input_length_ && options_.inputs != InputSource::kIdle);
}

// ----------------------------------------------------------------------------------------------------------- judging

void UserProgram::intr0() {
  if (options_.judge_in_handler && !stopped_)
    service();
  else
    dsdpv1_on_intr0(&device_);
}

void UserProgram::service_if_pending() {
  if (dsdpv1_intr0_pending(&device_)) service();
}

void UserProgram::service() {
  const dsdpv1_error error = dsdpv1_service(&device_);
  if (error != DSDPV1_ERR_NESTED)  // not a failure: the interrupted program does it
    check(error, "service");
}

dsdpv1_verdict UserProgram::judge(Judgement judgement) {
  ++counters_.judgements;
  cpu_->wait(options_.judge_delay);
  switch (judgement) {
    case Judgement::kAccept: return DSDPV1_ACCEPT;
    case Judgement::kRefuse: return DSDPV1_REFUSE;
    case Judgement::kNever: break;
  }
  return DSDPV1_LATER;
}

bool UserProgram::check(dsdpv1_error error, const char* during) {
  constexpr std::size_t kLogged = 1000;
  if (error == DSDPV1_OK) return true;
  const DriverError entry{cpu_->now(), error, during};
  ++counters_.driver_errors;
  if (errors_.size() < kLogged) errors_.push_back(entry);
  if (on_error) on_error(entry);
  return false;
}

// ---------------------------------------------------------------------------------------------------------- commands

void UserProgram::run_command() {
  const DriverCommand next = commands_.front();
  commands_.pop_front();
  std::visit([this](const auto& command) { carry_out(command); }, next);
}

void UserProgram::run_commands() {
  while (!commands_.empty()) run_command();
}

void UserProgram::wait_while_stopped() {
  while (stopped_) {
    cpu_->wait_for_wake(bus::kNever);
    run_commands();
  }
}

void UserProgram::carry_out(const command::SetInputs& set) { next_inputs_.set(set.bytes); }

void UserProgram::carry_out(const command::SetDiagnosis& set) {
  const auto length = static_cast<std::uint8_t>(std::min<std::size_t>(set.bytes.size(), 255));
  check(dsdpv1_set_diagnosis(&device_, diag_type(set.kind), set.bytes.data(), length), "set_diagnosis");
}

void UserProgram::carry_out(const command::Reinitialise& again) { initialise(again.station); }

void UserProgram::claim_for(Tick duration) {
  if (!check(dsdpv1_hold(&device_), "hold")) return;
  cpu_->wait(duration);
  check(dsdpv1_release(&device_), "release");
}

/// Over the parallel port, without the driver, whose holds are as short as possible. The interrupt handler is disabled
/// meanwhile.
void UserProgram::carry_out(const command::Hold& hold) {
  if (serial_) return claim_for(hold.duration);
  const dsdpv1_port port = port_->port();
  cpu_->enable_interrupts(false);
  port.set_r_req(port.ctx, true);
  while (port.get_l_req(port.ctx) || port.get_l_sta(port.ctx)) {
  }
  port.set_r_sta(port.ctx, true);
  cpu_->wait(hold.duration);
  port.set_r_sta(port.ctx, false);
  port.set_r_req(port.ctx, false);
  cpu_->enable_interrupts(true);
}

void UserProgram::carry_out(const command::Stop&) { stopped_ = true; }

void UserProgram::carry_out(const command::Resume&) { stopped_ = false; }

void UserProgram::carry_out(const command::EarlyRSta& early) {
  cpu_->enable_interrupts(false);
  const Tick asked = cpu_->now();
  cpu_->set_r_req(true);
  cpu_->wait_until(asked + early.after);
  cpu_->set_r_sta(true);
  cpu_->wait(early.hold);
  cpu_->set_r_sta(false);
  cpu_->set_r_req(false);
  cpu_->enable_interrupts(true);
}

void UserProgram::carry_out(const command::WrongCrc& wrong) {
  constexpr std::uint8_t kLowestBit = 0x01;
  switch (wrong.area) {
    case command::Area::kInit: return port_->corrupt_writes(DSDPV1_REG_INIT_CRC, kLowestBit, wrong.times);
    case command::Area::kInputs: return port_->corrupt_writes(DSDPV1_REG_INPUT_CRC, kLowestBit, wrong.times);
    case command::Area::kDiagnosis: return port_->corrupt_writes(DSDPV1_REG_DIAG_CRC, kLowestBit, wrong.times);
    case command::Area::kC1Answer: return port_->corrupt_writes(DSDPV1_REG_C1_CRC, kLowestBit, wrong.times);
    case command::Area::kC2Answer: return port_->corrupt_writes(DSDPV1_REG_C2_CRC, kLowestBit, wrong.times);
  }
}

void UserProgram::carry_out(const command::WrongLength&) { next_inputs_.spoil_length(); }

void UserProgram::carry_out(const command::SendVerdict& verdict) {
  const auto which = static_cast<std::uint8_t>(verdict.cfg ? DSDPV1_VERDICT_CFG : DSDPV1_VERDICT_PRM);
  check(dsdpv1_send_verdict(&device_, which, verdict.refuse ? which : std::uint8_t{0}), "send_verdict");
}

void UserProgram::carry_out(const command::SpoilTelegrams& spoil) {
  if (serial_) serial_->spoil(spoil.fault, spoil.times, spoil.pause);
}

void UserProgram::carry_out(const command::HostTelegram& telegram) {
  for (int i = 0; serial_ && i < telegram.times; ++i) serial_->telegram(telegram.bytes, telegram.listen);
}

void UserProgram::carry_out(const command::SetAnswering& set) {
  options_.acyclic.answering = set.answering;
  if (acyclic_) acyclic_->set_answering(set.answering);
}

}  // namespace dsdpv1::user_cpu
