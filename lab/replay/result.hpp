#pragma once
// The result of a replay: each request to the slave with both answers.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lab/replay/recording.hpp"

namespace dsdpv1::tb::replay {

enum class Verdict : std::uint8_t {
  kEqual,
  kBothSilent,
  // Differences.
  kMissing,     ///< only the recorded slave answered
  kUnexpected,  ///< only the model answered
  kBytes,       ///< other bytes
  kTsdr,        ///< the same bytes at another time
  // Not compared.
  kBeforeFirstAnswer,  ///< the recorded slave was not active yet
  kNotParameterised,   ///< the capture begins in the middle of a data exchange
  kNoRate,             ///< the model searched its baud rate
  kDisturbed,          ///< it collided with an answer that only the model gave
  kCaptureEnds,        ///< before the slave could answer
  kBeforeWindow,
  kUserLate,  ///< the user CPU had not yet delivered the inputs or the diagnosis, or judged at another time
  kUserDpv1,  ///< DPV1: the user CPU answered at another poll, or refused for another reason
  kRestart,   ///< the slave had left data exchange without a reason on the line, and is not in it again
  kOldFault,  ///< only fault bits differ, from a Set_Prm or Chk_Cfg before the capture
};
constexpr std::size_t kVerdicts = 16;

/// "equal", "both silent", "missing" ...
const char* name(Verdict verdict);
bool is_difference(Verdict verdict);
bool is_compared(Verdict verdict);

/// An answer of either side.
struct Answer {
  Tick start = 0, tsdr = 0;
  int baud = 0;  ///< of the request
  bool right = false;
  bus::Bytes bytes;

  double tsdr_bits() const;
};

struct RequestResult {
  std::size_t telegram = 0;  ///< of the capture, from 0
  Tick start = 0;            ///< time of the capture
  bus::Bytes request;
  std::string service;
  std::optional<Answer> recorded, model;
  Verdict verdict = Verdict::kEqual;
  std::string why;  ///< the reason of a difference, in words
};

/// Comparison of the TSDR of a pair of answers.
struct TsdrRule {
  std::optional<double> tolerance_bits = {};  ///< absent: both have to be from min_TSDR to max_TSDR
};

struct Result {
  std::string capture, form;  ///< `form`: "telegrams", "levels of line"
  std::uint8_t slave = 0;
  std::vector<int> bauds;  ///< in the order of time
  Tick resolution = 1;
  std::size_t telegrams = 0, left_out = 0;
  Tick begin = 0, end = 0;  ///< of the capture
  Tick lead_in = 0;         ///< time before it, for the model to find the rate
  std::string station;      ///< initialisation of the model
  bool started = false;     ///< the lead-in has brought the model into data exchange
  bool inputs_recorded = false;
  bool diagnoses_recorded = false;  ///< with inputs_recorded; false: the model's user CPU hands over none
  TsdrRule rule;
  std::vector<RequestResult> requests;
  /// Telegrams of the model without a request, times of the capture.
  std::vector<Answer> unasked;
  bool interrupted = false;

  /// Null without a difference.
  const RequestResult* first_difference() const;
  std::size_t count(Verdict verdict) const;
  std::size_t compared() const;
  /// Answers were compared, and no difference was found.
  bool equal() const { return compared() != 0 && first_difference() == nullptr && unasked.empty(); }
};

}  // namespace dsdpv1::tb::replay
