#pragma once
// Converts transactions to the pins of an SPI port: connects a controller, of whole frames or of single bytes, to the
// pins of a chip, or to RTL.
//
//   dsdpv1::systemc::SpiPins spi("spi");
//   controller.socket.bind(spi.socket);
//   spi.XSS(xss), spi.SCK(sck), spi.MOSI(mosi), spi.MISO(miso);        // and the same signals at the chip
#include <tlm_utils/simple_target_socket.h>

#include <cstddef>
#include <systemc>

#include "model/systemc/serial_transaction.hpp"
#include "model/systemc/sim_time.hpp"
#include "model/systemc/spi_select.hpp"

namespace dsdpv1::systemc {

/// As RsuTlmModule::spi_socket, with the same pin timing: each transaction is a frame, or, with CS bound or once set_cs
/// is called, moves only SCK and MOSI, and XSS follows that line.
class SpiPins : public sc_core::sc_module {
 public:
  /// Each transaction is a synchronisation point, with any quantum. One whose initiator is reset or killed runs to its
  /// end. No debug transport, no DMI.
  tlm_utils::simple_target_socket<SpiPins> socket{"socket"};
  /// The controller's slave select, low-active; initialise its signal to 1. As RsuTlmModule::XSS.
  sc_core::sc_port<sc_core::sc_signal_in_if<bool>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> CS{"CS"};
  /// As RsuTlmModule::set_xss.
  void set_cs(bool level);

  sc_core::sc_out<bool> XSS{"XSS"};                ///< low-active
  sc_core::sc_out<bool> SCK{"SCK"}, MOSI{"MOSI"};  ///< mode 0
  sc_core::sc_in<sc_dt::sc_logic> MISO{"MISO"};    ///< Z and X read as 1

  explicit SpiPins(const sc_core::sc_module_name& name, const SpiTiming& timing = {});

 private:
  void b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
  void carry_out(SpiFrame frame, Tick begin);
  bool selects_by_line() const { return by_line_ || CS.size() > 0; }
  bool is_busy() const { return moved_ < frame_.size(); }
  Tick next_edge() const { return is_busy() ? begin_ + frame_[moved_].at : profibus::kNever; }
  void select();
  void play();
  void move(const SerialEdge& edge);

  SpiTiming timing_;
  sc_core::sc_mutex bus_{"bus"};  ///< serialises the transactions of several initiators
  SpiSelect select_;
  bool by_line_ = false;   ///< set_cs has been called
  SpiFrame frame_;         ///< the running one ...
  std::size_t moved_ = 0;  ///< ... the number of its edges that have happened ...
  Tick begin_ = 0;         ///< ... and its begin
  Tick free_at_ = 0;       ///< end of the gap after the last frame
  sc_core::sc_event due_{"due"}, soon_{"soon"}, end_{"end"};
};

}  // namespace dsdpv1::systemc
