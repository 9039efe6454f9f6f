#pragma once
// MSAL1: alarms of a slave with DPV1 (rulings AL1 to AL8 of docs/alarms.md; EN 50170 DPV1). The user raises an alarm in
// the diagnosis; it is open until the master that holds the slave has acknowledged it, at SAP 51 or 50.
#include <array>

#include "model/profibus/acyclic.hpp"

namespace dsdpv1::profibus {

/// Bytes 1 to 3 of an alarm block and of Alarm_Ack. The specifier: sequence number (bits 7 to 3), Add_Ack, specifier.
struct Alarm {
  std::uint8_t slot = 0, type = 0, specifier = 0;

  unsigned sequence() const { return specifier >> 3U; }
  /// AL7: an Alarm_Ack with these bytes means this alarm.
  bool is(const Alarm& other) const {
    return slot == other.slot && type == other.type && sequence() == other.sequence();
  }

  template <class Archive>
  void store(Archive& archive) {
    auto& [place, kind, how] = *this;
    archive(place, kind, how);
  }
};

/// An Alarm_Ack that the user has not taken yet.
struct AlarmMail {
  Due due;
  Alarm alarm;

  template <class Archive>
  void store(Archive& archive) {
    auto& [waits, acknowledged] = *this;
    archive(waits, acknowledged);
  }
};

class Alarms {
 public:
  static constexpr int kMost = 32;  ///< Alarm_Mode 7

  /// `most`: alarms that the chip keeps open, 0 to 32; 0: it has none, SAP 50 does not exist, and nothing is stored.
  Alarms(EventLog& log, int most) : log_(log), most_(most) {}

  bool on() const { return most_ > 0; }
  int open() const { return open_; }
  /// The last Alarm_Ack. The user takes it by clearing `due`; then the master's poll is answered (AL6).
  AlarmMail& mail() { return mail_; }
  const AlarmMail& mail() const { return mail_; }

  void reset();
  /// A Set_Prm that is being judged: `spec` is its data from byte 7 on, `size` bytes of it.
  void ask(const std::uint8_t* spec, int size);
  /// Data exchange was left: all alarms are dropped (AL8).
  void close(Cycle now);
  /// Opens the alarm of `block`; false, with a reason, if it may not be. `size`: of the whole diagnosis.
  bool raise(Cycle now, const std::uint8_t* block, int size, int max_diag);

  /// SAP 50: an Alarm_Ack, or a poll, of the master entitled to it. The reply's data are valid until the next call.
  Reply handle(Cycle now, const Request& request);
  /// An Alarm_Ack at SAP 50 or 51: the answer for its poll. False: the user has not taken the one before, RR.
  bool acknowledge(Cycle now, const Request& request, Pdu& answer);
  /// The answer to an Alarm_Ack waits for its user.
  bool with_user() const { return mail_.due.waiting(); }

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, most, enabled, mode, alarms, opened, mail, answered, answer] = *this;
    archive.given(log, most);
    if (!on()) return;
    archive(enabled, alarms, mail, answered, answer);
    archive.within(0, 7, mode);
    archive.within(0, kMost, opened);
  }

 private:
  bool enabled(const Alarm& alarm) const;
  bool room(const Alarm& alarm) const;
  Alarm* find(const Alarm& alarm);
  bool waits_for_user() const { return answer_.bytes[0] == dpv1::kAlarmAck && with_user(); }

  EventLog& log_;
  const int most_;
  std::uint8_t enabled_ = 0;  ///< DPV1_Status_2 of the last Set_Prm, 0 without DPV1
  int mode_ = 0;              ///< Alarm_Mode of its DPV1_Status_3
  std::array<Alarm, kMost> alarms_{};
  int open_ = 0;
  AlarmMail mail_;
  bool answered_ = false;  ///< SAP 50 has an answer for the next poll
  Pdu answer_;
};

}  // namespace dsdpv1::profibus
