#pragma once
// In data exchange the user fetches outputs, renews inputs and serves its watchdog (5.2.5).
#include "bus/monitor/monitor.hpp"
#include "kinds/spc3/checks/check.hpp"
#include "kinds/spc3/checks/interrupt_rules.hpp"
#include "kinds/spc3/checks/seen_chip.hpp"
#include "tb/chip/checks/duty.hpp"
#include "tb/chip/checks/own_station.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::spc3_checks {

class LiveRules {
 public:
  /// All must outlive it.
  LiveRules(checks::Recorder& recorder, SeenChip& chip, const InterruptRules& interrupt)
      : recorder_(recorder), chip_(chip), interrupt_(interrupt) {}

  void reset();
  void rts(Tick at, bool level) { station_.drives(at, level); }
  void xdataexch(Tick at, bool level) { level ? leave() : enter(at); }
  bool exchanging() const { return exchanging_; }
  void accessed(const RegisterAccess& access);
  void telegram(const bus::WireTelegram& telegram);
  void pass(Tick now);

 private:
  void enter(Tick at);
  void leave();
  void exchanged(Tick at, bool outputs);
  void count(Tick at);
  Tick used() const;
  bool looks_in_vain(const RegisterAccess& access) const;

  checks::Recorder& recorder_;
  SeenChip& chip_;
  const InterruptRules& interrupt_;
  checks::OwnStation station_;
  bool exchanging_ = false;
  checks::Duty outputs_, inputs_;
  std::uint64_t unfetched_ = 0;  ///< data telegrams since the last fetch
  Tick fetched_ = 0;             ///< the last Next_Dout
  Tick count_ = 0;               ///< data telegrams since the user watchdog was loaded
  Tick loaded_ = 0;              ///< its value; 0: it was not loaded (A34)
  bool told_ = false;            ///< that it runs out
};

}  // namespace dsdpv1::spc3_checks
