#pragma once
// What came of a request of the script, for the condition `reply_of`.
#include "bus/bytes.hpp"
#include "bus/master/acyclic.hpp"

namespace tb {

/// One answer to a request of the script.
struct Reply {
  bool answered = false;
  bus::Bytes data;                                           ///< of a negative acyclic answer its three error bytes
  bus::AcyclicOutcome outcome = bus::AcyclicOutcome::kLost;  ///< of acyclic services
};

/// Of an acyclic service.
Reply reply_of(const bus::AcyclicResult& result);

}  // namespace tb
