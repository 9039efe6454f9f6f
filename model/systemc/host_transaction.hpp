#pragma once
// Transactions of a user CPU for the host port: the timing of their accesses.
#include <tlm.h>

#include "model/dsdpv1/host_access.hpp"
#include "model/systemc/transaction.hpp"

namespace dsdpv1::systemc {

/// Gives one transaction its own timing, and may make it one of a decoupled initiator. A payload frees its remaining
/// extensions at the end: clear one that is not on the heap.
struct AccessTimingExtension : tlm::tlm_extension<AccessTimingExtension> {
  AccessTiming timing;
  /// b_transport does not wait: it executes the access ahead of simulation time, at the annotated delay, and advances
  /// the delay to the end of the access. If the result would differ from waiting, nothing is done, `done` is false and
  /// the response TLM_GENERIC_ERROR_RESPONSE. The chip is then in the future: inputs moved before that time are seen
  /// there.
  bool ahead = false;
  bool done = false;  ///< set by the target if `ahead`
  tlm::tlm_extension_base* clone() const override { return new AccessTimingExtension(*this); }
  void copy_from(const tlm::tlm_extension_base& other) override {
    *this = static_cast<const AccessTimingExtension&>(other);
  }
};

constexpr sc_dt::uint64 kDpramSize = 0x800;  ///< bytes, from address 0 on

/// The timing from the payload's extension, or `own` if there is none.
const AccessTiming& timing_of(const tlm::tlm_generic_payload& payload, const AccessTiming& own);

/// The extension that asks to run ahead of simulation time, not done yet; null without one.
AccessTimingExtension* ahead_of(const tlm::tlm_generic_payload& payload);

}  // namespace dsdpv1::systemc
