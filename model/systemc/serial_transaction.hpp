#pragma once
// Transactions of a user CPU for the serial ports of a DSDPV1-RSU: requirements for their payloads, and per-transaction
// options. A payload frees its remaining extensions at the end: clear one that is not on the heap.
#include <tlm.h>

#include <cstddef>
#include <optional>

#include "model/dsdpv1/serial_host.hpp"

namespace dsdpv1::systemc {

/// Gives one frame of SPI its own timing, or an early end.
struct SpiFrameExtension : tlm::tlm_extension<SpiFrameExtension> {
  SpiTiming timing;
  std::optional<std::size_t> bits;  ///< XSS rises after so many bits
  tlm::tlm_extension_base* clone() const override { return new SpiFrameExtension(*this); }
  void copy_from(const tlm::tlm_extension_base& other) override {
    *this = static_cast<const SpiFrameExtension&>(other);
  }
};

/// Gives one telegram of the UART its own timing, or faults.
struct UartTelegramExtension : tlm::tlm_extension<UartTelegramExtension> {
  UartTiming timing;
  UartFaults faults;
  tlm::tlm_extension_base* clone() const override { return new UartTelegramExtension(*this); }
  void copy_from(const tlm::tlm_extension_base& other) override {
    *this = static_cast<const UartTelegramExtension&>(other);
  }
};

/// TLM_OK_RESPONSE for a valid stream of bytes (docs/systemc.md has the others).
tlm::tlm_response_status judge_stream(const tlm::tlm_generic_payload& payload);

/// The payload's data on the pins, with the timing of its extension, or `own`. The payload must be a valid stream.
SpiFrame frame_of(const tlm::tlm_generic_payload& payload, const SpiTiming& own);
/// The same without XSS's times: the first clock is half a bit after the begin, and nothing follows the last.
SpiFrame clocks_of(const tlm::tlm_generic_payload& payload, const SpiTiming& own);
Tick gap_of(const tlm::tlm_generic_payload& payload, const SpiTiming& own);
UartTelegram telegram_of(const tlm::tlm_generic_payload& payload, const UartTiming& own);

}  // namespace dsdpv1::systemc
