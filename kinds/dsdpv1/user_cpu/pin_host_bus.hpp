#pragma once
// The HostBus on the pins of a chip: A, D, CSR, RD, WR with exact edges.
#include <cstddef>

#include "kinds/user_cpu/host_bus.hpp"
#include "model/dsdpv1/chip.hpp"
#include "model/dsdpv1/host_access.hpp"
#include "tb/chip/pin_device.hpp"

namespace dsdpv1::user_cpu {

/// Drives a chip, which must outlive it. Between accesses CSR, RD and WR are high, D and A as left by HostAccess.
/// `core`: the core of these pins, which takes whole accesses; null: each edge is set.
class PinHostBus : public HostBus {
 public:
  explicit PinHostBus(tb::PinDevice& pins, dsdpv1::Chip* core = nullptr) : chip_(pins), core_(core) {}
  PinHostBus(const PinHostBus&) = delete;
  PinHostBus& operator=(const PinHostBus&) = delete;

  void set_r_req(Tick at, bool level) override;
  void set_r_sta(Tick at, bool level) override;
  bool l_req(Tick at) override;
  bool l_sta(Tick at) override;
  bool intr0(Tick at) override;
  unsigned lamps(Tick at) override;
  void begin(Tick at, const Access& access, const AccessTiming& timing) override;
  Tick next_edge() const override { return edge_ < access_->size() ? begin_ + (*access_)[edge_].at : bus::kNever; }
  bool put_off() override { return edge_ == 0 && core_ != nullptr && core_->is_private(begin_, *access_); }
  void run_edges(Tick until) override;
  /// Executes the running access at once, if the result is the same and it has not begun. `may_report`: as for
  /// Chip::carry_out.
  bool run_whole(bool may_report);
  const dsdpv1::HostAccess& access() const { return *access_; }  ///< the present or last one
  Tick last_edge() const { return begin_ + access_->last(); }
  Tick end() const override { return end_; }
  std::uint8_t read_value() const override { return value_; }
  bool last_read_was_bad() const override { return bad_; }
  /// The tick at which the last read samples D.
  Tick sample_tick() const { return sample_tick_; }

 private:
  void sample(Tick at);
  void take(dsdpv1::Level level);
  bool is_high(Tick at, dsdpv1::Pin pin);

  tb::PinDevice& chip_;
  dsdpv1::Chip* const core_;
  dsdpv1::HostAccessMaker maker_;
  const dsdpv1::HostAccess* access_ = &maker_.make(false, 0, 0, {});  ///< the present or last one
  Tick begin_ = 0;                                                    ///< of its first edge
  std::size_t edge_ = 0;
  Tick end_ = 0, sample_tick_ = 0;
  std::uint8_t value_ = 0xFF;
  bool bad_ = false;
};

}  // namespace dsdpv1::user_cpu
