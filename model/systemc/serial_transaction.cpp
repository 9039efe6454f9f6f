#include "model/systemc/serial_transaction.hpp"

#include <cstdint>
#include <vector>

namespace dsdpv1::systemc {
namespace {

std::vector<std::uint8_t> bytes_of(const tlm::tlm_generic_payload& payload) {
  return {payload.get_data_ptr(), payload.get_data_ptr() + payload.get_data_length()};
}

}  // namespace

tlm::tlm_response_status judge_stream(const tlm::tlm_generic_payload& payload) {
  const unsigned int length = payload.get_data_length();
  if (!payload.is_read() && !payload.is_write()) return tlm::TLM_COMMAND_ERROR_RESPONSE;
  if (length == 0 || payload.get_streaming_width() < length) return tlm::TLM_BURST_ERROR_RESPONSE;
  if (payload.get_address() != 0) return tlm::TLM_ADDRESS_ERROR_RESPONSE;
  if (payload.get_byte_enable_ptr() != nullptr) return tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE;
  return payload.get_data_ptr() != nullptr ? tlm::TLM_OK_RESPONSE : tlm::TLM_GENERIC_ERROR_RESPONSE;
}

SpiFrame frame_of(const tlm::tlm_generic_payload& payload, const SpiTiming& own) {
  const auto* special = payload.get_extension<SpiFrameExtension>();
  return special != nullptr ? SpiFrame(bytes_of(payload), special->timing, special->bits)
                            : SpiFrame(bytes_of(payload), own);
}

SpiFrame clocks_of(const tlm::tlm_generic_payload& payload, const SpiTiming& own) {
  const auto* special = payload.get_extension<SpiFrameExtension>();
  SpiFrameExtension bare;
  if (special != nullptr)
    bare = *special;
  else
    bare.timing = own;
  bare.timing.lead = bare.timing.low;
  bare.timing.lag = 0;
  return SpiFrame(bytes_of(payload), bare.timing, bare.bits);
}

Tick gap_of(const tlm::tlm_generic_payload& payload, const SpiTiming& own) {
  const auto* special = payload.get_extension<SpiFrameExtension>();
  return special != nullptr ? special->timing.gap : own.gap;
}

UartTelegram telegram_of(const tlm::tlm_generic_payload& payload, const UartTiming& own) {
  const auto* special = payload.get_extension<UartTelegramExtension>();
  return special != nullptr ? UartTelegram(bytes_of(payload), special->timing, special->faults)
                            : UartTelegram(bytes_of(payload), own);
}

}  // namespace dsdpv1::systemc
