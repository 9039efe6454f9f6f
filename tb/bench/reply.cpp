#include "tb/bench/reply.hpp"

#include <utility>

namespace dsdpv1::tb {

Reply reply_of(const bus::AcyclicResult& result) {
  const bool negative = result.outcome == bus::AcyclicOutcome::kNegative;
  const bus::Bytes codes = {result.error_decode, result.error_code_1, result.error_code_2};
  return {negative || result.positive(), negative ? codes : result.data, result.outcome};
}

void Replies::keep(const std::string& asker, scenario::ActionKind service, Reply reply) {
  replies_[asker][service] = std::move(reply);
  if (on_change) on_change();
}

const Reply* Replies::last(const std::string& asker, scenario::ActionKind service) const {
  const auto replies = replies_.find(asker);
  if (replies == replies_.end()) return nullptr;
  const auto reply = replies->second.find(service);
  return reply == replies->second.end() ? nullptr : &reply->second;
}

}  // namespace dsdpv1::tb
