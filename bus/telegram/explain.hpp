#pragma once
// Telegrams in words: one line for logs, or byte by byte. Field names are those of EN 50170 and of the datasheet's
// tables 18 to 33.
#include <cstddef>
#include <iosfwd>
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

/// "1 -> 3  SRD high FCB=1 FCV=1  Slave_Diag request": addresses, function code, service and its essentials.
std::string explain_line(const Telegram& telegram);
/// The service that a telegram with an address belongs to: "Slave_Diag"; empty for FDL status and the like.
std::string explain_service(const Telegram& telegram);
/// Every byte of one telegram; nothing when there is none. A wrong telegram is explained as far as it was understood;
/// its last line says what is wrong. `dpv1`: whether the answering slave is parameterised for DPV1, which decides how a
/// device related diagnosis is read; unset: both ways.
std::vector<ExplainedByte> explain_bytes(const Decoded& decoded, std::optional<bool> dpv1 = {});
/// What a Set_Prm that locks its slave says about DPV1; nothing for any other telegram.
std::optional<bool> dpv1_enabled(const Telegram& telegram);

/// The function code in words: "request SRD high FCB=0 FCV=1" or "response DH passive station".
std::string explain_fc(std::uint8_t fc);

/// What `dsdpv1-sim decode` prints. Reads hexadecimal text: two digits a byte, any spacing, commas, optional 0x before
/// each byte, comments from # or ; to the end of the line. Telegrams may be one a line or follow each other; bytes
/// between them are reported as garbage and skipped up to the next byte at which a right telegram begins. Also reads
/// the log of a run, text or JSON lines: of a line that tells a telegram its bytes are taken, all other lines of a log
/// are passed over. Returns 0, 1 when something was garbage or no telegram, 2 when the text is not hexadecimal: then
/// nothing is written to `out` and `error` is "name:line: what is wrong, what is allowed".
int decode_text(std::istream& in, const std::string& name, std::ostream& out, std::string& error);

}  // namespace dsdpv1::bus
