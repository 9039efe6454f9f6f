#pragma once
// Tables of characters, as logic analysers export what their decoder of a serial line has found.
#include <string>
#include <vector>

#include "bus/capture/csv_cells.hpp"
#include "bus/capture/logic_decoder.hpp"

namespace dsdpv1::bus::capture {

/// The columns of such a table. Logic 1: "Time [s],Value,Parity Error,Framing Error"; Logic 2:
/// "name,type,start_time,duration,data,error".
struct CharacterColumns {
  std::size_t time = 0, value = 0;
  std::size_t parity = 0, framing = 0;  ///< not empty, 0 or false: such an error
  std::size_t error = 0;                ///< the error in words
};

/// nullopt for other headings.
std::optional<CharacterColumns> character_columns(const std::vector<std::string>& headings);

/// The telegrams of the rows after the headings: each character as its levels on the line, with the wrong parity or
/// stop bit that the decoder found. The rate is that of `settings`, else the one with characters of 11 bits of the
/// least distance between two starts. Throws CaptureError.
LogicSource read_characters(CsvLines& lines, const CharacterColumns& columns, const LogicSettings& settings,
                            const TakeTelegram& take);

}  // namespace dsdpv1::bus::capture
