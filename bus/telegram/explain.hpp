#pragma once
// Telegrams as text: one line for logs, or byte by byte. Field names are those of EN 50170 and of the datasheet's
// tables 18 to 33.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bus/bytes.hpp"
#include "bus/telegram/telegram.hpp"

namespace dsdpv1::bus {

struct ExplainedByte {
  std::size_t offset = 0;
  std::uint8_t byte = 0;
  std::string meaning;
};

/// Facts about a telegram from others (ExplainMemory).
struct ExplainContext {
  // NOLINTNEXTLINE(google-explicit-constructor): a DPV1 setting alone is a context
  ExplainContext(std::optional<bool> setting = {}) : dpv1(setting) {}
  /// Whether the answering slave is parameterised for DPV1, which decides how a device related diagnosis is read;
  /// unset: both ways.
  std::optional<bool> dpv1;
  bool msac2 = false;  ///< an Initiate has opened the connection between its two SAPs
};

/// "1 -> 3  SRD high FCB=1 FCV=1  Slave_Diag request": addresses, function code, service and its essentials.
std::string explain_line(const Telegram& telegram, const ExplainContext& context = {});
/// The service of a telegram with an address: "Slave_Diag"; empty for FDL status and the like.
std::string explain_service(const Telegram& telegram, const ExplainContext& context = {});
/// Every byte of one telegram; empty without one. An invalid telegram is explained as far as it was understood; the
/// last line names the fault.
std::vector<ExplainedByte> explain_bytes(const Decoded& decoded, const ExplainContext& context = {});
/// The DPV1 setting in a Set_Prm that locks its slave; nullopt for any other telegram.
std::optional<bool> dpv1_enabled(const Telegram& telegram);

/// The function code as text: "request SRD high FCB=0 FCV=1" or "response DH passive station".
std::string explain_fc(std::uint8_t fc);

}  // namespace dsdpv1::bus
