#pragma once
// The chip as a SystemC module with TLM-2.0 sockets: the host port as a target socket, the bus as characters.
//
//   dsdpv1::systemc::TlmModule chip("chip");
//   cpu.socket.bind(chip.host_socket);
//   chip.RESET(reset); chip.R_REQ(r_req); chip.R_STA(r_sta); chip.L_REQ(l_req); chip.L_STA(l_sta);
//   chip.bus_out.bind(master);                   // tlm_analysis_if<BusCharacter>
//   master_port.bind(chip.bus_in);
//
// Ports, timing and examples: docs/systemc.md.
#include <tlm.h>
#include <tlm_utils/simple_target_socket.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <ostream>
#include <string>
#include <systemc>
#include <vector>

#include "model/dsdpv1/host_access.hpp"
#include "model/systemc/bus_character.hpp"
#include "model/systemc/chip_module.hpp"
#include "model/systemc/host_transaction.hpp"
#include "model/systemc/line_station.hpp"
#include "model/systemc/optional_port.hpp"

namespace dsdpv1::systemc {

constexpr std::uint32_t kHostPins = mask(Pin::kA) | mask(Pin::kDIn) | mask(Pin::kCsr) | mask(Pin::kRd) | mask(Pin::kWr);

/// An access while the user does not hold the DPRAM (R_REQ and R_STA high, seen by the chip, and L_STA low) is:
enum class Ownership : std::uint8_t {
  kReport,  ///< carried out, and reported by the core (P12)
  kWait,    ///< late: it waits for the hold; without one in TlmOptions::hold_within, an error and /dsdpv1/ownership
  kRefuse   ///< answered by TLM_GENERIC_ERROR_RESPONSE; no pin moves
};

struct TlmOptions : ChipOptions {
  AccessTiming access{};
  Ownership ownership = Ownership::kReport;
  /// Ticks that kWait waits at most. No source: 1 ms, the start-up of the chip and far more than its longest access.
  Tick hold_within = 12'000'000;
  /// Direct memory access for the holder of the DPRAM: nothing shows or checks its accesses.
  bool dmi = false;
  /// The pins reported to `on_pin` (dsdpv1::mask); observe() chooses those of the port `pin_changes`. Each change of a
  /// reported output costs an event. RESET, R_REQ and
  /// R_STA are always reported. If PBRXD and PBTXD are not, a telegram of valid characters costs a few events instead
  /// of six per character; if A, D, CSR, RD and WR are not, an access of the DPRAM's owner costs one.
  std::uint32_t observed = kOutputPins | mask(Pin::kPbrxd) | kHostPins;
};

/// The DSDPV1 or the DSDPV1-R; RsuTlmModule is the DSDPV1-RSU.
class TlmModule : public ChipModule, public LineStation, protected tlm::tlm_analysis_if<BusCharacter> {
 public:
  using In = sc_core::sc_in<bool>;
  using OptionalIn = systemc::OptionalIn;
  using OptionalOut = systemc::OptionalOut;

  /// DPRAM 0x000..0x7FF. Every byte of a transaction is one access with `AccessTiming`; its time passes inside
  /// b_transport.
  ///   data length 0, streaming width less than the length    TLM_BURST_ERROR_RESPONSE
  ///   byte enables: any pattern of 0x00 and 0xFF; others     TLM_BYTE_ENABLE_ERROR_RESPONSE
  ///  a byte outside the DPRAM                               TLM_ADDRESS_ERROR_RESPONSE, nothing accessed
  ///   neither read nor write                                 TLM_COMMAND_ERROR_RESPONSE
  ///   X or Z read, table 15 violated by a write              TLM_GENERIC_ERROR_RESPONSE, the burst ends there
  /// With a global quantum (tlm_global_quantum) other than zero, b_transport does not wait for an access while R_REQ
  /// and R_STA are high: the time is added to the returned delay. An initiator must wait for its delay before it moves
  /// R_REQ, R_STA or RESET (warning /dsdpv1/ahead), or samples an output.
  /// TlmOptions::ownership is for accesses without the DPRAM. Debug transport reads and writes the DPRAM without pins;
  /// direct memory access is denied, or given with TlmOptions::dmi while user_holds().
  /// Must be bound (error /dsdpv1/binding), unless the straps of a DSDPV1-RSU choose another port.
  tlm_utils::simple_target_socket_optional<TlmModule> host_socket{"host_socket"};
  /// The same for initiators of another BUSWIDTH.
  tlm_utils::simple_target_socket_optional<TlmModule, 64> host_socket_64{"host_socket_64"};
  tlm_utils::simple_target_socket_optional<TlmModule, 8> host_socket_8{"host_socket_8"};

  In RESET{"RESET"};                           ///< low-active
  In R_REQ{"R_REQ"}, R_STA{"R_STA"};           ///< the user's side of the handshake
  OptionalOut L_REQ{"L_REQ"}, L_STA{"L_STA"};  ///< the chip's side; bound, they cost two events per microsecond
  OptionalOut INTR0{"INTR0"};
  OptionalOut PBF{"PBF"}, BR{"BR"}, READY{"READY"};

  /// Characters to the chip. `start` is now or later, in order of time. A character that begins before the end of the
  /// previous one destroys its rest (a collision), and one in the past is not sent; both are reported as the warning
  /// /dsdpv1/bus.
  sc_core::sc_export<tlm::tlm_analysis_if<BusCharacter>> bus_in{"bus_in"};
  /// Characters from the chip, each at the end of its stop bit.
  ListenedPort<BusCharacter> bus_out{"bus_out"};
  OptionalOut PBRTS{"PBRTS"};  ///< the RS-485 driver's enable (P2)
  /// The raw line, in addition to the characters. A bound PBRXD and the characters of `bus_in` share the wire: a low of
  /// either wins.
  OptionalIn PBRXD{"PBRXD"};
  OptionalOut PBTXD{"PBTXD"};

  explicit TlmModule(const sc_core::sc_module_name& name, const TlmOptions& options = {});

  // As a station of a line; PBRTS is its enable, PBTXD its input.
  void set_line(bool level) override;
  bool hear_run(const profibus::CharacterRun& run) override;
  void leave_run() override;
  void show_txd() override;

  /// An access of the host is in progress. Its edges are applied later than their ticks, at the next other event or at
  /// its end; sync() applies those up to now.
  bool in_access() const { return access_.size() > 0; }

  /// A, D, CSR, RD and WR idle from now on, as for a host in reset. Done automatically when the initiator of an access
  /// is reset or killed.
  void release_host_pins();

  /// Advances the core to the present time, or `ahead` later for a decoupled initiator (the kernel must be idle until
  /// then); signals follow in the next delta cycle. For users that read levels through `chip()`. Does nothing when
  /// called from `on_pin` or `on_event`, because the core is running then.
  void sync(const sc_core::sc_time& ahead = sc_core::SC_ZERO_TIME);

  /// The chip stays away from the DPRAM until R_REQ, R_STA or RESET falls.
  bool user_holds();
  /// Up to when an initiator with a quantum is not stopped: each of its accesses is ahead of simulation time until it
  /// synchronises. sc_max_time() while the user holds the DPRAM and the pins of accesses have no observer, else the
  /// present time.
  sc_core::sc_time ahead_until();
  /// When the chip next does something that its outputs, its reports or the DPRAM may show, if no input changes: up to
  /// then they stay as they are. sc_max_time(): never.
  sc_core::sc_time next_action();

 protected:
  using Payload = tlm::tlm_generic_payload;

  void start_of_simulation() override;
  unsigned int transport_dbg(Payload& payload);
  /// Advances to the present tick and returns it.
  Tick catch_up();
  void plan() { plan(chip_now(), chip().next_event()); }
  void wait_until(Tick tick);
  /// The first simulation tick at which a new transaction may begin: an earlier one, or sync(), may be ahead of
  /// simulation time.
  Tick earliest() const;
  bool output_changed(Tick at, Pin pin, Level level) override;
  const char* title() const override { return "TlmModule"; }
  bool is_busy() override { return is_taken(host_bus_); }
  void settle() override;
  void store_module(profibus::StateWriter& archive) override;
  void store_module(profibus::StateReader& archive) override;
  /// A value used by plan() has changed while the core was running.
  void others_changed() { others_ = arrivals_ = 0; }
  /// `on_pin` or `pin_changes` reports the pin.
  bool hears(Pin pin) const { return ((observed_ | observed_by_ports()) & mask(pin)) != 0; }
  /// The parallel port's socket, of any width.
  void require_host_bound(const char* why) {
    if (!is_bound(host_socket_64) && !is_bound(host_socket_8)) require_bound(host_socket, why);
  }

 private:
  // For a host on another port.
  /// Reports a socket that must be bound.
  virtual void check_binding() { require_host_bound("it is the host port"); }
  /// Outputs that this port needs (output_changed), independent of other observers.
  virtual std::uint32_t heard_outputs() const { return 0; }
  /// Applies its edges up to the chip's tick `now`.
  virtual void move_host(Tick /*now*/) {}
  /// Reports that the core has reached `now`.
  virtual void tell_host(Tick /*now*/) {}
  /// The chip's tick of its next edge or report.
  virtual Tick next_of_host() const { return profibus::kNever; }

  template <class Archive>
  void store(Archive& archive);
  void write(const BusCharacter& character) override;  // bus_in
  void b_transport(Payload& payload, sc_core::sc_time& delay);

  bool carry_out_ahead(Payload& payload, sc_core::sc_time& delay);
  unsigned int carry_out_bytes_ahead(Payload& payload, sc_core::sc_time& delay);
  bool carry_out_byte_ahead(Payload& payload, unsigned int index, sc_core::sc_time& delay, bool with);
  template <class Socket>
  void serve(Socket& socket);
  template <class Socket>
  static void withdraw_dmi(Socket& socket);
  bool direct_mem_ptr(Payload& payload, tlm::tlm_dmi& dmi);
  /// In the middle of catch_up, or right after it.
  bool holds() const { return R_REQ.read() && R_STA.read() && chip().host_holds(); }
  bool gives_dmi() const { return gives_dmi_ && !hears_host() && !in_access() && holds(); }
  void end_dmi();
  bool may_access(std::uint16_t address);
  bool wait_for_hold(std::uint16_t address);
  void report_no_hold(std::uint16_t address) const;
  bool carry_out_with_core(Tick begin, Tick end, const HostAccess& access, Level& sampled);
  bool carry_out_alone(Tick begin, Tick end, const HostAccess& access, Level& sampled);
  bool is_private(Tick begin);
  void tell_whole(Tick begin, const HostAccess& access, Level sampled, Level address_before);
  void tell_access(const AccessReport& report);
  std::uint32_t asked_outputs() const;
  void watch_outputs(bool data);
  void carry_out(Payload& payload, unsigned int first);
  bool read_byte(std::uint16_t address, const AccessTiming& timing, unsigned char& byte);
  bool write_byte(std::uint16_t address, const AccessTiming& timing, unsigned char byte);
  void perform(bool write, std::uint16_t address, std::uint8_t value, const AccessTiming& timing);
  void move_access(Tick now);
  bool move_whole(Tick start);
  void begin_access(Tick start);

  void evaluate();
  bool nothing_arrives() const { return fired_as_scheduled() && scheduled() < arrivals_ && !in_access(); }
  void evaluate_core();
  void apply_line(Tick now);
  bool hears_host() const { return on_pin && (observed_ & kHostPins) != 0; }
  std::uint32_t told_pins() const { return (on_pin ? observed_ : 0) | observed_by_ports(); }
  bool tells_runs() const { return (told_pins() & mask(Pin::kPbrxd)) == 0; }
  bool in_run(Tick now) const { return now < run_end_; }
  bool line_level() const { return characters_level_ && far_level_ && (PBRXD.size() == 0 || PBRXD->read()); }
  bool line_is_stale(Tick now) const;
  void begin_run(Tick now);
  void stop_run(Tick now);
  void spell_out(const LineRun& run, Tick behind);
  void apply_inputs(Tick now);
  void apply(Tick now, Pin pin, bool level);
  void report_late(Pin pin, Tick at);
  /// `core`: the tick of the core's next evaluation.
  void plan(Tick now, Tick core);
  Tick next_of_line() const;

  void txd_changed(Tick at, bool level);
  void offer_answer();
  void end_answer(Tick at);
  Tick next_answered() const;
  void collect_character(Tick now);
  void tell_characters(Tick now);
  void put_on_line(const BusCharacter& character, Tick bit);
  bool put_in_run(const BusCharacter& character, Tick start, Tick bit);
  void take_back_last_run();

  AccessTiming timing_;
  Ownership ownership_;
  Tick hold_within_;
  bool gives_dmi_, dmi_given_ = false;
  // As found by plan(); 0: must be found again.
  Tick arrivals_ = 0;  ///< the next arrival at the chip, from the line or the host ...
  Tick others_ = 0;    ///< ... and the next event outside the core, which may be the end of a character of the chip
  std::uint32_t observed_, bound_ = 0;      ///< pins
  bool watches_data_ = false;               ///< of an access that is not carried out as a whole, for the ports
  std::uint32_t applied_ = 0;               ///< those of RESET, R_REQ, R_STA that are high for the core
  sc_core::sc_mutex host_bus_{"host_bus"};  ///< serialises the accesses of several initiators
  HostAccessMaker maker_;
  Tick host_free_at_ = 0;  ///< simulation tick: end of the last access carried out ahead
  bool late_reported_ = false;
  Tick access_start_ = 0;    ///< simulation tick of the running access' first edge
  HostAccess access_;        ///< the running access, without edges if there is none ...
  std::size_t moved_ = 0;    ///< ... how many of its edges have happened ...
  Level sampled_ = kLevelX;  ///< ... and the level of D

  CharacterInput line_{*this};
  std::deque<LineRun> runs_;      ///< characters of `bus_in` that have not begun and are not edges of `line_`
  LineRun run_;                   ///< the last of them that has begun, received as a run while `run_is_own_`
  bool run_is_own_ = false;       ///< else run_ comes from hear_run
  Tick run_end_ = 0;              ///< end of the core's present or last run
  bool characters_level_ = true;  ///< present level from the characters of `bus_in`
  bool far_level_ = true;         ///< of set_line
  bool may_hide_ = false, answer_waits_ = false;
  LineRun answer_;            ///< of the chip, while PBTXD is hidden
  std::size_t answered_ = 0;  ///< number of its completed characters
  CharacterCollector from_chip_;
  std::vector<LineCharacter> complete_;  ///< collected, to be sent through `bus_out` ...
  std::size_t emitted_ = 0;              ///< ... from this one on
};

}  // namespace dsdpv1::systemc
