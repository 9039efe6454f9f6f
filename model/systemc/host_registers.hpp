#pragma once
// The wires between a chip and its user CPU as registers, for platforms whose CPU has only a bus.
//
//   dsdpv1::systemc::HostRegisters registers("registers", {0x1000});
//   bus.bind(registers.socket);
//   registers.connect(chip);                     // TlmModule, PinModule or RTL with these ports
//   interrupts.bind(registers.IRQ);
//
// Addresses, bits and time: docs/systemc.md.
#include <tlm.h>
#include <tlm_utils/simple_target_socket.h>

#include <cstdint>
#include <systemc>
#include <vector>

#include "model/systemc/sim_time.hpp"
#include "model/systemc/transaction.hpp"

namespace dsdpv1::systemc {

struct HostRegistersOptions {
  sc_dt::uint64 base = 0;  ///< address of the first register
  /// Ticks (>= 0) of a transaction. No source: 14 ns, as DriverCpuOptions::pin_write.
  Tick access = 168;
};

/// Four words, little endian, of which only the lowest byte has bits:
///   base + 0x0  kRequest    read, write   bit 0 R_REQ, bit 1 R_STA
///   base + 0x4  kState      read          bit 0 L_REQ, bit 1 L_STA, bit 2 INTR0
///   base + 0x8  kInterrupt  read, write   bit 0: INTR0 has fallen; a write of 1 clears it
///   base + 0xC  kReset      read, write   bit 0 RESET
/// All are 0 at first, so RESET is low. A write of other bits, and of kState, has no effect.
///
/// Each transaction is a synchronisation point, with any quantum: b_transport waits for the annotated delay and for
/// `access`. It then reads the signals, or returns when those that it has written have their level.
class HostRegisters : public sc_core::sc_module {
 public:
  enum Register : std::uint8_t { kRequest = 0, kState = 4, kInterrupt = 8, kReset = 12 };
  static constexpr sc_dt::uint64 kSize = 16;
  static constexpr std::uint8_t kReq = 1, kSta = 2;                ///< of kRequest
  static constexpr std::uint8_t kLReq = 1, kLSta = 2, kIntr0 = 4;  ///< of kState

  /// Responses as those of TlmModule::host_socket. Debug transport reads, and writes without time; no DMI.
  tlm_utils::simple_target_socket_optional<HostRegisters> socket{"socket"};
  /// The same for initiators of another BUSWIDTH.
  tlm_utils::simple_target_socket_optional<HostRegisters, 64> socket_64{"socket_64"};
  tlm_utils::simple_target_socket_optional<HostRegisters, 8> socket_8{"socket_8"};

  sc_core::sc_signal<bool> R_REQ{"R_REQ"}, R_STA{"R_STA"}, RESET{"RESET"};  ///< to the chip
  sc_core::sc_signal<bool> L_REQ{"L_REQ"}, L_STA{"L_STA"};                  ///< from the chip
  sc_core::sc_signal<bool> INTR0{"INTR0", true};                            ///< from the chip; a fall is the interrupt
  /// High while bit 0 of kInterrupt is 1: for an interrupt controller of levels. One of edges may take INTR0.
  sc_core::sc_signal<bool> IRQ{"IRQ"};

  explicit HostRegisters(const sc_core::sc_module_name& name, const HostRegistersOptions& options = {});

  /// Binds the ports of `chip` to the signals.
  template <class Chip>
  void connect(Chip& chip) {
    chip.RESET(RESET), chip.R_REQ(R_REQ), chip.R_STA(R_STA);
    chip.L_REQ(L_REQ), chip.L_STA(L_STA), chip.INTR0(INTR0);
  }

  /// As SavedModule::save() and restore(); the signals follow in the next delta cycle.
  std::vector<std::uint8_t> save();
  void restore(const std::vector<std::uint8_t>& state);

 private:
  using Payload = tlm::tlm_generic_payload;

  template <class Archive>
  void store(Archive& archive) {
    archive(request_, reset_, interrupt_);
  }
  template <class Socket>
  void serve(Socket& target);
  void b_transport(Payload& payload, sc_core::sc_time& delay);
  unsigned int transport_dbg(Payload& payload);
  void access(Payload& payload, unsigned int index);
  std::uint8_t read(sc_dt::uint64 offset) const;
  void write(sc_dt::uint64 offset, std::uint8_t value);
  void intr0_fell();
  void drive();

  HostRegistersOptions options_;
  std::uint8_t request_ = 0, reset_ = 0;
  bool interrupt_ = false;
  sc_core::sc_event written_{"written"};
};

}  // namespace dsdpv1::systemc
