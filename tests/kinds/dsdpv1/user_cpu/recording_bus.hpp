#pragma once
// A HostBus that records the CPU's actions. An access has two edges: one at its start, one 1000 ticks later.
#include <cstdint>
#include <string>
#include <vector>

#include "kinds/user_cpu/host_bus.hpp"

namespace dsdpv1 {

class RecordingBus : public user_cpu::HostBus {
 public:
  using Tick = bus::Tick;
  static constexpr Tick kLength = 1000;
  static constexpr Tick kRecovery = 100;

  void set_r_req(Tick at, bool level) override { note(at, level ? "R_REQ up" : "R_REQ down"); }
  void set_r_sta(Tick at, bool level) override { note(at, level ? "R_STA up" : "R_STA down"); }
  bool l_req(Tick at) override {
    note(at, "L_REQ?");
    return chip_busy;
  }
  bool l_sta(Tick at) override {
    note(at, "L_STA?");
    return chip_busy;
  }
  void looked(const user_cpu::Looks& last) override { looks.push_back(last); }
  bool intr0(Tick) override { return true; }

  void begin(Tick at, const user_cpu::Access& access, const AccessTiming&) override {
    access_ = access;
    edge_ = at;
    last_ = at + kLength;
  }
  Tick next_edge() const override { return edge_; }
  bool put_off() override { return puts_off; }
  void run_edges(Tick until) override {
    for (; edge_ <= until; edge_ = edge_ == last_ ? bus::kNever : last_)
      note(edge_, edge_ == last_ ? "edge 2" : (access_.write ? "write" : "read"));
  }
  Tick end() const override { return last_ + kRecovery; }
  std::uint8_t read_value() const override { return bad ? 0xFF : static_cast<std::uint8_t>(access_.address & 0xFF); }
  bool last_read_was_bad() const override { return bad; }

  bool chip_busy = false, bad = false, puts_off = false;
  std::vector<std::string> log;
  std::vector<user_cpu::Looks> looks;  ///< before each rise of R_STA

 private:
  void note(Tick at, const char* what) { log.push_back(std::to_string(at) + " " + what); }
  user_cpu::Access access_;
  Tick edge_ = bus::kNever, last_ = 0;
};

}  // namespace dsdpv1
