#include "kinds/spc3/user_cpu/program.hpp"

#include <algorithm>
#include <utility>

#include "bus/gsd/cfg.hpp"
#include "registers/spc3_regs.h"

namespace dsdpv1::spc3_user {

using user_cpu::DiagnosisKind;
using user_cpu::Judgement;

namespace {

constexpr std::uint8_t kPrmHead = 7;    // bytes of Set_Prm before the user's
constexpr std::uint8_t kSsaBytes = 16;  // of a Set_Slave_Address: 12 for the user
constexpr Tick kOfflinePoll = 120'000;  // 10 us
constexpr std::uint16_t kHandled = SPC3_REG_EVENT_MAC_RESET | SPC3_REG_EVENT_BAUD_DETECT | SPC3_REG_EVENT_NEW_GC |
                                   SPC3_REG_EVENT_NEW_SSA | SPC3_REG_EVENT_NEW_CFG | SPC3_REG_EVENT_NEW_PRM;

const char* error_code(spc3_error error) {
#define X(name, value, text) \
  if (error == (name)) return #name;
  SPC3_ERROR_TABLE(X)
#undef X
  return "SPC3_ERR_UNKNOWN";
}

}  // namespace

void UserProgram::run(user_cpu::Cpu& cpu) {
  cpu_ = &cpu;
  if (firmware_.spi_timing) spi_.emplace(cpu, *firmware_.spi_timing);
  open();
  cpu.wait_until(cpu.now() + options_.start_delay);
  for (;;) {
    bring_up();
    main_loop();
  }
}

spc3_port UserProgram::port() {
  spc3_port port{};
  port.ctx = this;
  port.read = [](void* ctx, std::uint16_t address) { return static_cast<UserProgram*>(ctx)->read(address); };
  port.write = [](void* ctx, std::uint16_t address, std::uint8_t value) {
    static_cast<UserProgram*>(ctx)->write(address, value);
  };
  if (!spi_) return port;
  port.read_array = [](void* ctx, std::uint16_t address, std::uint8_t* bytes, std::uint8_t length) {
    static_cast<UserProgram*>(ctx)->spi_->read_array(address, bytes, length);
  };
  port.write_array = [](void* ctx, std::uint16_t address, const std::uint8_t* bytes, std::uint8_t length) {
    static_cast<UserProgram*>(ctx)->spi_->write_array(address, bytes, length);
  };
  return port;
}

void UserProgram::open() {
  const spc3_port port = this->port();
  spc3_application application{};
  application.ctx = this;
  application.prm = [](void* ctx, const std::uint8_t*, std::uint8_t length) {
    return static_cast<UserProgram*>(ctx)->judge_prm(length);
  };
  application.cfg = [](void* ctx, spc3_cfg* cfg) { return static_cast<UserProgram*>(ctx)->judge_cfg(*cfg); };
  application.address = [](void* ctx, std::uint8_t address, bool locked, const std::uint8_t*, std::uint8_t) {
    static_cast<UserProgram*>(ctx)->keep_address(address, locked);
  };
  (void)spc3_open(&device_, &port, &application);
}

// --- bring-up --------------------------------------------------------------------------------------------------------

void UserProgram::bring_up() {
  cpu_->on_intr0(nullptr);
  while (!initialise()) cpu_->wait_until(cpu_->now() + options_.retry_delay);
  offline_ = interrupted_ = false;
  give_inputs();
  if (firmware_.mode == Mode::kInterrupt) cpu_->on_intr0([this] { handler(); });
  spc3_start(&device_);
}

bool UserProgram::initialise() {
  const user_cpu::StationConfig& station = options_.station;
  spc3_config config{};
  config.address = station.address;
  config.address_locked = address_locked_;
  config.ident = station.ident;
  config.max_output = station.max_output;
  config.max_input = station.max_input;
  config.max_diag = station.max_diag;
  config.max_prm = static_cast<std::uint8_t>(std::min(kPrmHead + station.max_prm, 0xFF));
  config.max_cfg = station.max_cfg;
  config.max_ssa = station.address_change ? kSsaBytes : std::uint8_t{0};
  config.cfg = station.cfg.data();
  config.cfg_length = static_cast<std::uint8_t>(std::min<std::size_t>(station.cfg.size(), 0xFF));
  config.sync = station.sync;
  config.freeze = station.freeze;
  config.clear_by_empty = station.fail_safe;
  config.baud_control = static_cast<std::uint8_t>(firmware_.wd_baud_control);
  config.user_wd = static_cast<std::uint16_t>(firmware_.user_watchdog);
  config.interrupts = firmware_.mode == Mode::kInterrupt ? kHandled : std::uint16_t{0};
  config.vpc3 = firmware_.vpc3;
  spc3_error error = spc3_initialise(&device_, &config);
  for (; error == SPC3_ERR_NOT_OFFLINE; error = spc3_initialise(&device_, &config))
    cpu_->wait_until(cpu_->now() + kOfflinePoll);
  if (!check(error, "initialise")) return false;
  ++counters_.initialisations;
  input_length_ = station.max_input;
  return true;
}

bool UserProgram::check(spc3_error error, const char* during) {
  if (error == SPC3_OK) return true;
  ++counters_.driver_errors;
  if (on_error)
    on_error(
        {cpu_->now(), error_code(error), std::string("the driver's ") + during + " failed: " + spc3_error_text(error)});
  return false;
}

// --- main loop and handler -------------------------------------------------------------------------------------------

/// Until the chip has gone OFFLINE.
void UserProgram::main_loop() {
  for (Tick due = cpu_->now(); !offline_; due += options_.period) {
    do {
      run_commands();
      if (offline_) return;
    } while (cpu_->wait_for_wake(stopped_ ? bus::kNever : due) || stopped_ || !commands_.empty());
    due = std::max(due, cpu_->now() - options_.period);  // a pause must not cause a burst of exchanges
    if (firmware_.mode == Mode::kPolled || interrupted_) service();
    exchange();
  }
}

void UserProgram::handler() {
  interrupted_ = true;
  if (options_.judge_in_handler && !stopped_) service();
}

void UserProgram::service() {
  interrupted_ = false;
  if ((spc3_service(&device_) & SPC3_REG_EVENT_MAC_RESET) != 0U) offline_ = true;
}

void UserProgram::exchange() {
  ++counters_.exchanges;
  if (options_.inputs != user_cpu::InputSource::kIdle) fetch_outputs();
  give_inputs();
  if (diagnosis_) hand_over_diagnosis();
  spc3_serve_watchdog(&device_);
}

void UserProgram::fetch_outputs() {
  std::uint8_t buffer[SPC3_MAX_BLOCK];
  spc3_outputs outputs{};
  outputs.bytes = buffer;
  outputs.capacity = sizeof buffer;
  if (!check(spc3_get_outputs(&device_, &outputs), "get_outputs") || !outputs.fresh) return;
  ++counters_.outputs_received;
  outputs_.assign(buffer, buffer + outputs.length);
}

/// The handler may accept another configuration meanwhile: then once more.
void UserProgram::give_inputs() {
  if (options_.inputs == user_cpu::InputSource::kIdle && !inputs_.are_set()) return;
  for (;;) {
    const std::uint8_t length = input_length_;
    std::vector<std::uint8_t> bytes = inputs_.next(length, outputs_, length);
    bytes.resize(length);
    const spc3_error error = spc3_set_inputs(&device_, bytes.data(), length);
    if (error != SPC3_OK && length != input_length_) continue;
    counters_.inputs_written += check(error, "set_inputs") ? 1 : 0;
    return;
  }
}

// --- judging ---------------------------------------------------------------------------------------------------------

/// Table 13 in the firmware: the chip knows no judging modes.
bool UserProgram::judge_prm(std::uint8_t length) {
  const user_cpu::StationConfig& station = options_.station;
  if (station.prm_mode == 2) return judge(options_.prm, false);
  ++counters_.judgements;
  return station.prm_mode == 0 || length == kPrmHead + station.max_prm;
}

bool UserProgram::judge_cfg(spc3_cfg& cfg) {
  const user_cpu::StationConfig& station = options_.station;
  const std::vector<std::uint8_t> bytes(cfg.bytes, cfg.bytes + cfg.length);  // the driver has one copy, for all blocks
  const bus::CfgLengths lengths = bus::cfg_lengths(bytes);
  bool right = true;
  if (station.cfg_mode == 2)
    right = judge(options_.cfg, true);
  else
    ++counters_.judgements;
  if (station.cfg_mode == 1) right = bytes == station.cfg;
  if (!right || lengths.input > station.max_input || lengths.output > station.max_output) return false;
  cfg.input_length = static_cast<std::uint8_t>(lengths.input);
  cfg.output_length = static_cast<std::uint8_t>(lengths.output);
  input_length_ = cfg.input_length;
  return true;
}

bool UserProgram::judge(Judgement judgement, bool cfg) {
  ++counters_.judgements;
  cpu_->wait_until(cpu_->now() + options_.judge_delay);
  return judgement == Judgement::kNever ? await_verdict(cfg) : judgement == Judgement::kAccept;
}

/// The driver wants a verdict: the program stands still until the script has one.
bool UserProgram::await_verdict(bool cfg) {
  for (;;) {
    const auto found = std::find_if(commands_.begin(), commands_.end(), [cfg](const user_cpu::Command& each) {
      const auto* verdict = std::get_if<command::SendVerdict>(&each);
      return verdict != nullptr && verdict->cfg == cfg;
    });
    if (found != commands_.end()) {
      const bool right = !std::get<command::SendVerdict>(*found).refuse;
      commands_.erase(found);
      return right;
    }
    cpu_->wait_for_wake(bus::kNever);
  }
}

void UserProgram::keep_address(std::uint8_t address, bool locked) {
  options_.station.address = address;
  address_locked_ = locked;
}

// --- commands --------------------------------------------------------------------------------------------------------

void UserProgram::run_commands() {
  while (!commands_.empty()) {
    const user_cpu::Command next = commands_.front();
    commands_.pop_front();
    std::visit([this](const auto& command) { carry_out(command); }, next);
  }
}

void UserProgram::carry_out(const command::SetDiagnosis& set) {
  const auto flag = [this](std::uint8_t bit, bool on) {
    diagnosis_flags_ = static_cast<std::uint8_t>(on ? diagnosis_flags_ | bit : diagnosis_flags_ & ~bit);
  };
  switch (set.kind) {
    case DiagnosisKind::kExtended: break;
    case DiagnosisKind::kExternal:
    case DiagnosisKind::kExternalGone: flag(SPC3_DIAG_EXT, set.kind == DiagnosisKind::kExternal); break;
    case DiagnosisKind::kStatic:
    case DiagnosisKind::kStaticGone: flag(SPC3_DIAG_STAT, set.kind == DiagnosisKind::kStatic); break;
  }
  diagnosis_ = set.bytes;
  hand_over_diagnosis();
}

/// While the chip has both buffers the main loop tries again.
void UserProgram::hand_over_diagnosis() {
  const auto length = static_cast<std::uint8_t>(std::min<std::size_t>(diagnosis_->size(), 0xFF));
  const spc3_error error = spc3_set_diagnosis(&device_, diagnosis_flags_, diagnosis_->data(), length);
  if (error == SPC3_ERR_DIAG_BUSY) return;
  diagnosis_.reset();
  check(error, "set_diagnosis");
}

void UserProgram::carry_out(const command::Reinitialise& again) {
  options_.station = again.station;
  offline_ = true;
}

void UserProgram::carry_out(const command::OfChip& order) {
  if (order.order == kGoOffline) return spc3_go_offline(&device_);
  if (order.order == kLeaveMaster) return spc3_leave_master(&device_);
  const auto address = static_cast<std::uint16_t>(order.bytes.at(0) << 8 | order.bytes.at(1));
  if (order.order == kReadChip) (void)read(address);
  for (std::size_t i = 2; order.order == kWriteChip && i < order.bytes.size(); ++i)
    write(static_cast<std::uint16_t>(address + i - 2), order.bytes[i]);
}

}  // namespace dsdpv1::spc3_user
