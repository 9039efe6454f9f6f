#include "tb/bench/reply.hpp"

namespace tb {

Reply reply_of(const bus::AcyclicResult& result) {
  const bool negative = result.outcome == bus::AcyclicOutcome::kNegative;
  const bus::Bytes codes = {result.error_decode, result.error_code_1, result.error_code_2};
  return {negative || result.positive(), negative ? codes : result.data, result.outcome};
}

}  // namespace tb
