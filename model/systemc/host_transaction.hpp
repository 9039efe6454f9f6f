#pragma once
// Transactions of a user CPU for the host port: what their payloads have to be, and the timing of their accesses.
#include <tlm.h>

#include "model/dsdpv1/host_access.hpp"

namespace dsdpv1::systemc {

/// Gives one transaction another timing than the module's own, and makes it one of a decoupled initiator. A payload
/// frees the extensions that it still has in the end: clear one that is not on the heap.
struct AccessTimingExtension : tlm::tlm_extension<AccessTimingExtension> {
  AccessTiming timing;
  /// b_transport does not wait: it carries the access out ahead of simulation time, at the annotated delay, which it
  /// moves on to the end of the access. Where that would come to something else than waiting, nothing is done and the
  /// response is TLM_INCOMPLETE_RESPONSE. The chip is in that future then: inputs that are moved before are seen there.
  bool ahead = false;
  tlm::tlm_extension_base* clone() const override { return new AccessTimingExtension(*this); }
  void copy_from(const tlm::tlm_extension_base& other) override {
    *this = static_cast<const AccessTimingExtension&>(other);
  }
};

constexpr sc_dt::uint64 kDpramSize = 0x800;  ///< bytes, from address 0 on

/// TLM_OK_RESPONSE for a transaction that can be carried out (docs/systemc.md has the others).
tlm::tlm_response_status judge(const tlm::tlm_generic_payload& payload);

/// Whether byte `index` of the data is accessed.
bool is_enabled(const tlm::tlm_generic_payload& payload, unsigned int index);

/// That of the payload's extension, else `own`.
const AccessTiming& timing_of(const tlm::tlm_generic_payload& payload, const AccessTiming& own);

/// Whether its initiator runs ahead of simulation time by itself.
bool is_ahead(const tlm::tlm_generic_payload& payload);

}  // namespace dsdpv1::systemc
