#pragma once
// The HostBus on the pins of a chip: A, D, CSR, RD, WR with exact edges.
#include <array>
#include <cstddef>
#include <optional>

#include "model/dsdpv1/chip.hpp"
#include "tb/dsdpv1/user_cpu/host_bus.hpp"
#include "tb/dsdpv1/user_cpu/host_pins.hpp"

namespace user_cpu {

/// Drives a chip, which must outlive it. Between accesses CSR, RD and WR are high, D is released and A is 0x7FF, so
/// that an address taken away too early is never masked by a bus that happens to hold it.
class PinHostBus : public HostBus {
 public:
  explicit PinHostBus(dsdpv1::Chip& chip) : core_(std::in_place, chip), chip_(*core_) {}
  explicit PinHostBus(HostPins& pins) : chip_(pins) {}
  PinHostBus(const PinHostBus&) = delete;
  PinHostBus& operator=(const PinHostBus&) = delete;

  void set_r_req(Tick at, bool level) override;
  void set_r_sta(Tick at, bool level) override;
  bool l_req(Tick at) override;
  bool l_sta(Tick at) override;
  bool intr0(Tick at) override;
  unsigned lamps(Tick at) override;
  void begin(Tick at, const Access& access, const AccessTiming& timing) override;
  Tick next_edge() const override { return edge_ < edges_.size ? edges_.at[edge_].tick : bus::kNever; }
  void run_edges(Tick now) override;
  Tick end() const override { return end_; }
  std::uint8_t read_value() const override { return value_; }
  bool last_read_was_bad() const override { return bad_; }
  /// The tick at which the read begun last samples D.
  Tick sample_tick() const { return sample_tick_; }

  static constexpr dsdpv1::Level kIdleAddress = 0x7FF;

 private:
  struct Edge {
    Tick tick = 0;
    bool sample = false;
    dsdpv1::Pin pin = dsdpv1::Pin::kA;
    dsdpv1::Level level = 0;
  };
  struct Edges {
    std::array<Edge, 8> at{};
    std::size_t size = 0;
  };
  void insert(const Edge& edge);
  void add(Tick offset, dsdpv1::Pin pin, dsdpv1::Level level);
  void add_sample(Tick offset);
  void plan_read(const AccessTiming& timing);
  void plan_write(const Access& access, const AccessTiming& timing);
  Tick place(Tick start, Tick recovery);
  void sample(Tick at);
  bool is_high(Tick at, dsdpv1::Pin pin);

  std::optional<CoreHostPins> core_;
  HostPins& chip_;
  Edges edges_;
  std::size_t edge_ = 0;
  Tick end_ = 0, sample_tick_ = 0;
  std::uint8_t value_ = 0xFF;
  bool bad_ = false;
};

}  // namespace user_cpu
