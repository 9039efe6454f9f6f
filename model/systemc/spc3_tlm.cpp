#include "model/systemc/spc3_tlm.hpp"

#include <algorithm>

#include "model/spc3/reasons.hpp"
#include "model/spc3/variant.hpp"
#include "model/systemc/has_process.hpp"

namespace dsdpv1::systemc {

using spc3::Pin;

Spc3TlmModule::Spc3TlmModule(const sc_core::sc_module_name& name, const Spc3TlmOptions& options)
    : Spc3Module(name, options),
      size_(static_cast<sc_dt::uint64>(spc3::addresses(options.chip.variant))),
      access_(options.access) {
  serve(host_socket);
  serve(host_socket_64);
  serve(host_socket_8);
  bus_in.bind(*this);
  DSDPV1_HAS_PROCESS(Spc3TlmModule);
  SC_METHOD(evaluate);
  sensitive << due_ << soon_ << RESET << XCTS << RXD;
}

template <class Socket>
void Spc3TlmModule::serve(Socket& socket) {
  socket.register_b_transport(this, &Spc3TlmModule::b_transport);
  socket.register_transport_dbg(this, &Spc3TlmModule::transport_dbg);
}

void Spc3TlmModule::start_of_simulation() {
  if (!is_bound(host_socket_64) && !is_bound(host_socket_8)) require_bound(host_socket, "it is the user CPU's");
  const struct {
    Pin pin;
    OptionalOut& port;
  } wires[] = {{Pin::kXInt, X_INT}, {Pin::kXDataExch, XDATAEXCH}, {Pin::kTxd, TXD}, {Pin::kRts, RTS}};
  for (const auto& wire : wires) {
    connect(mask(wire.pin), wire.port);
    if (wire.port.size() > 0) bound_ |= mask(wire.pin);
  }
  watch(spc3::kOutputPins, spc3::kOutputPins);
}

void Spc3TlmModule::sync(const sc_core::sc_time& ahead) {
  if (is_in_core()) return;
  if (ahead > sc_core::SC_ZERO_TIME) advance(chip_tick(to_tick(sc_core::sc_time_stamp() + ahead)));
  catch_up();
  plan();
}

// --- accesses --------------------------------------------------------------------------------------------------------

void Spc3TlmModule::b_transport(Payload& payload, sc_core::sc_time& delay) {
  payload.set_dmi_allowed(false);
  payload.set_response_status(judge(payload, size_));
  if (!payload.is_response_ok()) return;
  const unsigned int first = is_decoupled() ? carry_out_ahead(payload, delay) : 0;
  if (first == payload.get_data_length()) return;
  wait_for(delay);
  const sc_core::sc_scoped_lock turn(host_bus_);
  carry_out(payload, first);
}

/// Returns the index of the first byte that must wait for simulation time; the length if the transaction is complete.
unsigned int Spc3TlmModule::carry_out_ahead(Payload& payload, sc_core::sc_time& delay) {
  const unsigned int length = payload.get_data_length();
  for (unsigned int i = 0; i < length && payload.is_response_ok(); ++i) {
    if (!is_enabled(payload, i)) continue;
    const Tick end = to_tick(sc_core::sc_time_stamp() + delay) + length_of(payload);
    if (!is_unseen(end)) return i;
    access(payload, i, chip_tick(end), true);
    plan();
    delay = time_until(end);
  }
  return length;
}

/// True if no process and no event of the chip comes up to `end`; the time of execution is then not observable, and the
/// core may be ahead of simulation time. The edge that takes the last access does not count if it changes no output and
/// reports nothing; the core has then passed it.
bool Spc3TlmModule::is_unseen(Tick end) {
  const Tick at = chip_tick(end);
  if (at < chip().now() || has_changed(bound_) || !driven_.empty() || is_busy()) return false;
  unschedule();  // the kernel is asked about others
  bool unseen = kernel_quiet_until() > end && std::min(line_.edges.next(), from_chip_.next()) > at;
  if (unseen && chip().next_event() == taken_ && taken_ <= at) {
    seen_ = false;
    advance(taken_);
    unseen = !seen_;
  }
  unseen = unseen && chip().next_event() > at;
  if (!unseen) plan();
  return unseen;
}

void Spc3TlmModule::settle() {
  sync();
  if (chip().now() > chip_tick(current_tick())) refuse_to_save("it is ahead of simulation time");
  if (on_txd || on_rts || on_answer || in_run(chip_now())) refuse_to_save("a segment has its line");
}

void Spc3TlmModule::carry_out(Payload& payload, unsigned int first) {
  Tick end = current_tick();
  for (unsigned int i = first; i < payload.get_data_length() && payload.is_response_ok(); ++i) {
    if (!is_enabled(payload, i)) continue;
    end += length_of(payload);
    if (const sc_core::sc_time rest = time_until(end); rest > sc_core::SC_ZERO_TIME) wait(rest);
    access(payload, i, catch_up(), false);
    plan();
  }
}

/// The core is at `at`, or before it without an event in between.
void Spc3TlmModule::access(Payload& payload, unsigned int index, Tick at, bool ahead) {
  unsigned char& byte = payload.get_data_ptr()[index];
  const auto address = static_cast<spc3::Address>(payload.get_address() + index);
  in_reset_ = false;
  in_core([&] {
    chip_.advance(at);
    const profibus::Cycle cycle = at / profibus::kTicksPerCycle;
    if (payload.is_write())
      chip_.store(cycle, address, byte);
    else
      byte = chip_.load(cycle, address);
    const Tick begin = std::max<Tick>(at - length_of(payload), 0);
    accesses.tell_each({begin, at, payload.is_write(), address, byte, !in_reset_, ahead}, guard());
  });
  taken_ = profibus::first_edge_after(at) * profibus::kTicksPerCycle;
  if (in_reset_) payload.set_response_status(tlm::TLM_GENERIC_ERROR_RESPONSE);
}

Tick Spc3TlmModule::length_of(const Payload& payload) const {
  const auto* extension = payload.get_extension<RegisterAccessExtension>();
  return extension != nullptr ? extension->access : access_;
}

unsigned int Spc3TlmModule::transport_dbg(Payload& payload) { return transport_debug(*this, payload, size_); }

// --- pins and core ---------------------------------------------------------------------------------------------------

void Spc3TlmModule::evaluate() {
  catch_up();
  drive(take_changed());
  plan();
}

Tick Spc3TlmModule::catch_up() {
  const Tick now = chip_now();
  advance(now);
  offer_answer();
  drive_line();
  apply_line(now);
  set(now, Pin::kXCts, XCTS.size() > 0 && XCTS->read());
  set(now, Pin::kReset, RESET.read());
  tell_characters(now);
  return now;
}

/// Only `evaluate` writes signals (SystemC allows one writer); characters for the present time take effect in the next
/// delta cycle. Outputs that have changed ahead of simulation time are written at their time.
void Spc3TlmModule::plan() {
  const Tick now = chip_now(), present = chip_tick(current_tick());
  const Tick line = line_.edges.next();
  if ((has_changed(bound_) || !driven_.empty()) && now > present)
    schedule(present, std::min(now, next_driven()));
  else if (has_changed(bound_) || line <= now)
    schedule_now();
  else
    schedule(now, std::min({chip().next_event(), line, from_chip_.next()}));
}

bool Spc3TlmModule::output_changed(Tick at, spc3::Pin pin, spc3::Level level) {
  seen_ = true;
  if (pin == Pin::kTxd && chip().begins_to_send() && hides_answers()) {
    answer_waits_ = true;
    return false;
  }
  if ((pin == Pin::kTxd && on_txd) || (pin == Pin::kRts && on_rts)) driven_.push_back({at, pin, level != 0});
  if (pin != Pin::kTxd || !bus_out.bound()) return true;
  if (const auto character = from_chip_.take(at)) complete_.push_back(*character);
  from_chip_.edge(at, level != 0, bit_time_of(chip().status().baud_index));
  return true;
}

void Spc3TlmModule::heard(const profibus::Event& event) {
  seen_ = true;
  in_reset_ = in_reset_ || event.reason == spc3::Reason::kInReset;
}

// --- a station of a line ---------------------------------------------------------------------------------------------

void Spc3TlmModule::set_line(bool level) {
  far_level_ = level;
  schedule_now();
}

/// The line reacts to a change, so it gets it when the core is idle, and never ahead of simulation time.
void Spc3TlmModule::drive_line() {
  const Tick present = chip_tick(current_tick());
  while (next_driven() <= present) {
    const Driven change = driven_.front();
    driven_.pop_front();
    (change.pin == Pin::kTxd ? on_txd : on_rts)(change.at, change.level);
  }
}

void Spc3TlmModule::apply_line(Tick now) {
  while (line_.edges.next() <= now) characters_level_ = line_.edges.take().level;
  if (in_run(now) && chip().left_run()) {
    leave_run(now);
    if (on_left_run) on_left_run(now);
  }
  if (in_run(now) && line_level()) return;
  if (in_run(now)) leave_run(now);
  set(now, Pin::kRxd, line_level());
}

bool Spc3TlmModule::hear_run(const profibus::CharacterRun& run) {
  catch_up();
  const Tick now = chip_now();
  profibus::CharacterRun heard = run;
  heard.start = now;
  const bool hears = !tells(Pin::kRxd) && !in_run(now) && chip().level(Pin::kRxd) == 1 && core_hears(now, heard);
  if (hears)
    run_end_ = now + static_cast<Tick>(run.size) * profibus::kBitsPerCharacter * run.bit * profibus::kTicksPerCycle;
  plan();
  return hears;
}

void Spc3TlmModule::leave_run() {
  catch_up();
  if (in_run(chip_now())) leave_run(chip_now());
  plan();
}

void Spc3TlmModule::leave_run(Tick now) {
  run_end_ = now;
  core_leaves_run(now);
}

/// TXD has fallen, not reported yet. The change of RTS before it goes first.
void Spc3TlmModule::offer_answer() {
  if (!answer_waits_) return;
  answer_waits_ = false;
  drive_line();
  const profibus::CharacterRun run = hide_core_txd();
  if (on_answer(run)) return;
  show_core_txd(run.start);
  note_output(mask(Pin::kTxd), false);
  on_txd(run.start, false);
}

void Spc3TlmModule::show_txd() {
  catch_up();
  show_core_txd(chip_now());
  plan();
}

// --- characters ------------------------------------------------------------------------------------------------------

void Spc3TlmModule::write(const BusCharacter& character) {
  if (!line_.is_sendable(character)) return;
  line_.collides(character);
  const Tick before = line_.edges.next();
  line_.put(character);
  if (line_.edges.next() != before) plan();
}

void Spc3TlmModule::tell_characters(Tick now) {
  if (const auto character = from_chip_.take(now)) complete_.push_back(*character);
  while (!complete_.empty()) {  // a listener may call back and continue here
    const LineCharacter character = complete_.front();
    complete_.pop_front();
    bus_out.write(on_bus(character, zero()));
  }
}

}  // namespace dsdpv1::systemc
