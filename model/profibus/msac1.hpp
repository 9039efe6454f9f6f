#pragma once
// MSAC_C1: DS_Read and DS_Write of the parameterising master on SAP 51 (7.2; rulings V1, V8, V9, V14), and Alarm_Ack.
#include "model/profibus/alarms.hpp"

namespace dsdpv1::profibus {

class Msac1 {
 public:
  Msac1(EventLog& log, int capacity, AcyclicMail& mail, Alarms& alarms)
      : log_(log), capacity_(capacity), mail_(mail), alarms_(alarms) {}

  void reset() { state_ = State::kIdle; }
  /// SAP 51: a request or a poll of the master entitled to it. The reply's data are valid until the next call.
  Reply handle(Cycle now, const Request& request);
  /// Data exchange was left: withdraws an open request.
  void close(Cycle now);
  /// The user's answer, CRC already found right. Refused with a reason when it does not fit (V14).
  void answer(Cycle now, const std::uint8_t* pdu, int size);

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, capacity, mail, alarms, state, reply] = *this;
    archive.given(log, capacity, mail, alarms);
    archive.within(State::kIdle, State::kAnswered, state);
    archive(reply);
  }

 private:
  enum class State : std::uint8_t { kIdle, kOpen, kAnswered };

  Reply poll(Cycle now);
  Reply alarm_ack(Cycle now, const Request& request);
  bool waits_for_user() const { return answer_.bytes[0] == dpv1::kAlarmAck && alarms_.with_user(); }

  EventLog& log_;
  const int capacity_;  ///< data bytes of a request
  AcyclicMail& mail_;
  Alarms& alarms_;
  State state_ = State::kIdle;
  Pdu answer_;
};

}  // namespace dsdpv1::profibus
