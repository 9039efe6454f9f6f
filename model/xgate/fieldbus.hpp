#pragma once
// The module's side of PROFIBUS: a DPV1 slave (X1) whose parameters and configuration are judged by what the host has
// given, and what of it waits for the host. Mail of the slave at one edge is taken at the next.
#include "model/profibus/station.hpp"
#include "model/profibus/user_side.hpp"
#include "model/xgate/initialisation.hpp"
#include "model/xgate/mailbox.hpp"

namespace dsdpv1::xgate {

/// The module's slave has these.
constexpr profibus::Capacities kCapacities{profibus::kMaxUserPrm, profibus::kMaxCfg, profibus::kMaxIo,
                                           profibus::kMaxAcyclic, profibus::Alarms::kMost};

class Fieldbus {
 public:
  /// `user`, of `station`, has kCapacities.
  Fieldbus(profibus::EventLog& log, const Config& config, profibus::UserSide& user, profibus::Station& station)
      : log_(log), config_(config), user_(user), station_(station) {}

  profibus::DpState state() const { return user_.mail().state.state; }
  bool exchanging() const { return state() == profibus::DpState::kDataExch; }

  /// The slave has been reset, or its host begins again.
  void reset();
  /// Through OFFLINE to WAIT_PRM with what the host gives.
  void start(Cycle now, const Initialisation& given);
  /// As start(), with the last one.
  void restart(Cycle now);
  void stop(Cycle now);
  void leave_master(Cycle now);

  /// Takes what the slave has left before the edge `now`, before the slave's own edge.
  void eval(Cycle now);
  Cycle next() const;

  // --- commands of the host -----------------------------------------------------------------------------------------
  /// Why data cannot be exchanged now (X9 to X11).
  Error exchange_fault() const;
  Error set_inputs(Cycle now, const Frame& frame);
  void outputs(Frame& answer);
  bool new_prm() const { return new_prm_; }
  /// Command 21 (X9).
  void prm_is_known() { new_prm_ = false; }
  /// Command 22, 23, 24: false: there is none yet.
  bool prm(Frame& answer) const;
  bool cfg(Frame& answer);
  bool lengths(Frame& answer) const;
  bool requests_open() const { return for_host(c1(), given_.c1_size()) || for_host(c2(), given_.c2_size()); }
  void requests(Frame& answer);
  Error answer_requests(Cycle now, const Frame& frame);
  Error diagnosis(Cycle now, const Frame& frame);
  /// The master has acknowledged an alarm, until the host clears it.
  bool acknowledged() const { return acknowledged_; }
  void clear_acknowledged() { acknowledged_ = false; }
  bool wants_host() const { return new_prm_ || acknowledged_ || requests_open(); }

  template <class Archive>
  void store(Archive& archive) {
    auto& [log, config, user, station, given, prm, cfg, has_prm, new_prm, has_cfg, cfg_known, acknowledged, fault,
           c1_shown, c2_shown] = *this;
    archive.given(log, config, user, station);
    archive(given, prm, cfg, has_prm, new_prm, has_cfg, cfg_known, acknowledged, fault);
    archive.cycles(c1_shown, c2_shown);
    if constexpr (Archive::kReads) offer();
  }

 private:
  struct Open {  ///< a request that the host was shown
    profibus::AcyclicMail* mail;
    int area;  ///< 1 or 2
  };

  bool refusable(const profibus::AcyclicMail& mail, int most) const;
  bool for_host(const profibus::AcyclicMail& mail, int most) const {
    return mail.due.waiting() && !refusable(mail, most);
  }
  const profibus::AcyclicMail& c1() const { return user_.mail().c1; }
  const profibus::AcyclicMail& c2() const { return user_.mail().c2; }
  /// X23: the master's configuration, before it the host's; null: there is none.
  const profibus::Block<profibus::kMaxCfg>* known_cfg() const;
  void forget();
  void offer();
  void judge_prm(Cycle now);
  void judge_cfg(Cycle now);
  bool cfg_may_differ() const;
  void take_acknowledgement();
  void refuse_requests(Cycle now);
  bool refuse_request(Cycle now, int area, const profibus::AcyclicMail& mail, int most);
  Open open(const Mailbox& box);
  Error give(Cycle now, const Frame& frame, bool check_only);
  void give(Cycle now, int area, const std::uint8_t* pdu, int size);

  profibus::EventLog& log_;
  const Config& config_;
  profibus::UserSide& user_;
  profibus::Station& station_;
  Initialisation given_;
  profibus::Block<profibus::kMaxUserPrm> prm_;
  profibus::Block<profibus::kMaxCfg> cfg_;
  bool has_prm_ = false, new_prm_ = false, has_cfg_ = false;
  bool cfg_known_ = false;  ///< the host has read it
  bool acknowledged_ = false;
  Error fault_;                                                      ///< X9, X10
  Cycle c1_shown_ = profibus::kNever, c2_shown_ = profibus::kNever;  ///< Due::since of what the host was shown
};

}  // namespace dsdpv1::xgate
