#pragma once
// Coverage of a random campaign: kinds of telegrams, and the chip's reasons towards them and its user.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bus/wire/uart.hpp"
#include "model/profibus/event.hpp"

namespace dsdpv1::cosim {

class Coverage {
 public:
  /// A sent telegram, with its faults on the wire.
  void sent(const bus::Bytes& bytes, const bus::WireFaults& faults);
  void happened(const profibus::Event& event);
  void add(const Coverage& other);
  void add(const std::string& telegram, std::uint64_t times) { telegrams_[telegram] += times; }
  void add(profibus::Reason reason, std::uint64_t times) { reasons_[reason] += times; }

  const std::map<std::string, std::uint64_t>& telegrams() const { return telegrams_; }
  std::uint64_t count(profibus::Reason reason) const { return of(reasons_, reason); }
  /// Telegrams, refusals and states with their counts, then the codes that never occurred: some lines of text. `codes`:
  /// all known codes.
  std::string text(const std::vector<profibus::Reason>& codes) const;

 private:
  using Counts = std::map<profibus::Reason, std::uint64_t>;
  static std::uint64_t of(const Counts& counts, profibus::Reason reason);

  std::map<std::string, std::uint64_t> telegrams_;
  Counts reasons_;  ///< those that occurred
};

}  // namespace dsdpv1::cosim
