#include "kinds/dsdpv1/board/mailbox_link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <variant>

namespace dsdpv1::arm {
namespace {

using user_cpu::Tick;
namespace command = user_cpu::command;

std::uint64_t ns(Tick ticks) { return static_cast<std::uint64_t>(ticks / bus::kTicksPerNs); }

std::uint8_t say(user_cpu::Judgement judgement) {
  switch (judgement) {
    case user_cpu::Judgement::kAccept: return DSDPV1_SAY_YES;
    case user_cpu::Judgement::kRefuse: return DSDPV1_SAY_NO;
    case user_cpu::Judgement::kNever: break;
  }
  return DSDPV1_SAY_NOTHING;
}

std::uint8_t say(user_cpu::Answering answering) {
  switch (answering) {
    case user_cpu::Answering::kNormal: return DSDPV1_SAY_YES;
    case user_cpu::Answering::kRefuse: return DSDPV1_SAY_NO;
    case user_cpu::Answering::kNever: break;
  }
  return DSDPV1_SAY_NOTHING;
}

std::uint8_t word_for(user_cpu::InputSource source) {
  switch (source) {
    case user_cpu::InputSource::kLoopBack: return DSDPV1_INPUTS_LOOP_BACK;
    case user_cpu::InputSource::kCount: return DSDPV1_INPUTS_COUNT;
    case user_cpu::InputSource::kConstant: return DSDPV1_INPUTS_CONSTANT;
    case user_cpu::InputSource::kIdle: break;
  }
  return DSDPV1_INPUTS_IDLE;
}

/// Copies as much as fits and returns that number.
template <std::size_t kSize>
std::uint8_t put(const std::vector<std::uint8_t>& bytes, std::uint8_t (&to)[kSize]) {
  const std::size_t count = std::min(bytes.size(), kSize);
  std::copy_n(bytes.begin(), count, to);
  return static_cast<std::uint8_t>(count);
}

/// The memory was cleared, so the text is terminated.
template <std::size_t kSize>
void put(const std::string& text, char (&to)[kSize]) {
  std::copy_n(text.begin(), std::min(text.size(), kSize - 1), to);
}

void fill(dsdpv1_mailbox_station& to, const user_cpu::StationConfig& from) {
  to = {};
  to.ident = from.ident;
  to.address = from.address;
  to.address_change = from.address_change;
  to.freeze = from.freeze;
  to.sync = from.sync;
  to.fail_safe = from.fail_safe;
  to.dpv1 = from.dpv1;
  to.max_input = from.max_input;
  to.max_output = from.max_output;
  to.max_diag = from.max_diag;
  to.max_prm = from.max_prm;
  to.max_cfg = from.max_cfg;
  to.prm_mode = from.prm_mode;
  to.cfg_mode = from.cfg_mode;
  to.cfg_length = put(from.cfg, to.cfg);
}

void fill(dsdpv1_mailbox_nameplate& to, const user_cpu::Nameplate& from) {
  to.present = 1;
  to.manufacturer_id = from.manufacturer_id;
  to.hardware_revision = from.hardware_revision;
  to.profile_id = from.profile_id;
  put(from.software_revision, to.software_revision);
  put(from.order_id, to.order_id);
  put(from.serial_number, to.serial_number);
}

dsdpv1_mailbox_object object_of(const user_cpu::AcyclicObject& from) {
  dsdpv1_mailbox_object to = {};
  to.slot = from.slot;
  to.index = from.index;
  to.services = from.services;
  to.classes = from.classes;
  to.min_length = from.min_length;
  to.length = put(from.data, to.data);
  return to;
}

void fill(dsdpv1_mailbox_settings& to, const user_cpu::ProgramOptions& from) {
  to.start_delay_ns = ns(from.start_delay);
  to.period_ns = ns(from.period);
  to.judge_delay_ns = ns(from.judge_delay);
  to.retry_delay_ns = ns(from.retry_delay);
  to.answer_delay_ns = ns(from.acyclic.delay);
  to.inputs = word_for(from.inputs);
  to.overwrite_inputs = from.overwrite_inputs;
  to.judge_in_handler = from.judge_in_handler;
  to.prm_judgement = say(from.prm);
  to.cfg_judgement = say(from.cfg);
  to.answering = say(from.acyclic.answering);
  to.error_code_1 = from.acyclic.error_code_1;
  to.error_code_2 = from.acyclic.error_code_2;
  to.constant_length = put(from.constant, to.constant);
  to.object_count =
      static_cast<std::uint8_t>(std::min<std::size_t>(from.acyclic.objects.size(), DSDPV1_MAILBOX_OBJECTS));
  for (std::size_t i = 0; i < to.object_count; ++i) to.objects[i] = object_of(from.acyclic.objects[i]);
  if (from.acyclic.im0) fill(to.im0, *from.acyclic.im0);
  fill(to.station, from.station);
}

// ---------------------------------------------------------------------------------------------------------- commands

struct Fill {
  dsdpv1_mailbox_command& to;

  void operator()(const command::SetInputs& from) const {
    to.kind = DSDPV1_CMD_SET_INPUTS;
    to.length = put(from.bytes, to.bytes);
  }
  void operator()(const command::SetDiagnosis& from) const {
    to.kind = DSDPV1_CMD_SET_DIAGNOSIS;
    to.value = static_cast<std::uint8_t>(user_cpu::diag_type(from.kind));
    to.length = put(from.bytes, to.bytes);
  }
  void operator()(const command::Reinitialise& from) const {
    to.kind = DSDPV1_CMD_REINITIALISE;
    fill(to.station, from.station);
  }
  void operator()(const command::Hold& from) const {
    to.kind = DSDPV1_CMD_HOLD;
    to.time_ns = ns(from.duration);
  }
  void operator()(const command::Stop&) const { to.kind = DSDPV1_CMD_STOP; }
  void operator()(const command::Resume&) const { to.kind = DSDPV1_CMD_RESUME; }
  void operator()(const command::EarlyRSta& from) const {
    to.kind = DSDPV1_CMD_EARLY_R_STA;
    to.time_ns = ns(from.after);
    to.hold_ns = ns(from.hold);
  }
  void operator()(const command::WrongCrc& from) const {
    to.kind = DSDPV1_CMD_WRONG_CRC;
    to.times = static_cast<std::uint32_t>(from.times);
    switch (from.area) {
      case command::Area::kInit: to.value = DSDPV1_AREA_INIT; break;
      case command::Area::kInputs: to.value = DSDPV1_AREA_INPUTS; break;
      case command::Area::kDiagnosis: to.value = DSDPV1_AREA_DIAGNOSIS; break;
      case command::Area::kC1Answer: to.value = DSDPV1_AREA_C1_ANSWER; break;
      case command::Area::kC2Answer: to.value = DSDPV1_AREA_C2_ANSWER; break;
    }
  }
  void operator()(const command::WrongLength&) const { to.kind = DSDPV1_CMD_WRONG_LENGTH; }
  void operator()(const command::SendVerdict& from) const {
    to.kind = DSDPV1_CMD_VERDICT;
    to.value = static_cast<std::uint8_t>(from.cfg ? DSDPV1_VERDICT_CFG : DSDPV1_VERDICT_PRM);
    to.refuse = from.refuse;
  }
  void operator()(const command::SetAnswering& from) const {
    to.kind = DSDPV1_CMD_ANSWERING;
    to.value = say(from.answering);
  }
  void operator()(const command::SpoilTelegrams& from) const {
    to.kind = DSDPV1_CMD_SPOIL;
    to.times = static_cast<std::uint32_t>(from.times);
    switch (from.fault) {
      case user_cpu::TelegramFault::kFlippedBit: to.value = DSDPV1_SPOIL_BIT; break;
      case user_cpu::TelegramFault::kCut: to.value = DSDPV1_SPOIL_CUT; break;
      case user_cpu::TelegramFault::kWrongParity: to.value = DSDPV1_SPOIL_PARITY; break;
      default: throw std::logic_error("the board's firmware has no such telegrams");
    }
  }
  /// A scenario with this action is rejected (kinds/dsdpv1/keys/serial_keys.cpp).
  void operator()(const command::HostTelegram&) const {
    throw std::logic_error("the board sends no others' telegrams");
  }
};

constexpr std::array<const char*, 8> kCalls = {"wait_ready",    "initialise",   "exchange",     "service",
                                               "set_diagnosis", "send_verdict", "acyclic_open", "acyclic_poll"};
static_assert(kCalls.size() == DSDPV1_DURING_ACYCLIC_POLL + 1);

bool is_failure(std::uint8_t error) {
#define X(name, value, text) \
  if (error == (value)) return error != DSDPV1_OK;
  DSDPV1_ERROR_TABLE(X)
#undef X
  return false;
}

}  // namespace

MailboxLink::MailboxLink(std::uint8_t* memory, const user_cpu::ProgramOptions& options)
    : box_(*reinterpret_cast<dsdpv1_mailbox*>(memory)) {
  std::memset(memory, 0, sizeof box_);
  box_.magic = DSDPV1_MAILBOX_MAGIC;
  box_.version = DSDPV1_MAILBOX_VERSION;
  box_.size = sizeof box_;
  fill(box_.settings, options);
}

bool MailboxLink::look(Tick now, const std::function<void(const user_cpu::ProgramError&)>& on_error) {
  if (!wrong_.empty()) return false;
  is_right("done", box_.done, done_is_right(), "`posted` and the number before it");
  const bool ready = wrong_.empty() && hand_over();
  fetch_outputs();
  fetch_errors(now, on_error);
  return ready;
}

bool MailboxLink::hand_over() {
  if (commands_.empty() || !is_done()) return false;
  box_.command = {};
  std::visit(Fill{box_.command}, commands_.front());
  commands_.pop_front();
  box_.posted = box_.posted + 1;
  return true;
}

/// Returns `right`; keeps the first wrong value for wrong().
bool MailboxLink::is_right(const std::string& field, unsigned value, bool right, const char* allowed) {
  if (!right && wrong_.empty()) wrong_ = fmt::format("{} is {}, expected {}", field, value, allowed);
  return right;
}

void MailboxLink::fetch_outputs() {
  const auto& report = box_.report;
  if (outputs_received_ == report.outputs_received) return;
  outputs_received_ = report.outputs_received;
  const std::size_t length = report.output_length;
  if (is_right("report.output_length", report.output_length, length <= sizeof report.outputs, "0 to 244"))
    outputs_.assign(report.outputs, report.outputs + length);
}

void MailboxLink::fetch_errors(Tick now, const std::function<void(const user_cpu::ProgramError&)>& on_error) {
  const std::uint32_t count = box_.report.error_count;
  if (count < errors_seen_) errors_seen_ = 0;  // the firmware has restarted and counts from 0
  if (count - errors_seen_ > DSDPV1_MAILBOX_ERRORS) errors_seen_ = count - DSDPV1_MAILBOX_ERRORS;
  for (; errors_seen_ != count; ++errors_seen_) {
    const std::uint32_t place = errors_seen_ % DSDPV1_MAILBOX_ERRORS;
    const auto& each = box_.report.errors[place];
    const std::string name = fmt::format("report.errors[{}].", place);
    if (!is_right(name + "error", each.error, is_failure(each.error), "the failures of dsdpv1_error") ||
        !is_right(name + "during", each.during, each.during < kCalls.size(), "0 to 7"))
      continue;
    if (on_error)
      on_error(user_cpu::program_error({now, static_cast<dsdpv1_error>(each.error), kCalls.at(each.during)}));
  }
}

user_cpu::ProgramCounters MailboxLink::counters() const {
  const auto& report = box_.report;
  user_cpu::ProgramCounters counters;
  counters.exchanges = report.exchanges;
  counters.outputs_received = report.outputs_received;
  counters.inputs_written = report.inputs_written;
  counters.initialisations = report.initialisations;
  counters.judgements = report.judgements;
  counters.driver_errors = report.error_count;
  return counters;
}

}  // namespace dsdpv1::arm
