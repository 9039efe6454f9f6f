#pragma once
// Orders of a script for the host of an XGate-DPS10: faults of its line.
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "kinds/xgate/settings.hpp"

namespace dsdpv1::xgate {

// Words of command::OfChip::order; those of other kinds mean the same.
constexpr const char* kFlipBit = "flip_bit";
constexpr const char* kCutTelegram = "cut_telegram";
constexpr const char* kPauseTelegram = "pause_telegram";
constexpr const char* kTalkOverReply = "talk_over_reply";
constexpr const char* kHostTelegram = "host_telegram";

const std::vector<tb::Order>& orders();
/// Throws tb::InputError for an order that has no effect on this host or port.
void check_order(const std::string& order, HostCpu cpu, Port port, const std::string& file, int line);

/// The faults that wait for the host's next commands.
class LineFaults {
 public:
  void add(const user_cpu::command::OfChip& order);
  bool none() const { return waiting_.empty(); }
  /// That of the next command, once; there is one.
  user_cpu::command::OfChip take();

 private:
  std::deque<user_cpu::command::OfChip> waiting_;
};

}  // namespace dsdpv1::xgate
