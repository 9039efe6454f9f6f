#pragma once
// Prints telegrams byte by byte for `dsdpv1-sim decode`.
#include <array>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "bus/telegram/explain.hpp"

namespace dsdpv1::bus {

class TelegramPrinter {
 public:
  /// `out` must outlive it.
  explicit TelegramPrinter(std::ostream& out) : out_(out) {}

  // `where` as in "line 5, 1361750.000 ns".
  // A valid one. Remembers the DPV1 setting of a Set_Prm, so that later diagnoses are read accordingly.
  void right(const std::string& where, const Decoded& decoded);
  /// `all`: the bytes from the telegram's first to the possible begin of the next one; those not in `decoded` are shown
  /// as not decoded.
  void wrong(const std::string& where, const std::string& why, const Decoded& decoded, const Bytes& all);
  void garbage(const std::string& where, const Bytes& bytes);

  /// There was a telegram, and all were valid.
  bool all_right() const { return right_ && count_ > 0; }

 private:
  void print(const std::string& what, const std::string& where, const std::string& line,
             const std::vector<ExplainedByte>& bytes);

  std::ostream& out_;
  std::array<std::optional<bool>, 128> dpv1_ = {};  ///< by slave
  int count_ = 0;
  bool right_ = true;
};

}  // namespace dsdpv1::bus
