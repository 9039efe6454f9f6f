#pragma once
// Acyclic services of DPV1 as seen by a master (datasheet 7.2, 7.3; rulings V1, V2): requests, their PDUs and their
// results. C1 and C2 have the same PDUs for reading and writing.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "bus/bytes.hpp"
#include "bus/telegram/dpv1_words.hpp"
#include "bus/telegram/telegram.hpp"
#include "bus/time.hpp"

namespace dsdpv1::bus {

constexpr std::size_t kMaxAcyclicData = 240;  ///< bytes of data of one request or answer (7, first paragraph)
constexpr Tick kTimeUnit10ms =
    10 * kTicksPerMs;  ///< unit of Send_Timeout and of C1_Response_Timeout and C2_Response_Timeout in GSD files

struct AcyclicRequest {
  std::uint8_t function = function_num::kRead;  ///< kRead, kWrite, kTransport (C2 only), kAlarmAck (C1 only)
  std::uint8_t slot = 0, index = 0;             ///< kAlarmAck: index is Alarm_Type
  /// kRead: bytes requested; a slave refuses more than 240. kAlarmAck: Alarm_Specifier. Others: length of `data`.
  std::uint8_t length = 0;
  Bytes data = {};  ///< kWrite, kTransport: at most 240 bytes
};

AcyclicRequest read_request(std::uint8_t slot, std::uint8_t index, std::uint8_t length);
/// Throw std::invalid_argument for more than 240 bytes.
AcyclicRequest write_request(std::uint8_t slot, std::uint8_t index, const Bytes& data);
AcyclicRequest transport_request(std::uint8_t slot, std::uint8_t index, const Bytes& data);

/// `fn, slot, index, length, data`.
Bytes pdu_of(const AcyclicRequest& request);

enum class AcyclicOutcome : std::uint8_t {
  kPositive,     ///< the slave's user has answered; `data` holds the bytes read or transported
  kNegative,     ///< answered with Error_Decode, Error_Code_1 and 2
  kTimeout,      ///< acknowledged, but no answer within the response time
  kRefused,      ///< the data link layer refused: UE, RR (one is open already), RS (SAP not enabled); see `refusal`
  kNoAnswer,     ///< the station does not answer at all
  kWrongAnswer,  ///< an answer that does not fit the request
  kLost,         ///< data exchange was left, the connection ended or the master was stopped while it was open
};
/// "positive", "negative", ...
const char* name(AcyclicOutcome outcome);

struct AcyclicResult {
  AcyclicOutcome outcome = AcyclicOutcome::kLost;
  AcyclicRequest request = {};
  Bytes data = {};                                                    ///< kPositive
  std::uint8_t error_decode = 0, error_code_1 = 0, error_code_2 = 0;  ///< kNegative (tables 28, 29)
  std::uint8_t refusal = 0;  ///< kRefused: the function code of the answer, fc::kUe, kRr or kRs
  std::string reason = {};   ///< kLost, kWrongAnswer: as text
  Tick queued_at = 0, sent_at = 0,
       done_at = 0;  ///< sent_at: end of the request's acknowledgement, 0 when it was not sent
  int polls = 0;     ///< without the one that fetched the answer

  bool positive() const { return outcome == AcyclicOutcome::kPositive; }
};
/// "DS_Read slot 1 index 2: 3 bytes 01 02 03", "DS_Write slot 1 index 2 refused, access: invalid index".
std::string describe(const AcyclicResult& result);

using AcyclicCallback = std::function<void(const AcyclicResult&)>;

/// Compares an answer PDU with the request in `result`, and fills its outcome (kPositive, kNegative, kWrongAnswer),
/// data, codes and reason.
void judge_answer(const Bytes& pdu, AcyclicResult& result);

/// The refusal in an answer of the data link layer (UE, RR, RS); nullopt if it is not one.
std::optional<std::uint8_t> refusal_of(const Telegram& answer);

/// An operation that waits to be sent or answered.
struct AcyclicOperation {
  AcyclicOperation(Tick now, AcyclicRequest request, AcyclicCallback when_done);
  /// Reports the outcome to its user; the rest of `result` is already filled.
  void finish(Tick now, AcyclicOutcome outcome);

  AcyclicResult result;
  AcyclicCallback done;
};

}  // namespace dsdpv1::bus
