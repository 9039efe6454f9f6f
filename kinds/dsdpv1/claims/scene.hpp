#pragma once
// A capture as all measurements see it: its wires, its time, and what they add up to.
#include <optional>
#include <vector>

#include "kinds/dsdpv1/claims/wires.hpp"
#include "lab/calibrate/conversation.hpp"

namespace dsdpv1::calibrate {

/// L_REQ high.
struct ChipAccess {
  Tick start = 0, end = 0;
  bool whole = false;     ///< its beginning and end are both in the capture
  bool start_up = false;  ///< by find_resets
};

constexpr double kEmptyAccess = 7;       ///< cycles of one that finds nothing to do: micro-architecture, 9.1
constexpr double kStartUpAccess = 2054;  ///< cycles: micro-architecture, 9.7
/// Cycles with the one behind it, which writes B012, and the gap between them.
constexpr double kStartUpWithNext = kStartUpAccess + 1 + kEmptyAccess + 1;

/// Of a capture without RESET: the chip was in reset some time from `from` to before `to`.
struct Reset {
  Tick from = 0, to = 0;
};

/// A byte that the user read or wrote.
struct UserAccess {
  Tick start = 0;  ///< the later of CSR and RD (WR) falls
  Tick end = 0;    ///< of a read the earlier of them rises, of a write WR
  bool write = false;
  std::uint32_t address = 0;
  std::uint8_t data = 0;
};

struct Scene : Conversation {
  /// Reads the telegrams and accesses out of the record.
  Scene(const Record& all, const TimeBase& base, std::optional<int> station);

  const Record& record;
  TimeBase time;
  std::vector<ChipAccess> accesses = {};
  std::vector<UserAccess> user = {};
  std::vector<Reset> resets = {};  ///< where RESET is not in the capture; by find_resets

  /// Whether the user's request pins are low, as far as they are seen, from `from` to `to`.
  bool user_lets(Tick from, Tick to) const;
  /// Whether both of them are in the capture.
  bool sees_user() const { return record.sees({wire::kRReq, wire::kRSta}); }
  /// The shortest accesses of the chip may lie between two samples.
  bool may_miss_accesses() const { return time.doubt() >= kEmptyAccess; }
  /// RESET was low between them, or may have been by what shows it otherwise.
  bool in_reset(Tick from, Tick to) const;
  /// There may have been a reset that no pin shows: RESET, READY and L_REQ are not in the capture, and neither BR nor
  /// PBF is as it only is in the operation.
  bool may_hide_reset(Tick from, Tick to) const;
  /// The first one after a reset (H6).
  bool is_start_up(const ChipAccess& access) const { return access.start_up; }
};

/// Finds the start-up accesses, and resets in a capture without RESET. Needs the scale of time.
void find_resets(Scene& scene);

}  // namespace dsdpv1::calibrate
