#pragma once
// R_REQ or R_STA of a chip on the bench.
#include <systemc>

namespace dsdpv1::systemc_bench {

/// A level that is there at once, in the place of an sc_signal, which would have it a delta cycle later: an update, an
/// event and a process of the kernel less, for the pins that a user CPU moves four times each time that it wants the
/// DPRAM. Whoever sets it tells the chip, which reads it (TlmModule::sync); nobody waits for its events.
class HandshakePin : public sc_core::sc_prim_channel, public sc_core::sc_signal_in_if<bool> {
 public:
  explicit HandshakePin(const char* name) : sc_prim_channel(name) {}
  void set(bool level) { level_ = level; }

  const bool& read() const override { return level_; }
  const bool& get_data_ref() const override { return level_; }
  bool event() const override { return false; }
  bool posedge() const override { return false; }
  bool negedge() const override { return false; }
  const sc_core::sc_event& default_event() const override { return never_; }
  const sc_core::sc_event& value_changed_event() const override { return never_; }
  const sc_core::sc_event& posedge_event() const override { return never_; }
  const sc_core::sc_event& negedge_event() const override { return never_; }

 private:
  bool level_ = false;
  sc_core::sc_event never_;
};

}  // namespace dsdpv1::systemc_bench
