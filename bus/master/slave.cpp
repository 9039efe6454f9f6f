#include "bus/master/slave.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace dsdpv1::bus {

namespace {

// Station_status_1 and 2 (tables A.6 of the APC3 manual).
constexpr unsigned kNotReady = 0x02, kCfgFault = 0x04, kNotSupported = 0x10, kPrmFault = 0x40;
constexpr unsigned kPrmReq = 0x01, kStatDiag = 0x02;
constexpr std::size_t kStandardDiagnosis = 6;
constexpr std::uint8_t kNoMaster = 255;
constexpr std::uint8_t kUnlockReq = 0x40, kClearData = 0x02;

void check(bool right, const SlaveParameters& slave, const std::string& what) {
  if (!right) throw std::invalid_argument(fmt::format("slave {}: {}", slave.address, what));
}

void check_parameters(const SlaveParameters& slave) {
  check(slave.address <= kHighestAddress, slave, "addresses are 0 to 126");
  check(slave.user_prm.size() <= 237, slave,
        fmt::format("{} user parameter bytes, at most 237", slave.user_prm.size()));
  check(!slave.cfg.empty() && slave.cfg.size() <= kMaxData, slave,
        fmt::format("{} configuration bytes, expected 1 to 244", slave.cfg.size()));
  check(slave.input_length >= 0 && slave.input_length <= 244, slave,
        fmt::format("input length {}, expected 0 to 244", slave.input_length));
  check(slave.output_length >= 0 && slave.output_length <= 244, slave,
        fmt::format("output length {}, expected 0 to 244", slave.output_length));
}

std::uint16_t ident_of(const Bytes& diagnosis) {
  return static_cast<std::uint16_t>((diagnosis[4] << 8) | diagnosis[5]);
}

}  // namespace

const char* name(SlaveState state) {
  switch (state) {
    case SlaveState::kOffline: return "OFFLINE";
    case SlaveState::kDiagnose: return "DIAGNOSE";
    case SlaveState::kClear: return "CLEAR";
    case SlaveState::kSetPrm: return "SET_PRM";
    case SlaveState::kChkCfg: return "CHK_CFG";
    case SlaveState::kAwaitReady: return "AWAIT_READY";
    case SlaveState::kDataExchange: return "DATA_EXCH";
    case SlaveState::kReleasing: return "RELEASING";
    case SlaveState::kReleased: return "RELEASED";
  }
  return "";
}

SlaveHandler::SlaveHandler(SlaveParameters parameters, std::uint8_t master, Personality personality)
    : parameters_(std::move(parameters)), master_(master), personality_(personality) {
  check_parameters(parameters_);
  view_.inputs.resize(static_cast<std::size_t>(parameters_.input_length));
  view_.outputs.resize(static_cast<std::size_t>(parameters_.output_length));
}

void SlaveHandler::set_outputs(const Bytes& outputs) {
  check(outputs.size() == view_.outputs.size(), parameters_,
        fmt::format("{} output bytes, configured are {}", outputs.size(), view_.outputs.size()));
  view_.outputs = outputs;
  pattern_ = OutputPattern::kFixed;
}

void SlaveHandler::vary_outputs(OutputPattern pattern, std::uint32_t seed) {
  pattern_ = pattern;
  random_.seed(seed);
}

void SlaveHandler::renew_outputs() {
  if (pattern_ == OutputPattern::kFixed) return;
  ++exchange_;
  for (std::uint8_t& byte : view_.outputs)
    byte = pattern_ == OutputPattern::kCount ? exchange_ : static_cast<std::uint8_t>(random_() >> 8U);
}

void SlaveHandler::release() { go(SlaveState::kReleasing); }

void SlaveHandler::restart(const std::string& reason) {
  diagnosis_due_ = announced_ = false;
  alarm_.clear();
  view_.reason = reason;
  go(SlaveState::kDiagnose, reason);
}

Telegram SlaveHandler::service(std::uint8_t sap, const Bytes& data) const {
  const bool high = personality_ == Personality::kHighAlways;
  const auto function = static_cast<std::uint8_t>(fc::kRequest | (high ? fc::kSrdHigh : fc::kSrdLow));
  return framed(make_telegram(parameters_.address, master_, function, data, sap, sap::kMaster));
}

Telegram SlaveHandler::data_exchange() const {
  // EN 50170: in Clear a fail-safe slave gets no data, other slaves get zeros.
  Bytes data = view_.outputs;
  if (clear_) data.assign(parameters_.fail_safe ? 0 : data.size(), 0);
  return framed(make_telegram(parameters_.address, master_, fc::kRequest | fc::kSrdHigh, data));
}

Telegram SlaveHandler::framed(const Telegram& telegram) const {
  return personality_ == Personality::kHighAlways ? prefer_sd3(telegram) : telegram;
}

Telegram SlaveHandler::next_request() {
  asked_in_ = view_.state;
  if (view_.state == SlaveState::kDataExchange && !diagnosis_due_) renew_outputs();
  return due_request();
}

Telegram SlaveHandler::due_request() const {
  const bool classic = personality_ == Personality::kClassic;
  switch (view_.state) {
    case SlaveState::kOffline:
      if (classic) return make_telegram(parameters_.address, master_, fc::kRequest | fc::kFdlStatus);
      return service(sap::kSlaveDiag, {});
    case SlaveState::kClear:
      return make_telegram(parameters_.address, master_, fc::kRequest | fc::kSdnHigh, {kClearData, 0},
                           sap::kGlobalControl, sap::kMaster);
    case SlaveState::kSetPrm:
      return service(sap::kSetPrm, set_prm_data(parameters_, classic ? parameters_.min_tsdr : 0));
    case SlaveState::kReleasing: {
      Bytes data = set_prm_data(parameters_, 0);
      data[0] = kUnlockReq;
      return service(sap::kSetPrm, data);
    }
    case SlaveState::kChkCfg: return service(sap::kChkCfg, parameters_.cfg);
    case SlaveState::kDataExchange: return diagnosis_due_ ? service(sap::kSlaveDiag, {}) : data_exchange();
    case SlaveState::kDiagnose:
    case SlaveState::kAwaitReady:
    case SlaveState::kReleased: break;
  }
  return service(sap::kSlaveDiag, {});
}

void SlaveHandler::go(SlaveState state, const std::string& why) {
  if (view_.state == state) return;
  const SlaveState from = std::exchange(view_.state, state);
  view_.step_reason = why;
  if (state == SlaveState::kDataExchange) view_.reason.clear();
  if (on_state) on_state(from, state);
}

void SlaveHandler::done(const FdlResult& result) {
  count(result);
  if (result.outcome == FdlOutcome::kAborted || view_.state != asked_in_) return;
  if (result.outcome == FdlOutcome::kSent) {
    if (view_.state == SlaveState::kClear) go(SlaveState::kSetPrm);
    return;
  }
  if (result.answered()) return answered(result);
  if (view_.state == SlaveState::kReleasing) return go(SlaveState::kReleased);
  diagnosis_due_ = false;
  if (offline()) return;
  view_.reason = result.outcome == FdlOutcome::kNoAnswer ? "no answer" : "wrong answers";
  go(SlaveState::kOffline, view_.reason);
}

void SlaveHandler::count(const FdlResult& result) {
  SlaveCounters& counters = view_.counters;
  counters.retries += static_cast<std::uint64_t>(result.retries);
  counters.timeouts += static_cast<std::uint64_t>(result.timeouts);
  counters.errors += static_cast<std::uint64_t>(result.errors);
}

void SlaveHandler::answered(const FdlResult& result) {
  switch (view_.state) {
    case SlaveState::kOffline:
      go(SlaveState::kDiagnose);
      if (personality_ == Personality::kHighAlways) initial_diagnosis(result.answer);
      return;
    case SlaveState::kDiagnose: return initial_diagnosis(result.answer);
    case SlaveState::kSetPrm: return prm_answer(result);
    case SlaveState::kChkCfg: return cfg_answer(result);
    case SlaveState::kAwaitReady: return readiness(result.answer);
    case SlaveState::kDataExchange:
      return diagnosis_due_ ? operating_diagnosis(result.answer) : exchange_answer(result);
    case SlaveState::kReleasing: return go(SlaveState::kReleased);
    case SlaveState::kClear:
    case SlaveState::kReleased: return;
  }
}

bool SlaveHandler::refused(const Telegram& answer) {
  const std::uint8_t function = answer.function();
  if (answer.kind == TelegramKind::kSc || (function != fc::kUe && function != fc::kRr && function != fc::kRs))
    return false;
  ++view_.counters.refusals;
  return true;
}

bool SlaveHandler::take_diagnosis(const Telegram& answer) {
  if (refused(answer)) {
    view_.reason = "Slave_Diag refused";
    return false;
  }
  if (answer.data.size() < kStandardDiagnosis) {
    ++view_.counters.errors;
    view_.reason = fmt::format("Slave_Diag answered with {} bytes, at least 6 are right", answer.data.size());
    return false;
  }
  view_.diagnosis = answer.data;
  ++view_.counters.diagnoses;
  if (on_diagnosis) on_diagnosis();
  return true;
}

void SlaveHandler::initial_diagnosis(const Telegram& answer) {
  if (!take_diagnosis(answer)) return;
  const std::uint8_t holder = view_.diagnosis[3];
  if (holder != kNoMaster && holder != master_) {
    view_.reason = fmt::format("held by master {}", holder);
    return;
  }
  if (ident_of(view_.diagnosis) != parameters_.ident) {
    view_.reason = fmt::format("ident is 0x{:04X}, expected 0x{:04X}", ident_of(view_.diagnosis), parameters_.ident);
    return;
  }
  go(personality_ == Personality::kClassic ? SlaveState::kClear : SlaveState::kSetPrm);
}

void SlaveHandler::prm_answer(const FdlResult& result) {
  if (!result.short_acknowledge()) {
    refused(result.answer);
    return restart("Set_Prm not acknowledged");
  }
  ++view_.counters.parameterisations;
  go(SlaveState::kChkCfg);
}

void SlaveHandler::cfg_answer(const FdlResult& result) {
  // A slave whose user still judges the parameters refuses Chk_Cfg with RS (S7, S13): its diagnosis shows that.
  cfg_refused_ = !result.short_acknowledge();
  if (!cfg_refused_) return go(SlaveState::kAwaitReady);
  refused(result.answer);
  view_.reason = "Chk_Cfg not acknowledged";
  go(SlaveState::kAwaitReady, view_.reason);
}

std::string SlaveHandler::fault() const {
  const unsigned status_1 = view_.diagnosis[0], status_2 = view_.diagnosis[1], holder = view_.diagnosis[3];
  if ((status_1 & kPrmFault) != 0) return (status_1 & kNotSupported) != 0 ? "Prm_Fault, Not_Supported" : "Prm_Fault";
  const bool of_this_cfg = !cfg_refused_;  // else it is of an earlier one, and stands until a right one is taken (S17)
  if ((status_1 & kCfgFault) != 0 && of_this_cfg) return "Cfg_Fault";
  if ((status_1 & kNotSupported) != 0) return "Not_Supported";
  if ((status_2 & kPrmReq) != 0) return "Prm_Req";
  if (holder != kNoMaster && holder != master_) return fmt::format("held by master {}", holder);
  return {};
}

void SlaveHandler::readiness(const Telegram& answer) {
  if (!take_diagnosis(answer)) return;
  const std::string wrong = fault();
  if (!wrong.empty()) return restart(wrong);
  if (cfg_refused_) return go(SlaveState::kChkCfg);
  if ((view_.diagnosis[0] & kNotReady) == 0) {
    diagnosis_due_ = (view_.diagnosis[1] & kStatDiag) != 0;
    go(SlaveState::kDataExchange);
  }
}

void SlaveHandler::exchange_answer(const FdlResult& result) {
  const Telegram& answer = result.answer;
  if (refused(answer)) {
    if (answer.function() == fc::kRs) return restart("Data_Exchange refused with RS");
    diagnosis_due_ = true;
    return;
  }
  if (answer.data.size() != view_.inputs.size()) {
    ++view_.counters.errors;
    diagnosis_due_ = true;
    return;
  }
  take_inputs(answer);
}

void SlaveHandler::take_inputs(const Telegram& answer) {
  ++view_.counters.data_exchanges;
  // SC has no function code; DH and RDH announce a diagnosis.
  announced_ = diagnosis_due_ =
      answer.kind != TelegramKind::kSc && (answer.function() == fc::kDh || answer.function() == fc::kRdh);
  if (answer.data == view_.inputs) return;
  view_.inputs = answer.data;
  if (on_inputs) on_inputs();
}

void SlaveHandler::operating_diagnosis(const Telegram& answer) {
  if (!take_diagnosis(answer)) return;
  const std::string wrong = fault();
  if (!wrong.empty()) return restart(wrong);
  if ((view_.diagnosis[0] & kNotReady) != 0) return restart("Station_Not_Ready");
  take_alarm();
  diagnosis_due_ = (view_.diagnosis[1] & kStatDiag) != 0;  // EN 50170: fetched until the slave clears Stat_Diag
}

/// An alarm stays in the diagnosis until the slave's user changes that: it is acknowledged again only if the slave has
/// announced it again.
void SlaveHandler::take_alarm() {
  const bool announced = std::exchange(announced_, false);
  if (!parameters_.dpv1 || parameters_.alarms.enabled == 0) return;
  const std::optional<AcyclicRequest> ack = alarm_ack_for(view_.diagnosis);
  const Bytes before = std::exchange(alarm_, ack ? pdu_of(*ack) : Bytes());
  if (ack && (announced || alarm_ != before) && on_alarm) on_alarm(*ack);
}

}  // namespace dsdpv1::bus
