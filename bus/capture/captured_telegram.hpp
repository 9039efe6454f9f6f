#pragma once
// A telegram in a capture: its bytes, its time on the line, and its damage.
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bus/bytes.hpp"
#include "bus/time.hpp"

namespace dsdpv1::bus::capture {

/// Damage of a telegram: the bits of the link-layer errors in a packet's flags (pcapng, epb_flags).
namespace damage {
constexpr std::uint32_t kCharacter = 1U << 31;       ///< symbol error: parity, stop bit, two drivers at once
constexpr std::uint32_t kStartDelimiter = 1U << 29;  ///< not a start delimiter
constexpr std::uint32_t kShape = 1U << 28;           ///< unaligned: LE and LEr, second SD2, ED, missing SAP
constexpr std::uint32_t kGap = 1U << 27;    ///< inter-frame gap: idle inside the telegram, or less than T_SYN before it
constexpr std::uint32_t kShort = 1U << 26;  ///< the line fell silent inside the telegram
constexpr std::uint32_t kFcs = 1U << 24;    ///< CRC error: wrong FCS
constexpr std::uint32_t kAll = 0xFFFF0000U;
}  // namespace damage

/// "wrong character, wrong FCS"; empty without damage.
std::string damage_words(std::uint32_t damage);

struct CapturedTelegram {
  Tick start = 0;                ///< falling edge of the first start bit
  Tick end = 0;                  ///< end of the last stop bit; `start` if the capture does not give it
  std::optional<int> baud = {};  ///< index of the table in bus/baud.hpp; absent if the capture does not give it
  std::uint32_t damage = 0;      ///< bits of namespace damage
  Bytes bytes = {};              ///< all characters, including those after the first wrong byte
  std::vector<std::string> remarks = {};  ///< remarks of the monitor
  int line = 0;                           ///< of a text, 1..; 0: the capture is none
  bool timed = true;                      ///< the capture gives its time
  std::size_t missing = 0;                ///< bytes at the end that a log has cut off
};

using TakeTelegram = std::function<void(const CapturedTelegram&)>;

/// An error of a capture and the allowed values, without the capture's name.
class CaptureError : public std::runtime_error {
 public:
  /// `line`: of a text, 0: the whole.
  explicit CaptureError(const std::string& what, int line = 0) : std::runtime_error(what), line_(line) {}
  int line() const { return line_; }

 private:
  int line_;
};

}  // namespace dsdpv1::bus::capture
