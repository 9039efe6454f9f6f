#pragma once
// The data that the recorded slave's user CPU must have given its chip, as shown by the capture: initialisation data,
// and inputs, diagnoses and verdicts with their times.
#include <optional>
#include <vector>

#include "lab/replay/recording.hpp"
#include "tb/chip/user_cpu/program.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::replay {

/// Inputs, diagnosis or verdict that the user CPU gives to its chip.
struct Supply {
  Tick at = 0;  ///< of the capture: when the answer before the first one that shows it has ended
  user_cpu::Command command;
};

/// In data exchange the slave was silent, or refused it, and then asked for parameters: it had restarted, or its user
/// CPU had initialised it again or left the master.
struct Restart {
  Tick from = 0, until = 0;  ///< of the capture: ends of the last answer before, and of the first data exchange after
};

struct Firmware {
  scenario::InitData init;
  bus::Bytes inputs;  ///< the first ones
  std::vector<scenario::Dpv1Object> objects;
  std::vector<Supply> supplies;  ///< in order of time
  std::vector<Restart> restarts;
  bool short_prm_buffer = false;  ///< the chip refuses a Set_Prm longer than init.max_prm with RR
  Tick cycle = 0;                 ///< of the user CPU's exchanges, quick enough for the supplies
};

/// `kind`: of the model, if known.
Firmware firmware_of(const Recording& recording, const ChipKind* kind = nullptr);

/// The user CPU judges this block, parameters or configuration, and leaves the verdict to others.
bool leaves_verdict(const scenario::UserCpu& user, const user_cpu::StationConfig& station, bool cfg);
/// Those of the supplies that this user CPU needs: the verdicts that it leaves, and, with `data`, inputs and diagnoses.
std::vector<Supply> supplies_for(const std::vector<Supply>& supplies, const scenario::UserCpu& user,
                                 const user_cpu::StationConfig& station, bool data);

/// The inputs that an answer to this request shows; null when it shows none.
const bus::Bytes* inputs_of(const bus::Telegram& request, const RecordedTelegram* answer);

/// Positions in Recording::requests.
struct Beginning {
  std::size_t first_answer = 0;  ///< the first request that the slave has answered
  /// The first that the model can answer as the slave did: where the capture begins in the middle of a data exchange,
  /// the first Set_Prm with a Chk_Cfg before data are exchanged again. As many as there are requests: none.
  std::size_t comparable = 0;
};
Beginning beginning_of(const Recording& recording);
/// Throws InputError when there is none.
void check_comparable(const Recording& recording);

}  // namespace dsdpv1::tb::replay
