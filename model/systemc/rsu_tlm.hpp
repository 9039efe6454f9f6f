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
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <initializer_list>

#include "model/dsdpv1/serial_host.hpp"
#include "model/systemc/dsdpv1_tlm.hpp"
#include "model/systemc/serial_transaction.hpp"
#include "model/systemc/spi_select.hpp"

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
  /// The right bytes that the chip sends on TXD, each at the end of its stop bit.
  ListenedPort<std::uint8_t> uart_out{"uart_out"};

  /// For SPI controllers that transfer byte by byte. With XSS bound, or once set_xss is called, a transaction moves
  /// only SCK and MOSI, for any number of bytes, and XSS follows this line, low-active: at its time, but not earlier
  /// than `SpiTiming::lag` after SCK's last fall, `gap` high; the first clock is `lead` after its fall (SpiSelect).
  /// Initialise a signal to 1. A transfer while XSS is high receives FF.
  OptionalIn XSS{"XSS"};
  /// The same as a call, for lines that are functions: each change counts, also at one time.
  void set_xss(bool level);

  /// For UARTs that send byte by byte: characters to RXD, each at its start or after the one before. `bit` 0: the rate
  /// of `RsuTlmOptions::uart`. A wrong parity, a missing stop bit and a break (is_break) go out as they are.
  sc_core::sc_export<tlm::tlm_analysis_if<BusCharacter>> uart_in{"uart_in"};
  /// Characters of `uart_in` that have not begun.
  std::size_t uart_waiting() const;
  /// The last character of `uart_in` has ended.
  const sc_core::sc_event& uart_idle_event() const { return uart_idle_; }
  /// Every character that the chip sends on TXD, with its errors, at the end of its stop bit.
  ListenedPort<BusCharacter> uart_characters{"uart_characters"};

  explicit RsuTlmModule(const sc_core::sc_module_name& name, const RsuTlmOptions& options = {});

 private:
  /// Edges of a frame or telegram that move the pins at their ticks.
  template <class Edges>
  struct Lane {
    Edges edges = {};
    std::size_t moved = 0;  ///< number of applied edges; all of them: idle
    Tick begin = 0;         ///< the chip's tick
    bool is_busy() const { return moved < edges.size(); }
    Tick next() const { return is_busy() ? begin + edges[moved].at : profibus::kNever; }
  };

  void check_binding() override;
  const char* title() const override { return "RsuTlmModule"; }
  bool is_busy() override { return TlmModule::is_busy() || is_taken(spi_bus_) || is_taken(uart_bus_); }
  template <class Archive>
  void store(Archive& archive);
  void store_module(profibus::StateWriter& archive) override;
  void store_module(profibus::StateReader& archive) override;
  std::uint32_t heard_outputs() const override {
    return uart_out.bound() || uart_characters.bound() ? mask(Pin::kTxd) : 0;
  }
  bool output_changed(Tick at, Pin pin, Level level) override;
  void move_host(Tick now) override;
  void tell_host(Tick now) override;
  Tick next_of_host() const override {
    return std::min({spi_.next(), uart_.next(), select_.next(), to_uart_.next(), from_uart_.next()});
  }

  /// uart_in, which needs an own interface beside that of bus_in.
  class UartInput : public tlm::tlm_analysis_if<BusCharacter> {
   public:
    explicit UartInput(RsuTlmModule& module) : module_(module) {}
    void write(const BusCharacter& character) override { module_.send(character); }

   private:
    RsuTlmModule& module_;
  };

  void send(const BusCharacter& character);
  bool selects_by_line() const { return by_line_ || XSS.size() > 0; }
  void select();
  void move_xss(bool level);
  void transport_spi(Payload& payload, sc_core::sc_time& delay);
  void transfer_frame(Payload& payload);
  void transfer_bytes(Payload& payload);
  void transport_uart(Payload& payload, sc_core::sc_time& delay);
  template <class Edges>
  void carry_out(Lane<Edges>& lane, Edges edges, Tick begin);
  void move_pins(Tick now);
  void set_rxd(Tick at);
  void release(std::initializer_list<PinLevel> pins);
  void collect_byte(Tick now);

  RsuStraps straps_;
  SpiTiming spi_timing_;
  UartTiming uart_timing_;
  sc_core::sc_mutex spi_bus_{"spi_bus"}, uart_bus_{"uart_bus"};  ///< serialise the transactions of several initiators
  Lane<SpiFrame> spi_;
  Lane<UartTelegram> uart_;
  Tick spi_free_at_ = 0;  ///< simulation tick: end of the gap after the last frame
  std::exception_ptr thrown_;
  SpiSelect select_;
  bool by_line_ = false;  ///< set_xss has been called
  UartInput uart_input_{*this};
  EdgeQueue to_uart_;  ///< of the characters of uart_in ...
  /// Characters of uart_in without a gap; their bits are counted from the first, so that nothing drifts.
  struct Series {
    Tick begin = 0;
    int bits = 0;
    sc_core::sc_time bit;
  };
  Series series_;
  Tick to_uart_end_ = 0;                         ///< ... whose last one ends here
  std::deque<Tick> begins_;                      ///< of those that may not have begun
  bool rxd_lane_ = true, rxd_character_ = true;  ///< levels of the telegram and of the characters
  sc_core::sc_event uart_idle_{"uart_idle"};
  CharacterCollector from_uart_;
  std::deque<LineCharacter> received_;  ///< from TXD, to be sent through `uart_out` and `uart_characters`
};

}  // namespace dsdpv1::systemc
