#pragma once
// Reads bytes of telegrams from text: hexadecimal in any spacing, or the telegrams of a log of dsdpv1-sim, as text or
// JSON lines.
#include <cstddef>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "bus/bytes.hpp"

namespace dsdpv1::bus {

/// A log's data about a telegram besides its bytes.
struct LoggedTelegram {
  std::string at_ns;             ///< "1361750.000"
  std::size_t whole_length = 0;  ///< bytes on the line; more than are present if the log was cut
};

struct TelegramText {
  Bytes bytes;
  std::vector<int> lines;                ///< the line of each byte
  std::map<int, LoggedTelegram> logged;  ///< by line: the telegrams of a log, one per line

  /// Whether two bytes may belong to one telegram: a line of a log holds a complete one.
  bool together(std::size_t a, std::size_t b) const;
  /// The log's data for the line of this byte; nullptr if it is not a log.
  const LoggedTelegram* log_of(std::size_t byte) const;
};

/// If false, `error` is "name:line: what is wrong, what is allowed".
bool read_telegram_text(std::istream& in, const std::string& name, TelegramText& text, std::string& error);

}  // namespace dsdpv1::bus
