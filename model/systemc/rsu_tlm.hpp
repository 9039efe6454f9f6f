#pragma once
// The DSDPV1-RSU as a SystemC module with TLM-2.0 sockets: TlmModule with an additional socket each for SPI and UART.
// Straps are options.
//
//   dsdpv1::systemc::RsuTlmOptions options;
//   options.straps.mode = dsdpv1::HostMode::kSpi;
//   dsdpv1::systemc::RsuTlmModule chip("chip", options);
//   cpu.socket.bind(chip.spi_socket);            // host_socket and uart_socket stay unbound
//   chip.RESET(reset); chip.R_REQ(r_req); ...    // as TlmModule
//
// Ports, timing and examples: docs/systemc.md.
#include <algorithm>
#include <cstdint>
#include <exception>
#include <initializer_list>
#include <vector>

#include "model/dsdpv1/serial_host.hpp"
#include "model/systemc/dsdpv1_tlm.hpp"
#include "model/systemc/serial_transaction.hpp"

namespace dsdpv1::systemc {

/// Levels of the pins MODE, ADR, UBR and UIV (R11), which never change.
struct RsuStraps {
  HostMode mode = HostMode::kParallel;
  int address = 1;    ///< ADR, 0..3: the card's address, 1 or 2
  int uart_rate = 7;  ///< UBR, 0..7: UA1
  int interval = 0;   ///< UIV, 0..7: UA3
};

struct RsuTlmOptions : TlmOptions {
  RsuTlmOptions() {
    chip.part = Part::kRsu;
    observed |= kRsuOutputPins;
  }
  RsuStraps straps{};
  SpiTiming spi{};    ///< of the host's frames
  UartTiming uart{};  ///< of the host's telegrams; its `baud` need not be that of the straps
};

class RsuTlmModule : public TlmModule {
 public:
  /// Each transaction is one frame of XSS, mode 0, MSB first: its data are sent on MOSI and, for a read, replaced by
  /// the bytes received on MISO (FF where the chip does not drive it). The time passes inside b_transport, which
  /// returns when XSS rises; the next frame waits for the rest of the gap.
  ///   address other than 0                                   TLM_ADDRESS_ERROR_RESPONSE
  ///   data length 0, streaming width less than the length    TLM_BURST_ERROR_RESPONSE
  ///   byte enables                                           TLM_BYTE_ENABLE_ERROR_RESPONSE
  ///   neither read nor write                                 TLM_COMMAND_ERROR_RESPONSE
  ///   no data pointer                                        TLM_GENERIC_ERROR_RESPONSE
  /// Each is a synchronisation point, with any quantum. Debug transport reads and writes the DPRAM, as with
  /// `host_socket`.
  tlm_utils::simple_target_socket_optional<RsuTlmModule> spi_socket{"spi_socket"};
  /// Each write is one telegram on RXD: characters without a pause except `UartTiming::gap`; b_transport returns at the
  /// end of the last stop bit. A read gets TLM_COMMAND_ERROR_RESPONSE; the other responses, and debug transport, are as
  /// for `spi_socket`.
  tlm_utils::simple_target_socket_optional<RsuTlmModule> uart_socket{"uart_socket"};
  /// The bytes that the chip sends on TXD, each at the end of its stop bit.
  ListenedPort<std::uint8_t> uart_out{"uart_out"};

  explicit RsuTlmModule(const sc_core::sc_module_name& name, const RsuTlmOptions& options = {});

 private:
  /// Edges of a frame or telegram that move the pins at their ticks.
  template <class Edges>
  struct Lane {
    Edges edges = {};
    std::size_t moved = 0;  ///< number of applied edges; all of them: idle
    Tick begin = 0;         ///< the chip's tick
    Tick next() const { return moved < edges.size() ? begin + edges[moved].at : profibus::kNever; }
  };

  void check_binding() override;
  std::uint32_t heard_outputs() const override { return uart_out.bound() ? mask(Pin::kTxd) : 0; }
  bool output_changed(Tick at, Pin pin, Level level) override;
  void move_host(Tick now) override;
  void tell_host(Tick now) override;
  Tick next_of_host() const override { return std::min({spi_.next(), uart_.next(), from_uart_.next()}); }

  void transport_spi(Payload& payload, sc_core::sc_time& delay);
  void transport_uart(Payload& payload, sc_core::sc_time& delay);
  template <class Edges>
  void carry_out(Lane<Edges>& lane, Edges edges, Tick begin);
  void move_pins(Tick now);
  void release(std::initializer_list<Pin> pins);
  void collect_byte(Tick now);

  RsuStraps straps_;
  SpiTiming spi_timing_;
  UartTiming uart_timing_;
  sc_core::sc_mutex spi_bus_{"spi_bus"}, uart_bus_{"uart_bus"};  ///< serialise the transactions of several initiators
  Lane<SpiFrame> spi_;
  Lane<UartTelegram> uart_;
  Tick spi_free_at_ = 0;  ///< simulation tick: end of the gap after the last frame
  std::exception_ptr thrown_;
  CharacterCollector from_uart_;
  std::vector<std::uint8_t> received_;  ///< from TXD, to be sent through `uart_out`
};

}  // namespace dsdpv1::systemc
