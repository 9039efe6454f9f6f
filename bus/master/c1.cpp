#include "bus/master/c1.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace dsdpv1::bus {

void C1Client::push(Tick now, AcyclicRequest request, AcyclicCallback done) {
  operations_.emplace_back(now, std::move(request), std::move(done));
}

bool C1Client::due(Tick now) {
  if (acknowledged_ && now - current().sent_at >= response_timeout_) {
    stale_ = true;
    finish(now, AcyclicOutcome::kTimeout);
  }
  return !operations_.empty();
}

Telegram C1Client::next_request() {
  polling_ = acknowledged_ || stale_;
  at_work_ = at_work_ || !polling_;
  return make_telegram(slave_, master_, fc::kRequest | fc::kSrdLow, polling_ ? Bytes{} : pdu_of(current().request),
                       sap_, sap::kMs1);
}

void C1Client::done(Tick now, const FdlResult& result) {
  if (operations_.empty() || result.outcome == FdlOutcome::kAborted) return;
  if (!result.answered()) {
    stale_ = stale_ || acknowledged_;
    return finish(now, AcyclicOutcome::kNoAnswer);
  }
  if (polling_) return polled(now, result.answer);
  requested(now, result);
}

void C1Client::requested(Tick now, const FdlResult& result) {
  if (const auto refusal = refusal_of(result.answer)) {
    current().refusal = *refusal;
    // RR: the slave still holds the answer to an earlier request, abandoned by this master.
    stale_ = *refusal == fc::kRr;
    return finish(now, AcyclicOutcome::kRefused);
  }
  current().sent_at = result.answer_end;
  acknowledged_ = true;
  if (!result.short_acknowledge()) polled(now, result.answer);  // some slaves answer at once
}

void C1Client::polled(Tick now, const Telegram& answer) {
  if (!acknowledged_) {  // fetched the answer to an earlier request; if there was none, the next request will show it
    stale_ = false;
    return;
  }
  if (answer.kind == TelegramKind::kSc) {
    ++current().polls;
    return;
  }
  if (const auto refusal = refusal_of(answer)) {
    current().refusal = *refusal;
    return finish(now, AcyclicOutcome::kRefused);
  }
  judge_answer(answer.data, current());
  finish(now, current().outcome);
}

void C1Client::leave(Tick now, const std::string& reason) {
  stale_ = false;
  if (at_work_) {
    current().reason = reason;
    finish(now, AcyclicOutcome::kLost);
  }
  drop_acknowledgements(now, reason);
}

/// Leaving data exchange ends the alarms, too (AL8).
void C1Client::drop_acknowledgements(Tick now, const std::string& reason) {
  const auto stays = [](const AcyclicOperation& each) {
    return each.result.request.function != function_num::kAlarmAck;
  };
  const auto first = std::stable_partition(operations_.begin(), operations_.end(), stays);
  std::vector<AcyclicOperation> dropped(std::make_move_iterator(first), std::make_move_iterator(operations_.end()));
  operations_.erase(first, operations_.end());
  for (AcyclicOperation& each : dropped) {
    each.result.reason = reason;
    each.finish(now, AcyclicOutcome::kLost);
  }
}

void C1Client::finish(Tick now, AcyclicOutcome outcome) {
  AcyclicOperation operation = std::move(operations_.front());
  operations_.pop_front();
  at_work_ = acknowledged_ = false;
  operation.finish(now, outcome);
}

}  // namespace dsdpv1::bus
