#pragma once
// "RTL" that is the model itself, with one defect that the test chooses: what the lockstep has to find is known
// exactly.
#include <algorithm>
#include <functional>
#include <utility>

#include "cosim/rtl_top.hpp"
#include "model/dsdpv1/chip.hpp"

namespace dsdpv1::cosim_test {

/// Evaluated as RTL is: by edges of CLK, without any knowledge of time.
class MadeUpTop : public cosim::RtlTop {
 public:
  /// `spoil` sees the outputs of each evaluation and the number of the rising edge since power-on, which is 0 at tick
  /// 0.
  using Spoil = std::function<void(cosim::RtlOutputs& out, long cycle)>;
  explicit MadeUpTop(Spoil spoil = {}) : spoil_(std::move(spoil)) {}

  void eval() override {
    if (in.clk != clk_) edge();
    pin(dsdpv1::Pin::kReset, in.reset);
    pin(dsdpv1::Pin::kRReq, in.r_req);
    pin(dsdpv1::Pin::kRSta, in.r_sta);
    pin(dsdpv1::Pin::kPbrxd, in.pbrxd);
    out.word = wire(dsdpv1::Pin::kLReq, cosim::kWireLReq) | wire(dsdpv1::Pin::kLSta, cosim::kWireLSta) |
               wire(dsdpv1::Pin::kIntr0, cosim::kWireIntr0) | wire(dsdpv1::Pin::kPbtxd, cosim::kWirePbtxd) |
               wire(dsdpv1::Pin::kPbrts, cosim::kWirePbrts) | wire(dsdpv1::Pin::kPbf, cosim::kWirePbf) |
               wire(dsdpv1::Pin::kBr, cosim::kWireBr) | wire(dsdpv1::Pin::kReady, cosim::kWireReady);
    out.unknown = 0;
    if (spoil_) spoil_(out, rising_edges_ - kPowerUpCycles - 1);
  }
  bool dpram(cosim::DpramImage& image) const override {
    for (std::size_t i = 0; i < image.size(); ++i) image[i] = chip_.peek(static_cast<std::uint16_t>(i));
    if (wrong_cell_ >= 0 && rising_edges_ > kPowerUpCycles + 3000)
      image.at(static_cast<std::size_t>(wrong_cell_)) ^= 0x5A;
    return true;
  }
  /// This cell of the DPRAM is wrong from cycle 3000 on.
  void spoil_cell(int address) { wrong_cell_ = address; }

 private:
  static constexpr long kPowerUpCycles = 8;  // those of RtlChip before tick 0
  static constexpr dsdpv1::Tick kHalfCycle = profibus::kTicksPerCycle / 2;

  void edge() {
    clk_ = in.clk;
    if (clk_) ++rising_edges_;
    chip_.advance(now_);
    now_ += kHalfCycle;
  }
  void pin(dsdpv1::Pin pin, bool level) { chip_.set(std::max<dsdpv1::Tick>(0, now_ - kHalfCycle), pin, level ? 1 : 0); }
  std::uint32_t wire(dsdpv1::Pin pin, cosim::Wire place) const {
    return static_cast<std::uint32_t>(chip_.level(pin)) << place;
  }

  dsdpv1::Chip chip_;
  Spoil spoil_;
  bool clk_ = false;
  long rising_edges_ = 0;
  int wrong_cell_ = -1;
  dsdpv1::Tick now_ = 0;
};

}  // namespace dsdpv1::cosim_test
