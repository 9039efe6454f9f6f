#include "model/systemc/dsdpv1_tlm.hpp"

#include "model/systemc/has_process.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <string>
#include <utility>

namespace dsdpv1::systemc {

TlmModule::TlmModule(const sc_core::sc_module_name& name, const TlmOptions& options)
    : ChipModule(name, options),
      timing_(options.access),
      ownership_(options.ownership),
      hold_within_(options.hold_within),
      gives_dmi_(options.dmi),
      observed_(options.observed) {
  serve(host_socket);
  serve(host_socket_64);
  serve(host_socket_8);
  // Accesses ahead of simulation time, runs, bound ports and bus_out do not make other pins observed.
  tell_only(observed_ | ~(kHostPins | mask(Pin::kPbrxd) | kRsuOutputPins));
  bus_in.bind(*this);
  DSDPV1_HAS_PROCESS(TlmModule);
  SC_METHOD(evaluate);
  sensitive << due_ << soon_ << RESET << R_REQ << R_STA << PBRXD;
}

template <class Socket>
void TlmModule::serve(Socket& socket) {
  socket.register_b_transport(this, &TlmModule::b_transport);
  socket.register_transport_dbg(this, &TlmModule::transport_dbg);
  socket.register_get_direct_mem_ptr(this, &TlmModule::direct_mem_ptr);
}

void TlmModule::start_of_simulation() {
  check_binding();
  const struct {
    Pin pin;
    OptionalOut& port;
  } wires[] = {{Pin::kLReq, L_REQ},  {Pin::kLSta, L_STA}, {Pin::kIntr0, INTR0}, {Pin::kPbrts, PBRTS},
               {Pin::kPbtxd, PBTXD}, {Pin::kPbf, PBF},    {Pin::kBr, BR},       {Pin::kReady, READY}};
  for (const auto& wire : wires) {
    connect(mask(wire.pin), wire.port);
    if (wire.port.size() > 0) bound_ |= mask(wire.pin);
  }
  const bool told = (told_pins() & mask(Pin::kPbtxd)) != 0;
  may_hide_ = PBTXD.size() == 0 && !told;
  watch_outputs(false);
}

/// The ports need D only during an access that is not carried out as a whole.
void TlmModule::watch_outputs(bool data) {
  constexpr std::uint32_t kLate = mask(Pin::kLReq) | mask(Pin::kLSta), kData = mask(Pin::kDOut);
  watches_data_ = data;
  const std::uint32_t prompt = bound_ | asked_outputs() | (on_pin ? observed_ : 0);
  const std::uint32_t ports = data ? observed_by_ports() : observed_by_ports() & ~kData;
  in_core([&] { watch(prompt | ports, asked_outputs(), accepts_late() && (prompt & kLate) == 0); });
}

std::uint32_t TlmModule::asked_outputs() const { return heard_outputs() | mask(Pin::kPbtxd) | mask(Pin::kPbrts); }

void TlmModule::sync(const sc_core::sc_time& ahead) {
  if (is_in_core()) return;
  if (ahead > sc_core::SC_ZERO_TIME) advance(chip_tick(to_tick(sc_core::sc_time_stamp() + ahead)));
  catch_up();
  plan();
}

// ---------------------------------------------------------------------------------------------------------- host port

void TlmModule::b_transport(Payload& payload, sc_core::sc_time& delay) {
  payload.set_dmi_allowed(false);
  AccessTimingExtension* const ahead = ahead_of(payload);
  const tlm::tlm_response_status judgement = judge(payload, kDpramSize);
  if (judgement != tlm::TLM_OK_RESPONSE) {
    payload.set_response_status(judgement);
    return;
  }
  if (ahead != nullptr) {
    ahead->done = carry_out_ahead(payload, delay);
    return;
  }
  if (const unsigned int first = is_decoupled() ? carry_out_bytes_ahead(payload, delay) : 0;
      first < payload.get_data_length()) {
    wait_for(delay);
    const sc_core::sc_scoped_lock turn(host_bus_);
    try {
      carry_out(payload, first);
    } catch (...) {  // also the reset of the initiator's process
      try_to([this] { release_host_pins(); });
      throw;
    }
  }
  if (dmi_given_) chip_.direct();  // the payload's writes settle, before direct ones
  payload.set_dmi_allowed(gives_dmi());
}

bool TlmModule::carry_out_ahead(Payload& payload, sc_core::sc_time& delay) {
  payload.set_response_status(tlm::TLM_GENERIC_ERROR_RESPONSE);
  return payload.get_data_length() == 1 && is_enabled(payload, 0) && carry_out_byte_ahead(payload, 0, delay, true);
}

/// Returns the index of the first byte that must wait for simulation time; the length if the transaction is complete.
unsigned int TlmModule::carry_out_bytes_ahead(Payload& payload, sc_core::sc_time& delay) {
  const unsigned int length = payload.get_data_length();
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
  for (unsigned int i = 0; i < length && payload.is_response_ok(); ++i)
    if (is_enabled(payload, i) && !carry_out_byte_ahead(payload, i, delay, false)) return i;
  return length;
}

/// The host holds the DPRAM, so only it reads and changes it, and the time of execution is not observable. The core
/// stays in simulation time, or comes `with` its user, if nothing else happens before the end of the access; any later
/// event then finds it at its present tick. Returns false if nothing was done.
bool TlmModule::carry_out_byte_ahead(Payload& payload, unsigned int index, sc_core::sc_time& delay, bool with) {
  unsigned char& byte = payload.get_data_ptr()[index];
  const auto address = static_cast<std::uint16_t>(payload.get_address() + index);
  const HostAccess& access = maker_.make(payload.is_write(), address, byte, timing_of(payload, timing_));
  const Tick begin = to_tick(sc_core::sc_time_stamp() + delay), end = begin + access.duration();
  Level sampled = kLevelX;
  const Level told_address = chip_.level(Pin::kA);
  const auto carry_out = with ? &TlmModule::carry_out_with_core : &TlmModule::carry_out_alone;
  if (!is_private(begin) || !(this->*carry_out)(begin, end, access, sampled)) return false;
  delay = time_until(end);
  if (payload.is_read() && sampled >= 0) byte = static_cast<unsigned char>(sampled);
  const bool ok = payload.is_write() || sampled >= 0;
  payload.set_response_status(ok ? tlm::TLM_OK_RESPONSE : tlm::TLM_GENERIC_ERROR_RESPONSE);
  in_core([&] {
    tell_whole(chip_tick(begin), access, sampled, told_address);
    tell_access({chip_tick(begin), chip_tick(end), payload.is_write(), address, Level{byte}, ok, true});
  });
  return true;
}

/// Only the address may not change: the first one comes from the power-on level.
void TlmModule::tell_whole(Tick begin, const HostAccess& access, Level sampled, Level address_before) {
  if ((observed_by_ports() & kHostPins) == 0) return;
  if (!access.is_write()) samples.tell_each(begin + access.sample(), guard());
  std::array<HostAccess::Edge, kMostChanges> edges;
  const HostAccess::Edge* last = changes_of_whole(
      access, begin, sampled, [](Pin pin) { return pin; }, edges);
  for (const HostAccess::Edge* edge = edges.data(); edge != last; ++edge) {
    if (edge->pin == Pin::kA && std::exchange(address_before, edge->level) == edge->level) continue;
    tell_ports(edge->at, edge->pin, edge->level);
  }
}

void TlmModule::tell_access(const AccessReport& report) { accesses.tell_each(report, guard()); }

bool TlmModule::carry_out_with_core(Tick begin, Tick end, const HostAccess& access, Level& sampled) {
  if (kernel_quiet_until() <= end || !ChipModule::carry_out(chip_tick(begin), access, sampled)) return false;
  plan(chip_now(), chip().next_seen());  // a settling write is not an event
  return true;
}

bool TlmModule::carry_out_alone(Tick begin, Tick end, const HostAccess& access, Level& sampled) {
  if (!chip_.carry_out_ahead(chip_tick(begin), access, sampled)) return false;
  host_free_at_ = end;
  return true;
}

bool TlmModule::is_private(Tick begin) {
  return !hears_host() && R_REQ.read() && R_STA.read() && begin >= earliest() && !is_taken(host_bus_);
}

Tick TlmModule::earliest() const {
  const Tick now = current_tick();
  return std::max(now + std::max<Tick>(0, chip().now() - chip_tick(now)), host_free_at_);
}

void TlmModule::carry_out(Payload& payload, unsigned int first) {
  const AccessTiming& timing = timing_of(payload, timing_);
  access_start_ = earliest();
  unsigned char* data = payload.get_data_ptr();
  for (unsigned int i = first; i < payload.get_data_length(); ++i) {
    if (!is_enabled(payload, i)) continue;
    const auto address = static_cast<std::uint16_t>(payload.get_address() + i);
    if (!may_access(address) ||
        !(payload.is_write() ? write_byte(address, timing, data[i]) : read_byte(address, timing, data[i]))) {
      payload.set_response_status(tlm::TLM_GENERIC_ERROR_RESPONSE);
      return;
    }
  }
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
}

bool TlmModule::read_byte(std::uint16_t address, const AccessTiming& timing, unsigned char& byte) {
  perform(false, address, 0, timing);
  if (sampled_ >= 0) byte = static_cast<unsigned char>(sampled_);
  return sampled_ >= 0;
}

bool TlmModule::write_byte(std::uint16_t address, const AccessTiming& timing, unsigned char byte) {
  take_broken_timing();
  perform(true, address, byte, timing);
  return !take_broken_timing();
}

void TlmModule::release_host_pins() {
  std::exception_ptr thrown = try_to([this] { catch_up(); });
  access_ = {};
  const auto release = [this] {
    set_all(chip_now(),
            {{Pin::kRd, 1}, {Pin::kWr, 1}, {Pin::kCsr, 1}, {Pin::kDIn, kLevelZ}, {Pin::kA, HostAccess::kIdleAddress}});
  };
  if (const std::exception_ptr another = try_to(release); !thrown) thrown = another;
  if (watches_data_) watch_outputs(false);
  plan();
  if (thrown) std::rethrow_exception(thrown);
}

/// `sampled_` is then the level of D at the sample, X without a sample. As long as the user owns the DPRAM and the pins
/// are not observed, only the pins show an access, so they are moved late: at the next other event, or at the end of
/// the access.
void TlmModule::perform(bool write, std::uint16_t address, std::uint8_t value, const AccessTiming& timing) {
  wait_until(access_start_);
  access_ = maker_.make(write, address, value, timing);
  moved_ = 0;
  sampled_ = kLevelX;
  if (hears_host() || !R_REQ.read() || !R_STA.read())
    for (const HostAccess::Edge& edge : access_) wait_until(access_start_ + edge.at);
  const Tick end = access_start_ + access_.duration();
  wait_until(end);
  const bool ok = access_.is_write() ? !broken_timing() : sampled_ >= 0;
  const Level byte = access_.is_write() ? Level{value} : sampled_;
  access_ = {};
  if (watches_data_) watch_outputs(false);
  const Tick start = std::exchange(access_start_, end);
  plan();
  in_core([&] { tell_access({chip_tick(start), chip_tick(end), write, address, byte, ok, false}); });
}

/// Moves the pins of the running access at their ticks, up to `now`.
void TlmModule::move_access(Tick now) {
  if (!in_access()) return;
  const Tick start = chip_tick(access_start_);
  const bool over = start + access_.last() <= now && !hears_host();
  if (moved_ == 0 && over && move_whole(start)) return;
  if (moved_ == 0 && start <= now) begin_access(start);
  for (; moved_ < access_.size() && start + access_[moved_].at <= now; ++moved_) {
    const HostAccess::Edge& edge = access_[moved_];
    if (edge.pin == Pin::kDOut)
      sampled_ = sample(start + edge.at);
    else
      set(start + edge.at, edge.pin, edge.level);
  }
}

bool TlmModule::move_whole(Tick start) {
  const Level address = chip_.level(Pin::kA);
  if (!ChipModule::carry_out(start, access_, sampled_)) return false;
  moved_ = access_.size();  // also if a listener throws
  in_core([&] { tell_whole(start, access_, sampled_, address); });
  return true;
}

/// Its edges are moved one by one.
void TlmModule::begin_access(Tick start) {
  if ((observed_by_ports() & mask(Pin::kDOut)) != 0) watch_outputs(true);
  if (access_.is_write() || (observed_by_ports() & kHostPins) == 0) return;
  in_core([&] { samples.tell_each(start + access_.sample(), guard()); });
}

void TlmModule::wait_until(Tick tick) {
  plan();
  if (const sc_core::sc_time rest = time_until(tick); rest > sc_core::SC_ZERO_TIME) wait(rest);
  catch_up();
}

unsigned int TlmModule::transport_dbg(Payload& payload) { return transport_debug(*this, payload, kDpramSize); }

// --------------------------------------------------------------------------------------------------- save and restore

/// Runs become changes, so they need not be stored.
void TlmModule::settle() {
  sync();
  const Tick now = chip_now();
  if (now > chip_tick(current_tick())) refuse_to_save("it is ahead of simulation time");
  if (on_txd || on_rts || on_answer || (in_run(now) && !run_is_own_)) refuse_to_save("a segment has its line");
  if (in_run(now)) stop_run(now);
  if (!answer_.bytes.empty() && now < answer_.end()) show_txd();
  plan();
}

template <class Archive>
void TlmModule::store(Archive& archive) {
  archive(applied_, late_reported_, characters_level_, line_, from_chip_);
  archive.ticks(run_end_);
  store_list(archive, runs_);
  store_time(archive, host_free_at_);
}

void TlmModule::store_module(profibus::StateWriter& archive) { store(archive); }

void TlmModule::store_module(profibus::StateReader& archive) {
  store(archive);
  run_is_own_ = false;
  answer_ = {};
  answered_ = 0;
  if (dmi_given_) end_dmi();
  others_changed();
}

// ------------------------------------------------------------------------------------------------------ pins and core

void TlmModule::evaluate() {
  if (nothing_arrives()) return evaluate_core();
  const Tick now = catch_up();
  drive(take_changed());
  plan(now, chip().next_event());
}

/// Most wake-ups of the module only move L_REQ and L_STA or end a character of the chip.
void TlmModule::evaluate_core() {
  const Tick now = scheduled();
  advance(now);
  const bool left_run = in_run(now) && chip().left_run(), alone = others_ > now && !left_run;
  if (arrivals_ <= now || left_run)
    catch_up();
  else if (!alone)
    tell_characters(now);
  drive(take_changed());
  const Tick core = chip().next_event();
  alone ? schedule(now, std::min(core, others_)) : plan(now, core);
}

Tick TlmModule::catch_up() {
  const Tick now = chip_now();
  move_access(now);
  move_host(now);
  advance(now);
  offer_answer();
  apply_line(now);
  apply_inputs(now);
  if (chip().left_run()) stop_run(now);
  tell_characters(now);
  tell_host(now);
  return now;
}

/// The core has another level: a run was left in the middle of a character, and PBRXD has been high all the time.
bool TlmModule::line_is_stale(Tick now) const {
  return !in_run(now) && chip().level(Pin::kPbrxd) != Level{line_level()};
}

void TlmModule::apply_inputs(Tick now) {
  apply(now, Pin::kRReq, R_REQ.read());
  apply(now, Pin::kRSta, R_STA.read());
  apply(now, Pin::kReset, RESET.read());
}

void TlmModule::apply(Tick now, Pin pin, bool level) {
  if (((applied_ & mask(pin)) != 0) == level) return;
  applied_ ^= mask(pin);
  if (dmi_given_ && !level) end_dmi();
  if (const Tick present = current_tick(); present < host_free_at_) report_late(pin, present);
  set(now, pin, level);
}

/// Its initiator has not synchronised: it has carried out accesses that come later.
void TlmModule::report_late(Pin pin, Tick at) {
  if (std::exchange(late_reported_, true)) return;
  const std::string text = std::string(name()) + ": " + dsdpv1::name(pin) + " changes at " + to_time(at).to_string() +
                           ", but the chip's user is at " + to_time(host_free_at_).to_string() +
                           " already; an initiator has to wait for its local time first";
  SC_REPORT_WARNING("/dsdpv1/ahead", text.c_str());
}

/// Only `evaluate` writes signals (SystemC allows one writer); characters for the present time take effect in the next
/// delta cycle.
void TlmModule::plan(Tick now, Tick core) {
  const Tick line = line_is_stale(now) ? now : next_of_line();
  arrivals_ = std::min(line, next_of_host());
  others_ = std::min({arrivals_, from_chip_.next(), next_answered()});
  if (has_changed(bound_) || line <= now)
    schedule_now();
  else
    schedule(now, std::min(core, others_));
}

Tick TlmModule::next_of_line() const {
  return std::min(line_.edges.next(), runs_.empty() ? profibus::kNever : runs_.front().start);
}

}  // namespace dsdpv1::systemc
