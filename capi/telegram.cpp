#include "capi/telegram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "bus/telegram/explain.hpp"
#include "capi/names.hpp"
#include "capi/sized.hpp"

using capi::fail;
using capi::guarded;
using capi::need;

namespace dsdpv1::capi {
namespace {

std::optional<std::uint8_t> sap_of(const char* name, std::int16_t sap) {
  need_range(name, sap, DPSIM_NO_SAP, 255);
  if (sap == DPSIM_NO_SAP) return std::nullopt;
  return static_cast<std::uint8_t>(sap);
}

}  // namespace

bus::Telegram telegram_of(const dpsim_telegram& telegram) {
  const dpsim_telegram own = options_of(&telegram, "telegram");
  need_range("kind", own.kind, DPSIM_SD1, DPSIM_SC);
  need_range("da", own.da, 0, bus::kBroadcast);
  need_range("sa", own.sa, 0, bus::kBroadcast);
  need_range("data_size", own.data_size, 0, DPSIM_MAX_DATA);
  bus::Telegram made;
  made.kind = static_cast<bus::TelegramKind>(own.kind);
  made.da = own.da;
  made.sa = own.sa;
  made.fc = own.fc;
  made.dsap = sap_of("dsap", own.dsap);
  made.ssap = sap_of("ssap", own.ssap);
  made.data.assign(own.data, own.data + own.data_size);
  return made;
}

}  // namespace dsdpv1::capi

namespace {

std::int16_t sap_out(const std::optional<std::uint8_t>& sap) {
  return sap ? static_cast<std::int16_t>(*sap) : DPSIM_NO_SAP;
}

dpsim_telegram given(const bus::Telegram& telegram) {
  dpsim_telegram made{};
  made.kind = static_cast<dpsim_telegram_kind>(telegram.kind);
  made.da = telegram.da;
  made.sa = telegram.sa;
  made.fc = telegram.fc;
  made.dsap = sap_out(telegram.dsap);
  made.ssap = sap_out(telegram.ssap);
  made.data_size = static_cast<std::uint16_t>(telegram.data.size());
  std::copy(telegram.data.begin(), telegram.data.end(), made.data);
  return made;
}

bus::Decoded decode(const std::uint8_t* bytes, std::size_t count) {
  capi::need_buffer(bytes, count, "bytes");
  return bus::decode(count == 0 ? bus::Bytes{} : bus::Bytes(bytes, bytes + count));
}

std::string line_of(const bus::Decoded& decoded) {
  return decoded.error == bus::DecodeError::kNone ? bus::explain_line(decoded.telegram)
                                                  : "wrong telegram: " + std::string(bus::describe(decoded.error));
}

std::string bytes_of(const bus::Decoded& decoded, std::optional<bool> dpv1) {
  std::string text;
  for (const bus::ExplainedByte& byte : bus::explain_bytes(decoded, dpv1))
    text += fmt::format("{:4}  {:02X}  {}\n", byte.offset, byte.byte, byte.meaning);
  return text;
}

std::string words_of(const bus::Decoded& decoded, dpsim_explain_style style, std::optional<bool> dpv1) {
  if (style == DPSIM_EXPLAIN_BYTES) return bytes_of(decoded, dpv1);
  if (style == DPSIM_EXPLAIN_LINE) return line_of(decoded);
  return decoded.error == bus::DecodeError::kNone ? bus::explain_service(decoded.telegram) : "";
}

}  // namespace

dpsim_status dpsim_telegram_encode(const dpsim_telegram* telegram, uint8_t* bytes, size_t capacity, size_t* count) {
  return guarded(
      __func__,
      [&] {
        need(telegram, "telegram");
        need(count, "count");
        capi::need_buffer(bytes, capacity, "bytes");
        const bus::Bytes encoded = bus::encode(capi::telegram_of(*telegram));
        *count = encoded.size();
        if (encoded.size() > capacity)
          fail(DPSIM_ERR_SPACE, "the telegram has " + std::to_string(encoded.size()) + " bytes, capacity is " +
                                    std::to_string(capacity));
        std::copy(encoded.begin(), encoded.end(), bytes);
      });
}

dpsim_status dpsim_telegram_decode(const uint8_t* bytes, size_t count, dpsim_telegram* telegram,
                                   dpsim_decode_error* error, size_t* used) {
  return guarded(
      __func__,
      [&] {
        need(telegram, "telegram");
        need(error, "error");
        const bus::Decoded decoded = decode(bytes, count);
        capi::check_size(*telegram, "telegram");
        if (decoded.readable) capi::give(given(decoded.telegram), telegram, "telegram");
        *error = static_cast<dpsim_decode_error>(decoded.error);
        if (used != nullptr) *used = decoded.bytes.size();
      });
}

const char* dpsim_decode_error_text(dpsim_decode_error error) {
  return error > DPSIM_DECODE_OK && error <= DPSIM_DECODE_TRUNCATED
             ? bus::describe(static_cast<bus::DecodeError>(error))
             : "";
}

dpsim_status dpsim_telegram_explain(const uint8_t* bytes, size_t count, dpsim_explain_style style, int32_t dpv1,
                                    const char** text) {
  return guarded(
      __func__,
      [&] {
        need(text, "text");
        capi::need_range("style", style, DPSIM_EXPLAIN_LINE, DPSIM_EXPLAIN_BYTES);
        capi::need_range("dpv1", dpv1, -1, 1);
        thread_local std::string words;
        words = words_of(decode(bytes, count), style, dpv1 < 0 ? std::nullopt : std::optional<bool>(dpv1 != 0));
        *text = words.c_str();
      });
}
