#include "lab/replay/result.hpp"

#include <algorithm>

#include "bus/baud.hpp"

namespace dsdpv1::tb::replay {

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kEqual: return "equal";
    case Verdict::kBothSilent: return "both silent";
    case Verdict::kMissing: return "missing";
    case Verdict::kUnexpected: return "unexpected";
    case Verdict::kBytes: return "other bytes";
    case Verdict::kTsdr: return "other TSDR";
    case Verdict::kBeforeFirstAnswer: return "before the recorded slave answered";
    case Verdict::kNotParameterised: return "before the slave is parameterised";
    case Verdict::kNoRate: return "before the model has the baud rate";
    case Verdict::kDisturbed: return "disturbed by an answer that only the model gave";
    case Verdict::kCaptureEnds: return "at the end of the capture";
    case Verdict::kBeforeWindow: return "before --from";
    case Verdict::kUserLate: return "the user CPU was not as quick";
    case Verdict::kUserDpv1: return "DPV1, the user CPU's own";
    case Verdict::kRestart: return "the recorded slave had left data exchange";
    case Verdict::kOldFault: return "faults from before the capture";
  }
  return "";
}

bool is_difference(Verdict verdict) { return verdict >= Verdict::kMissing && verdict <= Verdict::kTsdr; }

bool is_compared(Verdict verdict) { return verdict <= Verdict::kTsdr; }

double Answer::tsdr_bits() const { return static_cast<double>(tsdr) / static_cast<double>(bus::baud(baud).bit); }

const RequestResult* Result::first_difference() const {
  const auto found = std::find_if(requests.begin(), requests.end(),
                                  [](const RequestResult& each) { return is_difference(each.verdict); });
  return found == requests.end() ? nullptr : &*found;
}

std::size_t Result::count(Verdict verdict) const {
  return static_cast<std::size_t>(std::count_if(
      requests.begin(), requests.end(), [verdict](const RequestResult& each) { return each.verdict == verdict; }));
}

std::size_t Result::compared() const {
  return static_cast<std::size_t>(std::count_if(
      requests.begin(), requests.end(), [](const RequestResult& each) { return is_compared(each.verdict); }));
}

}  // namespace dsdpv1::tb::replay
