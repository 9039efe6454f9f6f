#include "bus/master/acyclic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "bus/telegram/dpv1_words.hpp"

namespace dsdpv1::bus {

namespace {

constexpr std::size_t kHeader = 4;  // fn, slot, index, length; in a negative answer fn and three codes

AcyclicRequest with_data(std::uint8_t function, std::uint8_t slot, std::uint8_t index, const Bytes& data) {
  if (data.size() > kMaxAcyclicData)
    throw std::invalid_argument(fmt::format("{} bytes of acyclic data, at most 240", data.size()));
  return {function, slot, index, static_cast<std::uint8_t>(data.size()), data};
}

void wrong(AcyclicResult& result, std::string reason) {
  result.outcome = AcyclicOutcome::kWrongAnswer;
  result.reason = std::move(reason);
}

void take_error(const Bytes& pdu, AcyclicResult& result) {
  result.outcome = AcyclicOutcome::kNegative;
  result.error_decode = pdu[1];
  result.error_code_1 = pdu[2];
  result.error_code_2 = pdu[3];
}

void take_positive(const Bytes& pdu, AcyclicResult& result) {
  const AcyclicRequest& request = result.request;
  if (pdu[1] != request.slot || pdu[2] != request.index) {
    return wrong(result, fmt::format("answer for slot {} index {}, asked was slot {} index {}", pdu[1], pdu[2],
                                     request.slot, request.index));
  }
  const bool repeats = request.function == function_num::kWrite || request.function == function_num::kAlarmAck;
  const std::size_t expected = repeats ? 0 : pdu[3];
  if (pdu.size() - kHeader != expected)
    return wrong(result, fmt::format("{} data bytes, the length byte says {}", pdu.size() - kHeader, expected));
  if (repeats && pdu[3] != request.length) {
    return wrong(result, request.function == function_num::kWrite
                             ? fmt::format("{} bytes acknowledged, written were {}", pdu[3], request.length)
                             : fmt::format("Alarm_Specifier 0x{:02X}, sent was 0x{:02X}", pdu[3], request.length));
  }
  result.outcome = AcyclicOutcome::kPositive;
  result.data.assign(pdu.begin() + kHeader, pdu.end());
}

std::string bytes_words(const Bytes& data) {
  std::string text = fmt::format("{} bytes", data.size());
  for (const std::uint8_t byte : data) text += fmt::format(" {:02X}", byte);
  return text;
}

std::string positive_words(const AcyclicResult& result) {
  switch (result.request.function) {
    case function_num::kWrite: return fmt::format("{} bytes written", result.request.length);
    case function_num::kAlarmAck: return "acknowledged";
    default: return bytes_words(result.data);
  }
}

std::string subject(const AcyclicRequest& request) {
  if (request.function == function_num::kAlarmAck)
    return fmt::format("slot {} type {} sequence number {}", request.slot, request.index, request.length >> 3);
  return fmt::format("slot {} index {}", request.slot, request.index);
}

std::string outcome_words(const AcyclicResult& result) {
  switch (result.outcome) {
    case AcyclicOutcome::kPositive: return positive_words(result);
    case AcyclicOutcome::kNegative:
      return "refused, " + error_words(result.error_decode, result.error_code_1, result.error_code_2);
    case AcyclicOutcome::kRefused:
      return fmt::format("refused with {}", result.refusal == fc::kRs ? "RS" : result.refusal == fc::kRr ? "RR" : "UE");
    case AcyclicOutcome::kTimeout: return fmt::format("no answer in time, {} polls", result.polls);
    default: return result.reason.empty() ? name(result.outcome) : result.reason;
  }
}

}  // namespace

AcyclicRequest read_request(std::uint8_t slot, std::uint8_t index, std::uint8_t length) {
  return {function_num::kRead, slot, index, length, {}};
}

AcyclicRequest write_request(std::uint8_t slot, std::uint8_t index, const Bytes& data) {
  return with_data(function_num::kWrite, slot, index, data);
}

AcyclicRequest transport_request(std::uint8_t slot, std::uint8_t index, const Bytes& data) {
  return with_data(function_num::kTransport, slot, index, data);
}

Bytes pdu_of(const AcyclicRequest& request) {
  Bytes pdu(request.data.size() + kHeader);
  std::uint8_t* to = pdu.data();
  for (const std::uint8_t byte : {request.function, request.slot, request.index, request.length}) *to++ = byte;
  std::copy(request.data.begin(), request.data.end(), to);
  return pdu;
}

const char* name(AcyclicOutcome outcome) {
  switch (outcome) {
    case AcyclicOutcome::kPositive: return "positive";
    case AcyclicOutcome::kNegative: return "negative";
    case AcyclicOutcome::kTimeout: return "timeout";
    case AcyclicOutcome::kRefused: return "refused";
    case AcyclicOutcome::kNoAnswer: return "no answer";
    case AcyclicOutcome::kWrongAnswer: return "wrong answer";
    case AcyclicOutcome::kLost: return "lost";
  }
  return "";
}

std::string describe(const AcyclicResult& result) {
  const AcyclicRequest& request = result.request;
  return fmt::format("{} {}: {}", function_name(request.function), subject(request), outcome_words(result));
}

void judge_answer(const Bytes& pdu, AcyclicResult& result) {
  if (pdu.size() < kHeader) return wrong(result, fmt::format("answer of {} bytes, at least 4 are right", pdu.size()));
  const std::uint8_t asked = result.request.function;
  if (pdu[0] == (asked | function_num::kError)) return take_error(pdu, result);
  if (pdu[0] != asked)
    return wrong(result, fmt::format("answer with Function_Num 0x{:02X}, asked was 0x{:02X}", pdu[0], asked));
  take_positive(pdu, result);
}

AcyclicOperation::AcyclicOperation(Tick now, AcyclicRequest request, AcyclicCallback when_done)
    : done(std::move(when_done)) {
  result.request = std::move(request);
  result.queued_at = now;
}

void AcyclicOperation::finish(Tick now, AcyclicOutcome outcome) {
  result.outcome = outcome;
  result.done_at = now;
  if (done) done(result);
}

std::optional<std::uint8_t> refusal_of(const Telegram& answer) {
  const std::uint8_t function = answer.function();
  if (answer.kind == TelegramKind::kSc || (function != fc::kUe && function != fc::kRr && function != fc::kRs))
    return std::nullopt;
  return function;
}

}  // namespace dsdpv1::bus
