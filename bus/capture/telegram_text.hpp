#pragma once
// Reads bytes of telegrams from text: hexadecimal in any spacing, the telegrams of a log of dsdpv1-sim, as text or JSON
// lines, or a log of another program with bytes in its lines.
#include <cstddef>
#include <iosfwd>
#include <map>
#include <optional>
#include <vector>

#include "bus/bytes.hpp"
#include "bus/time.hpp"

namespace dsdpv1::bus::capture {

/// A log's data about a telegram besides its bytes.
struct LoggedTelegram {
  std::optional<Tick> at;        ///< when it had ended; absent in a log of another program
  std::size_t whole_length = 0;  ///< bytes on the line; more than are present if the log was cut; 0: not known
};

struct TelegramText {
  Bytes bytes;
  std::vector<int> lines;                ///< the line of each byte
  std::map<int, LoggedTelegram> logged;  ///< by line: the telegrams of a log, one per line

  /// True if two bytes may belong to one telegram: a line of a log holds a complete one.
  bool together(std::size_t a, std::size_t b) const;
  /// The log's data for the line of this byte; nullptr if it is not a log.
  const LoggedTelegram* log_of(std::size_t byte) const;
};

/// Throws CaptureError with the line.
TelegramText read_telegram_text(std::istream& in);

}  // namespace dsdpv1::bus::capture
