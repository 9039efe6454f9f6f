// MSAC_C2 of a class-2 master: the effect of the slave's answers on a connection.
#include <fmt/format.h>

#include <string>
#include <utility>

#include "bus/master/master2_connection.hpp"

namespace dsdpv1::bus {

namespace {

constexpr std::size_t kAbortSize = 3;      // 58, subnet, instance and reason; some slaves send a detail
constexpr std::size_t kImmediateSize = 4;  // 56, SAP, Send_Timeout
constexpr std::size_t kInitiateSize = 8;   // 57 and its fixed part, followed by Add_Addr
constexpr std::size_t kNegativeSize = 4;   // fn, Error_Decode, Error_Code_1, Error_Code_2
constexpr std::uint8_t kLastChannelSap = 0x30;
constexpr std::uint8_t kInitiateError = function_num::kInitiate | function_num::kError;

bool is(const Bytes& pdu, std::uint8_t function, std::size_t least) {
  return pdu.size() >= least && pdu[0] == function;
}

/// Whether a PDU is an existing service, so that only its time was wrong.
bool is_known(const Bytes& pdu) { return !pdu.empty() && std::string(function_name(pdu[0])) != "unknown function"; }

std::string abort_words(const char* by, const ConnectionEnd& end, bool detail = true) {
  const std::string words =
      fmt::format("{}: {}, {}", by, abort_reason_words(end.instance_and_reason), subnet_words(end.subnet));
  return detail ? words + fmt::format(", detail {}", end.detail) : words;
}

ConnectionEnd ended(ConnectionEnd::By by, std::string words) {
  ConnectionEnd end;
  end.by = by;
  end.words = std::move(words);
  return end;
}

}  // namespace

void Connection::go(ConnectionState state) {
  if (state_ == state) return;
  const ConnectionState from = std::exchange(state_, state);
  if (parameters_.silent_from == state) behaviour_ = Behaviour::kSilent;
  if (on_state) on_state(from, state);
}

// --- ends ------------------------------------------------------------------------------------------------------------

void Connection::end(Tick now, const ConnectionEnd& how) {
  std::deque<AcyclicOperation> lost = std::exchange(operations_, {});
  at_work_ = idle_at_work_ = false;
  go(ConnectionState::kClosed);
  for (AcyclicOperation& operation : lost) {
    operation.result.reason = how.words;
    operation.finish(now, AcyclicOutcome::kLost);
  }
  if (on_end) on_end(how);
}

void Connection::end_aborted(Tick now) {
  ConnectionEnd how = ended(ConnectionEnd::By::kMaster, {});
  how.subnet = abort_.subnet;
  how.instance_and_reason = abort_.code();
  how.detail = abort_.detail;
  how.words = abort_words(abort_words_, how);
  end(now, how);
}

void Connection::aborted_by_slave(Tick now, const Bytes& pdu) {
  ConnectionEnd how = ended(ConnectionEnd::By::kSlaveAbort, {});
  how.subnet = pdu[1];
  how.instance_and_reason = pdu[2];
  const bool detail = pdu.size() > kAbortSize;
  how.detail = detail ? pdu[kAbortSize] : std::uint8_t{0};
  how.words = abort_words("aborted by the slave", how, detail);
  end(now, how);
}

void Connection::abort_for(Tick now, std::uint8_t reason, const char* words) {
  abort_ = {};
  abort_.instance = abort_instance::kMsac2;
  abort_.reason = reason;
  abort_words_ = words;
  if (!granted_.sap) return end_aborted(now);
  go(ConnectionState::kAborting);
  if (at_work_)
    finish_operation(now, reason == abort_reason::kTimeout ? AcyclicOutcome::kTimeout : AcyclicOutcome::kWrongAnswer);
}

void Connection::wrong_answer(Tick now, const Bytes& pdu, std::uint8_t expected) {
  const bool sequence = is_known(pdu) && (pdu[0] & ~function_num::kError) != expected;
  abort_for(now, sequence ? abort_reason::kSequence : abort_reason::kResponse,
            sequence ? "aborted by the master, the answer belongs to another service"
                     : "aborted by the master, wrong answer");
}

void Connection::stop(Tick now) {
  if (state_ != ConnectionState::kClosed) end(now, ended(ConnectionEnd::By::kStopped, "the master was stopped"));
}

void Connection::finish_operation(Tick now, AcyclicOutcome outcome) {
  AcyclicOperation operation = std::move(operations_.front());
  operations_.pop_front();
  at_work_ = false;
  operation.finish(now, outcome);
}

// --- answers ---------------------------------------------------------------------------------------------------------

void Connection::done(Tick now, const FdlResult& result) {
  if (result.outcome == FdlOutcome::kAborted) return;
  if (asked_ == Asked::kRaw) return raw_done(now, result);
  if (state_ != asked_in_) return;  // the user has aborted or stopped it meanwhile
  if (asked_ == Asked::kAbort) return end_aborted(now);
  if (!result.answered()) return end(now, ended(ConnectionEnd::By::kNoAnswer, "the slave does not answer"));
  if (const auto refusal = refusal_of(result.answer)) return refused(now, *refusal);
  if (result.short_acknowledge()) return acknowledged(now);
  answered(now, result.answer.data);
}

void Connection::raw_done(Tick now, const FdlResult& result) {
  const RawAcyclic raw = std::move(raw_.front());
  raw_.pop_front();
  const bool channel = granted_.sap && result.request.dsap == granted_.sap;
  if (raw.done) raw.done(result);
  if (channel && result.answered() && is(result.answer.data, function_num::kAbort, kAbortSize))
    aborted_by_slave(now, result.answer.data);
}

void Connection::refused(Tick now, std::uint8_t refusal) {
  if (state_ == ConnectionState::kInitiating)
    return end(now, ended(ConnectionEnd::By::kRefused, "Initiate refused by the data link layer, no free channel"));
  if (refusal != fc::kRr)
    return end(now, ended(ConnectionEnd::By::kNoChannel, "the slave does not know the channel any more"));
  last_answer_ = now;  // RR to Idle: another request is open there
  if (asked_ != Asked::kRequest) return;
  current().refusal = refusal;
  finish_operation(now, AcyclicOutcome::kRefused);
}

void Connection::acknowledged(Tick now) {
  switch (asked_) {
    case Asked::kInitiate:
      acknowledged_initiate_ = true;
      waiting_from_ = now;
      return;
    case Asked::kRequest:
    case Asked::kIdle:
      idle_at_work_ = asked_ == Asked::kIdle;
      if (at_work_) current().sent_at = now;
      waiting_from_ = now;
      return go(ConnectionState::kBusy);
    default:
      if (at_work_) ++current().polls;
  }
}

void Connection::answered(Tick now, const Bytes& pdu) {
  if (is(pdu, function_num::kAbort, kAbortSize)) return aborted_by_slave(now, pdu);
  switch (state_) {
    case ConnectionState::kInitiating: return immediate_answer(now, pdu);
    case ConnectionState::kConnecting: return initiate_answer(now, pdu);
    case ConnectionState::kBusy: return service_answer(now, pdu);
    default: break;
  }
  if (asked_ == Asked::kPoll) return wrong_answer(now, pdu, 0);  // nothing was requested
  acknowledged(now);
  service_answer(now, pdu);
}

void Connection::immediate_answer(Tick now, const Bytes& pdu) {
  if (is(pdu, kInitiateError, kNegativeSize)) return initiate_refused(now, pdu);
  if (!is(pdu, function_num::kImmediate, kImmediateSize) || pdu[1] > kLastChannelSap)
    return wrong_answer(now, pdu, function_num::kImmediate);
  granted_.sap = pdu[1];
  granted_.send_timeout = static_cast<std::uint16_t>((pdu[2] << 8) | pdu[3]);
  waiting_from_ = now;
  go(ConnectionState::kConnecting);
}

void Connection::initiate_answer(Tick now, const Bytes& pdu) {
  if (is(pdu, kInitiateError, kNegativeSize)) return initiate_refused(now, pdu);
  if (!is(pdu, function_num::kInitiate, kInitiateSize)) return wrong_answer(now, pdu, function_num::kInitiate);
  granted_.max_length = pdu[1];
  granted_.initiate_answer = pdu;
  last_answer_ = now;
  go(ConnectionState::kOpen);
}

void Connection::initiate_refused(Tick now, const Bytes& pdu) {
  ConnectionEnd how = ended(ConnectionEnd::By::kRefused, {});
  how.error_decode = pdu[1];
  how.error_code_1 = pdu[2];
  how.error_code_2 = pdu[3];
  how.words = "Initiate refused, " + error_words(pdu[1], pdu[2], pdu[3]);
  end(now, how);
}

void Connection::service_answer(Tick now, const Bytes& pdu) {
  if (idle_at_work_) {
    if (!is(pdu, function_num::kIdle, 1)) return wrong_answer(now, pdu, function_num::kIdle);
  } else {
    judge_answer(pdu, current());
    if (current().outcome == AcyclicOutcome::kWrongAnswer) return wrong_answer(now, pdu, current().request.function);
  }
  last_answer_ = now;
  const bool idle = std::exchange(idle_at_work_, false);
  go(ConnectionState::kOpen);
  if (!idle && at_work_) finish_operation(now, current().outcome);
}

}  // namespace dsdpv1::bus
