#pragma once
// A telegram as captures hold it: its bytes, when it was on the line, and what is wrong with it.
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bus/bytes.hpp"
#include "bus/time.hpp"

namespace dsdpv1::bus::capture {

/// What is wrong with a telegram: the bits of the link-layer errors in a packet's flags (pcapng, epb_flags).
namespace damage {
constexpr std::uint32_t kCharacter = 1U << 31;       ///< symbol error: parity, stop bit, two drivers at once
constexpr std::uint32_t kStartDelimiter = 1U << 29;  ///< begins with none
constexpr std::uint32_t kShape = 1U << 28;           ///< unaligned: LE and LEr, second SD2, ED, missing SAP
constexpr std::uint32_t kGap = 1U << 27;    ///< inter-frame gap: idle inside of it, or less than T_SYN before it
constexpr std::uint32_t kShort = 1U << 26;  ///< the line fell silent inside of it
constexpr std::uint32_t kFcs = 1U << 24;    ///< CRC error: wrong FCS
constexpr std::uint32_t kAll = 0xFFFF0000U;
}  // namespace damage

/// "wrong character, wrong FCS"; empty when there is no damage.
std::string damage_words(std::uint32_t damage);

struct CapturedTelegram {
  Tick start = 0;                         ///< falling edge of the first start bit
  Tick end = 0;                           ///< end of the last stop bit; `start` when the capture does not say
  std::optional<int> baud = {};           ///< index of the table in bus/baud.hpp; absent when the capture does not say
  std::uint32_t damage = 0;               ///< bits of namespace damage
  Bytes bytes = {};                       ///< all characters, also those after the byte that made it wrong
  std::vector<std::string> remarks = {};  ///< what the monitor said of it
};

using TakeTelegram = std::function<void(const CapturedTelegram&)>;

/// What is wrong with a capture, and what is allowed; without its name.
class CaptureError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace dsdpv1::bus::capture
