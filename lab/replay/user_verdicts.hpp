#pragma once
// The user CPU's verdicts on parameters and configurations, from the answers that show them.
#include <optional>
#include <vector>

#include "lab/replay/recording.hpp"

namespace dsdpv1::tb::replay {

struct UserVerdict {
  Tick at = 0;  ///< of the capture: when the answer before the first one that shows it has ended
  bool cfg = false;
  bool refuse = false;
  int ident = 0;          ///< of the Set_Prm
  bus::Bytes block = {};  ///< the configuration
};

/// Takes the requests to a slave with their answers, in order of time. A block that the master replaces before an
/// answer shows a verdict has none.
class VerdictReader {
 public:
  /// `begin`: of the capture. `cfg_early`: the chip takes a Chk_Cfg while the user judges the parameters.
  VerdictReader(Tick begin, bool cfg_early) : before_(begin), cfg_early_(cfg_early) {}
  void take(const bus::Telegram& request, const RecordedTelegram* answer);

  const std::vector<UserVerdict>& verdicts() const { return verdicts_; }
  /// The user CPU, not the chip, judges parameters: they waited for the verdict (S7), or the slave of this ident number
  /// refused some that a chip takes (S6).
  bool judges_prm(std::optional<int> ident) const;
  /// The user CPU, not the chip, judges configurations: they waited for the verdict (S7), or one that was refused is
  /// the same as `own`.
  bool judges_cfg(const std::optional<bus::Bytes>& own) const;

 private:
  void take_set_prm(const bus::Telegram& request);
  void take_chk_cfg(const bus::Telegram& request, const RecordedTelegram* answer);
  void take_diagnosis(const bus::Bytes& diagnosis);
  void take_not_ready(bool held);
  void decide(std::optional<UserVerdict>& open, bool refuse);
  void accept();

  std::vector<UserVerdict> verdicts_;
  std::optional<UserVerdict> prm_, cfg_;  ///< no answer has shown the verdict yet
  Tick before_;                           ///< end of the last answer
  bool cfg_early_;
  bool exchanging_ = false;
  bool held_ = false, was_held_ = false;  ///< a diagnosis shows a master; the last one before the Set_Prm did
  bool cfg_refused_ = false;              ///< since the Set_Prm
  bool prm_waits_ = false, cfg_waits_ = false;
};

}  // namespace dsdpv1::tb::replay
