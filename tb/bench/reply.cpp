#include "tb/bench/reply.hpp"

#include <utility>

namespace dsdpv1::tb {

Reply reply_of(const bus::AcyclicResult& result) {
  const bool negative = result.outcome == bus::AcyclicOutcome::kNegative;
  const bus::Bytes codes = {result.error_decode, result.error_code_1, result.error_code_2};
  return {negative || result.positive(), negative ? codes : result.data, result.outcome};
}

const char* service_word(scenario::ActionKind service) {
  switch (service) {
    case scenario::ActionKind::kReadInputs: return "read_inputs";
    case scenario::ActionKind::kReadOutputs: return "read_outputs";
    case scenario::ActionKind::kGetCfg: return "get_cfg";
    case scenario::ActionKind::kSlaveDiag: return "slave_diag";
    case scenario::ActionKind::kC1Read: return "c1_read";
    case scenario::ActionKind::kC1Write: return "c1_write";
    case scenario::ActionKind::kC2Read: return "c2_read";
    case scenario::ActionKind::kC2Write: return "c2_write";
    case scenario::ActionKind::kC2Transport: return "c2_transport";
    default: return "set_slave_address";
  }
}

void Replies::keep(const std::string& asker, scenario::ActionKind service, Reply reply) {
  const Reply& kept = replies_[asker][service] = std::move(reply);
  if (on_change) on_change(asker, service, kept);
}

const Reply* Replies::last(const std::string& asker, scenario::ActionKind service) const {
  const auto replies = replies_.find(asker);
  if (replies == replies_.end()) return nullptr;
  const auto reply = replies->second.find(service);
  return reply == replies->second.end() ? nullptr : &reply->second;
}

}  // namespace dsdpv1::tb
