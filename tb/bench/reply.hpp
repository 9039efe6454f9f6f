#pragma once
// The results of script requests, for the condition `reply_of`.
#include <functional>
#include <map>
#include <string>

#include "bus/bytes.hpp"
#include "bus/master/acyclic.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

/// One answer to a request of the script.
struct Reply {
  bool answered = false;
  bus::Bytes data;                                           ///< for a negative acyclic answer its three error bytes
  bus::AcyclicOutcome outcome = bus::AcyclicOutcome::kLost;  ///< of acyclic services
};

/// The reply of an acyclic service.
Reply reply_of(const bus::AcyclicResult& result);

/// The word of a service with an answer: "c1_read".
const char* service_word(scenario::ActionKind service);

/// The last answer to each service requested by the script.
class Replies {
 public:
  /// `asker`: the master's name in the script, or a connection's.
  void keep(const std::string& asker, scenario::ActionKind service, Reply reply);
  /// Null without one.
  const Reply* last(const std::string& asker, scenario::ActionKind service) const;

  /// Called for each answer when it is kept.
  std::function<void(const std::string& asker, scenario::ActionKind service, const Reply& reply)> on_change;

 private:
  std::map<std::string, std::map<scenario::ActionKind, Reply>> replies_;  ///< by asker and service
};

}  // namespace dsdpv1::tb
