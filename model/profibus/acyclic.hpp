#pragma once
// Shared by C1 and C2: the PDU (tables 26 to 32), the chip's own judgement of a request (V9), the request waiting for
// the user, and the check that the user's answer fits it (V6, V14).
#include "model/profibus/dpv1_pdu.hpp"
#include "model/profibus/event_log.hpp"
#include "model/profibus/request.hpp"
#include "model/profibus/user_mail.hpp"

namespace dsdpv1::profibus {

/// True when the request comes from the SSAP of its service (table 24, V8); else the reason is logged.
bool ssap_right(Cycle now, EventLog& log, const Request& request, int expected);

/// Limits of a connection.
struct AcyclicLimits {
  int data = kMaxAcyclic;  ///< bytes of a write or transport
  bool transport = false;
};
/// The Error_Code_1 with which the chip refuses a request, or 0. `size` is at least 1.
std::uint8_t request_fault(const std::uint8_t* pdu, int size, const AcyclicLimits& limits);

/// `Function_Num, Error_Decode, Error_Code_1, Error_Code_2` for a request with this Function_Num.
void negative_answer(std::uint8_t function, std::uint8_t error_code1, Pdu& pdu);

/// True when the user's answer belongs to `request`; else the reason is logged. `area`: 1 or 2.
bool answer_fits(Cycle now, EventLog& log, int area, const std::uint8_t* answer, const Pdu& request);

}  // namespace dsdpv1::profibus
