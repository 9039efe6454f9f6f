#include "model/profibus/acyclic.hpp"

namespace dsdpv1::profibus {

bool ssap_right(Cycle now, EventLog& log, const Request& request, int expected) {
  if (request.ssap == expected) return true;
  log.at_cycle(now, Reason::kAcyclicSsap, static_cast<unsigned>(request.dsap), static_cast<unsigned>(request.ssap),
               static_cast<unsigned>(expected));
  return false;
}

std::uint8_t request_fault(const std::uint8_t* pdu, int size, const AcyclicLimits& limits) {
  const std::uint8_t function = pdu[0];
  const bool read = function == dpv1::kRead;
  const bool write = function == dpv1::kWrite || (limits.transport && function == dpv1::kTransport);
  if (!read && !write) return dpv1::kNotSupported;
  if (read) return size == dpv1::kHeader ? std::uint8_t{0} : dpv1::kInvalidParameter;
  const bool fits = size >= dpv1::kHeader && size == dpv1::kHeader + pdu[3] && pdu[3] <= limits.data;
  return fits ? std::uint8_t{0} : dpv1::kWriteLength;
}

void negative_answer(std::uint8_t function, std::uint8_t error_code1, Pdu& pdu) {
  const std::uint8_t bytes[dpv1::kHeader] = {static_cast<std::uint8_t>(function | dpv1::kNegative), dpv1::kErrorDecode,
                                             error_code1, 0};
  pdu.assign(bytes, dpv1::kHeader);
}

bool answer_fits(Cycle now, EventLog& log, int area, const std::uint8_t* answer, const Pdu& request) {
  const bool negative = (answer[0] & dpv1::kNegative) != 0;
  const int compared = negative ? 1 : 3;  // an error's other bytes are codes
  for (int i = 0; i < compared; ++i) {
    const unsigned expected = request.bytes[static_cast<std::size_t>(i)];
    const unsigned found = i == 0 ? answer[0] & ~unsigned{dpv1::kNegative} : answer[i];
    if (found == expected) continue;
    log.at_cycle(now, Reason::kAcyclicAnswerDiffers, static_cast<unsigned>(area << 8 | i), found, expected);
    return false;
  }
  return true;
}

}  // namespace dsdpv1::profibus
