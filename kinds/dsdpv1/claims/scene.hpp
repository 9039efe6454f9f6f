#pragma once
// A capture as used by all measurements: its wires, its time, and the accesses and telegrams derived from them.
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

constexpr double kEmptyAccess = 7;       ///< cycles of an access without work: micro-architecture, 9.1
constexpr double kStartUpAccess = 2054;  ///< cycles: micro-architecture, 9.7
/// Cycles of it, the next access, which writes B012, and the gap between them.
constexpr double kStartUpWithNext = kStartUpAccess + 1 + kEmptyAccess + 1;

/// In a capture without RESET: the chip was in reset at some time from `from` to before `to`.
struct Reset {
  Tick from = 0, to = 0;
};

/// A byte read or written by the user.
struct UserAccess {
  Tick start = 0;  ///< the later fall of CSR and RD (WR)
  Tick end = 0;    ///< read: the earlier rise of the two; write: WR's rise
  bool write = false;
  std::uint32_t address = 0;
  std::uint8_t data = 0;
};

struct Scene : Conversation {
  /// Derives the telegrams and accesses from the record.
  Scene(const Record& all, const TimeBase& base, std::optional<int> station);

  const Record& record;
  TimeBase time;
  std::vector<ChipAccess> accesses = {};
  std::vector<UserAccess> user = {};
  std::vector<Reset> resets = {};  ///< if RESET is not in the capture; by find_resets

  /// Whether the user's request pins, as far as they are visible, are low from `from` to `to`.
  bool user_lets(Tick from, Tick to) const;
  /// True if the capture has both of them.
  bool sees_user() const { return record.sees({wire::kRReq, wire::kRSta}); }
  /// The shortest accesses of the chip may lie between two samples.
  bool may_miss_accesses() const { return time.doubt() >= kEmptyAccess; }
  /// RESET was low between them, or other evidence says that it may have been.
  bool in_reset(Tick from, Tick to) const;
  /// A reset may have happened that no pin shows: the capture has neither RESET, READY nor L_REQ, and neither BR nor
  /// PBF has a level found only in operation.
  bool may_hide_reset(Tick from, Tick to) const;
  /// The first one after a reset (H6).
  bool is_start_up(const ChipAccess& access) const { return access.start_up; }
};

/// Finds the start-up accesses, and resets in a capture without RESET. Needs the scale of time.
void find_resets(Scene& scene);

}  // namespace dsdpv1::calibrate
