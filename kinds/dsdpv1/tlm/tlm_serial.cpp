#include "kinds/dsdpv1/tlm/tlm_serial.hpp"

#include <utility>

#include "model/systemc/sim_time.hpp"

namespace dsdpv1::user_cpu {

using dsdpv1::systemc::SpiFrameExtension;
using dsdpv1::systemc::UartTelegramExtension;

// ------------------------------------------------------------------------------------------------------ transactions

template <class Extension>
void TlmSender<Extension>::begin(Tick at, tlm::tlm_command command, std::vector<std::uint8_t> bytes,
                                 const Extension& extension) {
  bytes_ = std::move(bytes);
  *extension_ = extension;
  payload_.set_command(command);
  payload_.set_data_ptr(bytes_.data());
  payload_.set_data_length(static_cast<unsigned>(bytes_.size()));
  payload_.set_streaming_width(static_cast<unsigned>(bytes_.size()));
  payload_.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
  start_.notify(dsdpv1::systemc::time_until(at));  // at least a delta cycle later
}

template <class Extension>
void TlmSender<Extension>::run() {
  for (;;) {
    wait(start_);
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    socket->b_transport(payload_, delay);
  }
}

template <class Extension>
void TlmSender<Extension>::reset() {
  start_.cancel();
  if (sc_core::sc_is_running()) thread_.reset();
}

// ------------------------------------------------------------------------------------------------------- controllers

namespace {

class TlmSpiMaster : public TlmTransfer<SpiMaster> {
 public:
  TlmSpiMaster(TlmSender<SpiFrameExtension>& sender, const SpiTiming& timing) : TlmTransfer(timing), sender_(sender) {}
  const std::vector<std::uint8_t>& received() const override { return sender_.bytes(); }

 private:
  void send(Tick at, std::vector<std::uint8_t> out, std::optional<std::size_t> bits) override {
    set_times(at, SpiFrame(out, timing(), bits).duration());
    out_ = std::move(out);
    bits_ = bits;
  }
  void start(Tick at) override {
    SpiFrameExtension extension;
    extension.timing = timing();
    extension.bits = bits_;
    sender_.begin(at, tlm::TLM_READ_COMMAND, std::move(out_), extension);
  }

  TlmSender<SpiFrameExtension>& sender_;
  std::vector<std::uint8_t> out_;
  std::optional<std::size_t> bits_;
};

class TlmUartSender : public TlmTransfer<UartSender> {
 public:
  TlmUartSender(TlmSender<UartTelegramExtension>& sender, const UartTiming& timing)
      : sender_(sender), timing_(timing) {}

 private:
  void send(Tick at, std::vector<std::uint8_t> bytes, const UartFaults& faults) override {
    set_times(at, UartTelegram(bytes, timing_, faults).duration());
    bytes_ = std::move(bytes);
    faults_ = faults;
  }
  void start(Tick at) override {
    UartTelegramExtension extension;
    extension.timing = timing_;
    extension.faults = faults_;
    sender_.begin(at, tlm::TLM_WRITE_COMMAND, std::move(bytes_), extension);
  }

  TlmSender<UartTelegramExtension>& sender_;
  UartTiming timing_;
  std::vector<std::uint8_t> bytes_;
  UartFaults faults_;
};

}  // namespace

TlmSerialPorts::TlmSerialPorts(const sc_core::sc_module_name& name, dsdpv1::systemc::RsuTlmModule& chip)
    : sc_module(name) {
  spi_.socket.bind(chip.spi_socket);
  uart_.socket.bind(chip.uart_socket);
}

std::unique_ptr<SpiMaster> TlmSerialPorts::make_spi_master(const SpiTiming& timing) {
  return std::make_unique<TlmSpiMaster>(spi_, timing);
}

std::unique_ptr<UartSender> TlmSerialPorts::make_uart_sender(const UartTiming& timing) {
  return std::make_unique<TlmUartSender>(uart_, timing);
}

void TlmSerialPorts::reset() {
  spi_.reset();
  uart_.reset();
}

}  // namespace dsdpv1::user_cpu
