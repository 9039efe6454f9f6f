// A telegram: decoded, in words, printed; encoded again it has the same bytes.
#include "bus/telegram/telegram.hpp"

#include <sstream>

#include "bus/capture/telegram_printer.hpp"
#include "bus/telegram/explain_memory.hpp"
#include "tests/fuzz/input.hpp"

namespace dsdpv1 {
namespace {

/// A token has no SAPs: bit 7 of its addresses is ignored.
bus::Bytes without_extensions(const bus::Decoded& decoded) {
  bus::Bytes bytes = decoded.bytes;
  if (decoded.telegram.kind == bus::TelegramKind::kSd4)
    for (std::size_t i = 1; i < bytes.size(); ++i) bytes[i] &= 0x7F;
  return bytes;
}

void explain(const bus::Decoded& decoded) {
  for (const std::optional<bool> dpv1 : {std::optional<bool>(), std::optional<bool>(true), std::optional<bool>(false)})
    fuzz::promise(bus::explain_bytes(decoded, dpv1).size() >= decoded.bytes.size(), "each byte is explained");
  if (!decoded.readable) return;
  bus::explain_line(decoded.telegram);
  bus::explain_service(decoded.telegram);
}

void print(const bus::Decoded& decoded, const bus::Bytes& all) {
  std::ostringstream out;
  bus::capture::CapturedTelegram telegram;
  telegram.bytes = all;
  const std::string wrong = bus::capture::what_is_wrong(telegram, decoded);
  bus::ExplainMemory memory;
  const auto context = wrong.empty() ? memory.take(decoded.telegram) : bus::ExplainContext();
  bus::capture::TelegramPrinter(out).print(telegram, decoded, wrong, context);
  fuzz::promise(!out.str().empty(), "a telegram is printed");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const bus::Bytes bytes(data, data + size);
  const bus::Decoded decoded = bus::decode(bytes);
  fuzz::promise(decoded.bytes.size() <= size, "no byte is made up");
  explain(decoded);
  print(decoded, bytes);
  if (decoded.error == bus::DecodeError::kNone)
    fuzz::promise(bus::encode(decoded.telegram) == without_extensions(decoded),
                  "a right telegram is encoded as it was");
  fuzz::promise(
      bus::is_telegram(data, size) == (decoded.error == bus::DecodeError::kNone && decoded.bytes.size() == size),
      "is_telegram says what decode does");
  return 0;
}

}  // namespace dsdpv1
