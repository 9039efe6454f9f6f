#include "model/profibus/msac1.hpp"

namespace dsdpv1::profibus {
namespace {

constexpr int kArea = 1, kSap = 51;  // the master's SAP is the same, table 24

}  // namespace

Reply Msac1::handle(Cycle now, const Request& request) {
  if (!ssap_right(now, log_, request, kSap)) return Reply::status(fc::kRs);
  if (request.size == 0) return poll(now);
  const std::uint8_t function = request.data[0];
  if (state_ != State::kIdle) {
    log_.at_cycle(now, Reason::kAcyclicOpen, kSap, function);
    return Reply::status(fc::kRr);
  }
  if (function == dpv1::kAlarmAck && alarms_.on()) return alarm_ack(now, request);
  if (const std::uint8_t fault = request_fault(request.data, request.size, {capacity_, false}); fault != 0) {
    log_.at_cycle(now, Reason::kAcyclicRequestRefused, kSap, function, fault);
    negative_answer(function, fault, answer_);
    state_ = State::kAnswered;
    return Reply::sc();
  }
  log_.at_cycle(now, Reason::kC1Request, function, request.data[1], request.data[2]);
  mail_.pdu.assign(request.data, request.size);
  mail_.due.set(now);
  state_ = State::kOpen;
  return Reply::sc();
}

Reply Msac1::alarm_ack(Cycle now, const Request& request) {
  if (!alarms_.acknowledge(now, request, answer_)) return Reply::status(fc::kRr);
  state_ = State::kAnswered;
  return Reply::sc();
}

Reply Msac1::poll(Cycle now) {
  if (state_ != State::kAnswered || waits_for_user()) return Reply::sc();
  log_.at_cycle(now, Reason::kC1Answer, answer_.bytes[0], static_cast<unsigned>(answer_.size));
  state_ = State::kIdle;
  return Reply::with_data(fc::kDl, answer_.bytes.data(), answer_.size);
}

void Msac1::close(Cycle now) {
  if (state_ == State::kIdle) return;
  log_.at_cycle(now, Reason::kC1Dropped);
  mail_.due.clear();
  state_ = State::kIdle;
}

void Msac1::answer(Cycle now, const std::uint8_t* pdu, int size) {
  if (state_ != State::kOpen || mail_.due.waiting()) return log_.at_cycle(now, Reason::kAcyclicNoRequest, kArea);
  if (!answer_fits(now, log_, kArea, pdu, mail_.pdu)) return;
  answer_.assign(pdu, size);
  state_ = State::kAnswered;
}

}  // namespace dsdpv1::profibus
