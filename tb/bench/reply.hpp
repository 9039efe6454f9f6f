#pragma once
// What came of a request of the script, for the condition `reply_of`.
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
  bus::Bytes data;                                           ///< of a negative acyclic answer its three error bytes
  bus::AcyclicOutcome outcome = bus::AcyclicOutcome::kLost;  ///< of acyclic services
};

/// Of an acyclic service.
Reply reply_of(const bus::AcyclicResult& result);

/// The word of a service that is answered: "c1_read".
const char* service_word(scenario::ActionKind service);

/// The last answer to each service that the script asked for.
class Replies {
 public:
  /// `asker`: the master's name as the script gives it, or a connection's.
  void keep(const std::string& asker, scenario::ActionKind service, Reply reply);
  /// Null when there is none.
  const Reply* last(const std::string& asker, scenario::ActionKind service) const;

  /// Told of each answer when it is kept.
  std::function<void(const std::string& asker, scenario::ActionKind service, const Reply& reply)> on_change;

 private:
  std::map<std::string, std::map<scenario::ActionKind, Reply>> replies_;  ///< by asker and service
};

}  // namespace dsdpv1::tb
