#pragma once
// A chip in its TLM view as a station of the bench: RESET and the handshake as calls, and a station on an RS-485
// segment.
#include <functional>
#include <memory>
#include <string>
#include <systemc>

#include "bus/wire/segment.hpp"
#include "model/systemc/rsu_tlm.hpp"
#include "tb/systemc/chip_port.hpp"
#include "tb/systemc/timeline_module.hpp"

namespace dsdpv1::systemc_bench {

/// RESET, R_REQ or R_STA: a level that takes effect at once, instead of an sc_signal, which takes a delta cycle. That
/// keeps the order of RESET and other pins at one tick. It saves an update, an event and a process of the kernel for
/// pins that a user CPU moves four times per hold of the DPRAM. The caller that sets it must notify the chip, which
/// reads it (TlmModule::sync); no process waits for its events.
class PromptPin : public sc_core::sc_prim_channel, public sc_core::sc_signal_in_if<bool> {
 public:
  explicit PromptPin(const char* name) : sc_prim_channel(name) {}
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

/// The module and its wiring. The segment receives PBTXD and PBRTS at their exact ticks, also from inside the core. The
/// phase of the chip must be 0: the bench counts the chip's ticks.
class TlmChip : public sc_core::sc_module {
 public:
  /// Telegrams are passed as runs in the direction whose pin is not in `options.observed`.
  TlmChip(const sc_core::sc_module_name& name, const dsdpv1::systemc::TlmOptions& options, bus::Segment& segment,
          TimelineModule& timeline);
  TlmChip(const sc_core::sc_module_name& name, const dsdpv1::systemc::RsuTlmOptions& options, bus::Segment& segment,
          TimelineModule& timeline);

  dsdpv1::systemc::TlmModule& module() { return *module_; }
  const dsdpv1::systemc::TlmModule& module() const { return *module_; }
  /// The module of a DSDPV1-RSU; null for other chips.
  dsdpv1::systemc::RsuTlmModule* rsu() { return rsu_; }
  bus::StationId station() const { return port_->station(); }

  /// Pins driven by the bench, only at the timeline's present time.
  void set_reset(bool level);
  void set_r_req(bool level) { move(r_req_, level); }
  void set_r_sta(bool level) { move(r_sta_, level); }

  /// Every pin change, as ChipModule::on_pin. Set before the simulation starts.
  std::function<void(bus::Tick at, dsdpv1::Pin pin, dsdpv1::Level level)> on_pin;

 private:
  TlmChip(const sc_core::sc_module_name& name, bus::Segment& segment, TimelineModule& timeline);
  /// Takes ownership of `module`.
  void take(dsdpv1::systemc::TlmModule* module);

  void move(PromptPin& pin, bool level);
  void pin_changed(bus::Tick at, dsdpv1::Pin pin, dsdpv1::Level level);

  bus::Segment& segment_;
  TimelineModule& timeline_;
  dsdpv1::systemc::RsuTlmModule* rsu_ = nullptr;
  std::unique_ptr<dsdpv1::systemc::TlmModule> module_;
  PromptPin reset_{"reset"}, r_req_{"r_req"}, r_sta_{"r_sta"};
  std::unique_ptr<ChipPort> port_;
};

}  // namespace dsdpv1::systemc_bench
