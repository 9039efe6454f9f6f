#pragma once
// Prints telegrams byte by byte for `dsdpv1-sim decode`.
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "bus/capture/captured_telegram.hpp"
#include "bus/telegram/explain.hpp"

namespace dsdpv1::bus::capture {

/// Empty for a right telegram.
std::string what_is_wrong(const CapturedTelegram& telegram, const Decoded& decoded);

class TelegramPrinter {
 public:
  /// `out` must outlive it. `packets`: telegrams are packets of a file, and numbered as such.
  explicit TelegramPrinter(std::ostream& out, bool packets = false) : out_(out), packets_(packets) {}

  /// `why` is its what_is_wrong.
  void print(const CapturedTelegram& telegram, const Decoded& decoded, const std::string& why,
             const ExplainContext& context);

 private:
  std::string where(const CapturedTelegram& telegram) const;
  void right(const std::string& where, const Decoded& decoded, const ExplainContext& context);
  void wrong(const std::string& where, const std::string& why, const Decoded& decoded, const Bytes& all);
  void garbage(const std::string& where, const Bytes& bytes);
  void write(const std::string& what, const std::string& where, const std::string& line,
             const std::vector<ExplainedByte>& bytes);

  std::ostream& out_;
  bool packets_;
  std::uint64_t taken_ = 0, right_ = 0;
};

}  // namespace dsdpv1::bus::capture
