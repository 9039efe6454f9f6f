#pragma once
// A chip of the SPC3 family as a SystemC module with TLM-2.0 sockets: registers and RAM as a target socket, the bus as
// characters.
//
//   dsdpv1::systemc::Spc3TlmModule chip("chip");
//   cpu.socket.bind(chip.host_socket);
//   chip.RESET(reset); chip.X_INT(x_int);
//   chip.bus_out.bind(master);                   // tlm_analysis_if<BusCharacter>
//   master_port.bind(chip.bus_in);
//
// Ports, timing and examples: docs/systemc.md.
#include <tlm_utils/simple_target_socket.h>

#include <cstdint>
#include <deque>
#include <string>
#include <systemc>

#include "model/systemc/bus_character.hpp"
#include "model/systemc/line_station.hpp"
#include "model/systemc/optional_port.hpp"
#include "model/systemc/spc3_module.hpp"
#include "model/systemc/transaction.hpp"

namespace dsdpv1::systemc {

struct Spc3TlmOptions : Spc3Options {
  /// Ticks (>= 0) that an access of one byte takes, its effect at the end (A16). No source: 166.7 ns, as the bench's
  /// user CPU.
  Tick access = 2000;
};

/// Gives one transaction another length of its accesses. A payload frees its remaining extensions at the end: clear one
/// that is not on the heap.
struct RegisterAccessExtension : tlm::tlm_extension<RegisterAccessExtension> {
  Tick access = 0;  ///< ticks of a byte, >= 0
  tlm::tlm_extension_base* clone() const override { return new RegisterAccessExtension(*this); }
  void copy_from(const tlm::tlm_extension_base& other) override {
    *this = static_cast<const RegisterAccessExtension&>(other);
  }
};

class Spc3TlmModule : public Spc3Module, public LineStation, private tlm::tlm_analysis_if<BusCharacter> {
 public:
  using In = sc_core::sc_in<bool>;
  using OptionalIn = systemc::OptionalIn;
  using OptionalOut = systemc::OptionalOut;

  /// Registers and RAM, 0x000..0x7FF (VPC3+: 0xFFF), in Intel order. Every byte of a transaction is one access of
  /// `Spc3TlmOptions::access`, in the order of the addresses; its time passes inside b_transport. A read may be a
  /// command.
  ///   data length 0, streaming width less than the length    TLM_BURST_ERROR_RESPONSE
  ///   byte enables: any pattern of 0x00 and 0xFF; others     TLM_BYTE_ENABLE_ERROR_RESPONSE
  ///   a byte outside these addresses                         TLM_ADDRESS_ERROR_RESPONSE, nothing accessed
  ///   neither read nor write                                 TLM_COMMAND_ERROR_RESPONSE
  ///   the chip is in reset                                   TLM_GENERIC_ERROR_RESPONSE, the burst ends there
  /// An access beyond the RAM is carried out: a violation (A3). With a global quantum (tlm_global_quantum) other than
  /// zero, b_transport does not wait for an access before whose end neither the chip nor another process does anything:
  /// the time is added to the returned delay. An initiator must wait for its delay before it moves RESET or XCTS, or
  /// samples an output. Debug transport reads and writes by peek() and poke(); direct memory access is denied. Must be
  /// bound (error /dsdpv1/binding), or one of the next two.
  tlm_utils::simple_target_socket_optional<Spc3TlmModule> host_socket{"host_socket"};
  /// The same for initiators of another BUSWIDTH.
  tlm_utils::simple_target_socket_optional<Spc3TlmModule, 64> host_socket_64{"host_socket_64"};
  tlm_utils::simple_target_socket_optional<Spc3TlmModule, 8> host_socket_8{"host_socket_8"};

  In RESET{"RESET"};           ///< high-active
  OptionalIn XCTS{"XCTS"};     ///< unbound: low, clear to send
  OptionalOut X_INT{"X_INT"};  ///< active level: INT_Pol
  OptionalOut XDATAEXCH{"XDATAEXCH"};

  /// As those of TlmModule; TXD, RTS and RXD are the raw line.
  sc_core::sc_export<tlm::tlm_analysis_if<BusCharacter>> bus_in{"bus_in"};
  ListenedPort<BusCharacter> bus_out{"bus_out"};
  OptionalIn RXD{"RXD"};
  OptionalOut TXD{"TXD"}, RTS{"RTS"};

  explicit Spc3TlmModule(const sc_core::sc_module_name& name, const Spc3TlmOptions& options = {});

  /// As TlmModule::sync.
  void sync(const sc_core::sc_time& ahead = sc_core::SC_ZERO_TIME);

  // As a station of a line; RTS is its enable, TXD its input. Runs are refused while `on_pin` is set, or
  // `pin_changes` reports the line.
  void set_line(bool level) override;
  bool hear_run(const profibus::CharacterRun& run) override;
  void leave_run() override;
  void show_txd() override;

 private:
  using Payload = tlm::tlm_generic_payload;

  void start_of_simulation() override;
  template <class Socket>
  void serve(Socket& socket);
  void write(const BusCharacter& character) override;  // bus_in
  void b_transport(Payload& payload, sc_core::sc_time& delay);
  unsigned int transport_dbg(Payload& payload);
  unsigned int carry_out_ahead(Payload& payload, sc_core::sc_time& delay);
  bool is_unseen(Tick end);
  void carry_out(Payload& payload, unsigned int first);
  void access(Payload& payload, unsigned int index, Tick at, bool ahead);
  Tick length_of(const Payload& payload) const;

  void evaluate();
  Tick catch_up();
  void plan();
  bool line_level() const { return characters_level_ && far_level_ && (RXD.size() == 0 || RXD->read()); }
  bool in_run(Tick now) const { return now < run_end_; }
  void apply_line(Tick now);
  void leave_run(Tick now);
  bool tells(Pin pin) const { return on_pin || (observed_by_ports() & mask(pin)) != 0; }
  bool hides_answers() const { return on_answer && !tells(Pin::kTxd) && TXD.size() == 0 && !bus_out.bound(); }
  void offer_answer();
  void drive_line();
  Tick next_driven() const { return driven_.empty() ? profibus::kNever : driven_.front().at; }
  bool output_changed(Tick at, spc3::Pin pin, spc3::Level level) override;
  void heard(const profibus::Event& event) override;
  const char* title() const override { return "Spc3TlmModule"; }
  bool is_busy() override { return is_taken(host_bus_); }
  void settle() override;
  template <class Archive>
  void store(Archive& archive) {
    archive(characters_level_, line_, from_chip_);
    archive.ticks(taken_);
  }
  void store_module(profibus::StateWriter& archive) override { store(archive); }
  void store_module(profibus::StateReader& archive) override { store(archive); }
  void tell_characters(Tick now);

  sc_dt::uint64 size_;  ///< addresses
  Tick access_;
  sc_core::sc_mutex host_bus_{"host_bus"};  ///< serialises the accesses of several initiators
  std::uint32_t bound_ = 0;                 ///< outputs
  bool in_reset_ = false;                   ///< an access has met RESET
  Tick taken_ = 0;                          ///< the edge that takes the last access
  bool seen_ = false;                       ///< an output has changed, or an event happened
  CharacterInput line_{*this};
  bool characters_level_ = true;  ///< present level from the characters of `bus_in`
  CharacterCollector from_chip_;
  std::deque<LineCharacter> complete_;  ///< collected, to be sent through `bus_out`

  struct Driven {
    Tick at;
    Pin pin;
    bool level;
  };
  bool far_level_ = true;      ///< of set_line
  Tick run_end_ = 0;           ///< of the run of hear_run
  bool answer_waits_ = false;  ///< until the core is idle
  std::deque<Driven> driven_;  ///< of TXD and RTS, for on_txd and on_rts; may be ahead of simulation time
};

}  // namespace dsdpv1::systemc
