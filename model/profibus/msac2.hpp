#pragma once
// MSAC_C2: two channels for class 2 masters (msac2.cpp), Initiate with the resource manager that lends them (table 30;
// msac2_initiate.cpp), and the F, I and U timers (msac2_timers.cpp): 7.3, figure 11, rulings V2 to V4, V7 to V14.
// docs/microarchitecture.md, section 15.2, has the states.
#include <initializer_list>

#include "model/profibus/acyclic.hpp"
#include "model/profibus/rm_registry.hpp"

namespace dsdpv1::profibus {

/// What the answer to an Initiate offers, and the least Send_Timeout.
struct C2Offer {
  std::uint8_t most_data = 0;               ///< Max_Len_Data_Unit
  std::array<std::uint8_t, 6> features{1};  ///< Features_Supported, Profile_Features, Profile_Ident; 1: read and write
  int least_timeout = 0;                    ///< in 10 ms
};

class Msac2 {
 public:
  static constexpr int kManagerSap = 49;

  Msac2(EventLog& log, int capacity, AcyclicMail& mail)
      : log_(log), capacity_(capacity), mail_(mail), offer_{static_cast<std::uint8_t>(capacity)} {}

  void reset();
  /// Of the chip, or of its initialisation: it stays over reset(), and is no part of a saved state.
  void offer(const C2Offer& offer) { offer_ = offer; }
  /// SAP 49: a channel for the sender, or RS. The reply's data are valid until the next call.
  Reply initiate(Cycle now, const Request& request);
  /// SAP 48 or 47: poll, request or abort.
  Reply handle(Cycle now, const Request& request);
  /// SDN to SAP 48 or 47. Returns true if it was the abort of the channel's master.
  bool abort_unanswered(Cycle now, const Request& request);
  /// The user's answer, CRC already found right. Refused with a reason when it does not fit (V14).
  void answer(Cycle now, const std::uint8_t* pdu, int size);

  /// Evaluates the timers at `now`; the next end of one of them.
  void eval(Cycle now);
  Cycle next() const;

  RmRegistry registry() const;

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, capacity, mail, offered, channels, turn, reply] = *this;
    archive.given(log, capacity, mail, offered);
    archive(channels);
    archive.within(kNobody, kC2Channels - 1, turn);
    archive.scratch(reply);
  }

 private:
  enum class State : std::uint8_t { kFree, kInitiated, kOpen, kBusy, kAnswered, kAborted };

  struct Channel {
    State state = State::kFree;
    std::uint8_t master = 0;
    std::uint8_t abort_reason = 0;
    Cycle timeout = 0;       ///< Send_Timeout in cycles
    Cycle idle_timeout = 0;  ///< twice that, limited to 16 bits
    Cycle watch = kNever;    ///< F or I ends
    Cycle user = kNever;     ///< U ends
    Pdu pdu;                 ///< Initiate, then the request, then its answer

    template <class Archive>
    void store(Archive& archive) {
      auto& [is, lent_to, reason, most, most_idle, watch_ends, user_ends, bytes] = *this;
      archive.within(State::kFree, State::kAborted, is);
      archive(lent_to, reason, bytes);
      archive.lengths(most, most_idle);
      archive.cycles(watch_ends, user_ends);
    }
  };
  static constexpr int kNobody = -1, kSsap = 50;
  static constexpr std::uint8_t kSequenceError = 1, kInvalidPdu = 2, kTimeout = 3, kInvalidAddAddr = 7;  // aborts, V11

  Channel& channel_at(int channel) { return channels_[static_cast<std::size_t>(channel)]; }
  const Channel& channel_at(int channel) const { return channels_[static_cast<std::size_t>(channel)]; }
  State state(int channel) const { return channel_at(channel).state; }
  static int channel_of(const Request& request) { return kC2FirstSap - request.dsap; }
  static void put(Pdu& pdu, std::initializer_list<std::uint8_t> bytes) {
    pdu.assign(bytes.begin(), static_cast<int>(bytes.size()));
  }
  static unsigned sap_of(int channel) { return static_cast<unsigned>(kC2FirstSap - channel); }
  RmEntry entry(int number) const;
  void enter(Cycle now, int number, State state);
  bool lent_to_sender(const Request& request) const;
  Reply refuse(Cycle now, const Request& request) const;
  void aborted_by_master(Cycle now, const Request& request);
  int free_channel() const;
  Reply poll(Cycle now, int number);
  Reply connect(Cycle now, int number);
  Reply request(Cycle now, int number, const Request& request);
  Reply send_answer(Cycle now, int number);
  Reply send_abort(Cycle now, int number, std::uint8_t reason);
  Reply abort_for_request(Cycle now, int number, std::uint8_t function, std::uint8_t reason);
  void expire(Cycle now, int number);
  void abort(Cycle now, int number, std::uint8_t reason);
  void free(Cycle now, int number);
  void begin_turn(Cycle now, int number);
  void end_turn(Cycle now, int number);

  EventLog& log_;
  const int capacity_;  ///< data bytes of a request or answer
  AcyclicMail& mail_;
  C2Offer offer_;
  std::array<Channel, kC2Channels> channels_;
  int turn_ = kNobody;  ///< the channel whose request is with the user
  Pdu reply_;           ///< replies of the chip itself: immediate answers, initiate answers, aborts
};

}  // namespace dsdpv1::profibus
