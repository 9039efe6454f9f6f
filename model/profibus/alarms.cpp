#include "model/profibus/alarms.hpp"

#include <algorithm>
#include <iterator>

#include "model/profibus/alarm_reasons.hpp"

namespace dsdpv1::profibus {

const ReasonRow detail::kAlarmReasonRows[] = {
#define X(id, severity, ...) {Severity::severity, __VA_ARGS__},
#include "model/profibus/alarm_reasons.inc"
#undef X
};

ReasonTable alarm_reasons() { return {detail::kAlarmReasonRows, std::size(detail::kAlarmReasonRows)}; }

namespace {

constexpr int kAlarmSap = 50, kAlarmMasterSap = 51;  // table 24
constexpr std::uint8_t kDpv1On = 0x80, kStatusBlock = 0x80;
constexpr int kBlockHead = 4, kDpv1Bytes = 3;

/// The bit of DPV1_Status_2 that enables a type, 0: there is no such type.
std::uint8_t enabling_bit(unsigned type) {
  switch (type) {
    case 1: return 0x20;  // diagnostic
    case 2: return 0x40;  // process
    case 3:
    case 4: return 0x80;                                      // pull, plug
    case 5: return 0x08;                                      // status
    case 6: return 0x04;                                      // update
    default: return type >= 32 && type <= 126 ? 0x10 : 0x00;  // manufacturer specific
  }
}

bool is_alarm_block(const std::uint8_t* block, int size) {
  return size >= kBlockHead && block[0] >= kBlockHead && block[0] <= std::min(size, 0x3F) &&
         (block[1] & kStatusBlock) == 0 && enabling_bit(block[1]) != 0 && block[2] <= 254;
}

/// AL4: the number of alarms that Alarm_Mode 1 to 7 allow in all.
constexpr int kAllowed[] = {0, 2, 4, 8, 12, 16, 24, 32};

}  // namespace

void Alarms::reset() {
  enabled_ = 0;
  mode_ = open_ = 0;
  mail_ = {};
  answered_ = false;
}

void Alarms::ask(const std::uint8_t* spec, int size) {
  const bool dpv1 = size >= kDpv1Bytes && (spec[0] & kDpv1On) != 0;
  enabled_ = dpv1 ? spec[1] : std::uint8_t{0};
  mode_ = dpv1 ? spec[2] & 0x07 : 0;
}

void Alarms::close(Cycle now) {
  if (open_ > 0) log_.at_cycle(now, AlarmReason::kAlarmsDropped, static_cast<unsigned>(open_));
  open_ = 0;
  mail_.due.clear();
  answered_ = false;
}

bool Alarms::enabled(const Alarm& alarm) const { return (enabled_ & enabling_bit(alarm.type)) != 0; }

Alarm* Alarms::find(const Alarm& alarm) {
  Alarm* const end = alarms_.data() + open_;
  Alarm* const found = std::find_if(alarms_.data(), end, [&](const Alarm& each) { return each.is(alarm); });
  return found == end ? nullptr : found;
}

bool Alarms::room(const Alarm& alarm) const {
  if (open_ >= most_) return false;
  const auto others = [&](const Alarm& each) {
    return each.type == alarm.type && (mode_ == 0 || each.sequence() == alarm.sequence());
  };
  return (mode_ == 0 || open_ < kAllowed[mode_]) && std::none_of(alarms_.begin(), alarms_.begin() + open_, others);
}

bool Alarms::raise(Cycle now, const std::uint8_t* block, int size, int max_diag) {
  if (!is_alarm_block(block, size) || size > max_diag) {
    const unsigned head = size >= 2 ? static_cast<unsigned>(block[0]) << 8 | block[1] : 0;
    log_.at_cycle(now, AlarmReason::kAlarmBlock, static_cast<unsigned>(size), head, static_cast<unsigned>(max_diag));
    return false;
  }
  const Alarm alarm{block[2], block[1], block[3]};
  if (!enabled(alarm)) {
    log_.at_cycle(now, AlarmReason::kAlarmDisabled, alarm.type, enabled_);
    return false;
  }
  if (!room(alarm)) {
    log_.at_cycle(now, AlarmReason::kAlarmLimit, alarm.type, static_cast<unsigned>(open_),
                  static_cast<unsigned>(mode_));
    return false;
  }
  log_.at_cycle(now, AlarmReason::kAlarmRaised, alarm.type, alarm.slot, alarm.sequence());
  alarms_[static_cast<std::size_t>(open_++)] = alarm;
  return true;
}

Reply Alarms::handle(Cycle now, const Request& request) {
  if (!ssap_right(now, log_, request, kAlarmMasterSap)) return Reply::status(fc::kRs);
  if (request.size == 0) {
    if (!answered_ || waits_for_user()) return Reply::sc();
    answered_ = false;
    return Reply::with_data(fc::kDl, answer_.bytes.data(), answer_.size);
  }
  const std::uint8_t function = request.data[0];
  if (answered_) {
    log_.at_cycle(now, Reason::kAcyclicOpen, kAlarmSap, function);
    return Reply::status(fc::kRr);
  }
  if (function != dpv1::kAlarmAck) {
    log_.at_cycle(now, Reason::kAcyclicRequestRefused, kAlarmSap, function, dpv1::kNotSupported);
    negative_answer(function, dpv1::kNotSupported, answer_);
  } else if (!acknowledge(now, request, answer_)) {
    return Reply::status(fc::kRr);
  }
  answered_ = true;
  return Reply::sc();
}

bool Alarms::acknowledge(Cycle now, const Request& request, Pdu& answer) {
  if (with_user()) {
    log_.at_cycle(now, Reason::kAcyclicOpen, static_cast<unsigned>(request.dsap), dpv1::kAlarmAck);
    return false;
  }
  if (request.size != dpv1::kHeader) {
    log_.at_cycle(now, Reason::kAcyclicRequestRefused, static_cast<unsigned>(request.dsap), dpv1::kAlarmAck,
                  dpv1::kInvalidParameter);
    negative_answer(dpv1::kAlarmAck, dpv1::kInvalidParameter, answer);
    return true;
  }
  const Alarm alarm{request.data[1], request.data[2], request.data[3]};
  Alarm* const found = find(alarm);
  if (found == nullptr) {
    log_.at_cycle(now, AlarmReason::kAlarmAckWrong, alarm.type, alarm.slot, alarm.sequence());
    negative_answer(dpv1::kAlarmAck, dpv1::kStateConflict, answer);
    return true;
  }
  log_.at_cycle(now, AlarmReason::kAlarmAck, alarm.type, alarm.slot, alarm.sequence());
  std::copy(found + 1, alarms_.data() + open_, found);
  --open_;
  mail_.alarm = alarm;
  mail_.due.set(now);
  answer.assign(request.data, request.size);
  return true;
}

}  // namespace dsdpv1::profibus
