#pragma once
// "RTL" that is the model with one defect chosen by the test, so that the result of the lockstep is known exactly.
#include <algorithm>
#include <functional>
#include <utility>

#include "cosim/rtl.hpp"
#include "model/dsdpv1/chip.hpp"

namespace dsdpv1::cosim_test {

/// Evaluated as RTL is: by edges of CLK, without any knowledge of time.
class MadeUpTop : public cosim::Rtl {
 public:
  /// `spoil` sees the outputs of each evaluation and the number of the rising edge since power-on, which is 0 at tick
  /// 0.
  using Spoil = std::function<void(Level* levels, long cycle)>;
  explicit MadeUpTop(Spoil spoil = {}) : spoil_(std::move(spoil)) {}

  void eval(bool clk, Level* levels) override {
    if (clk != clk_) edge();
    for (const Pin pin : {Pin::kReset, Pin::kRReq, Pin::kRSta, Pin::kPbrxd})
      chip_.set(std::max<dsdpv1::Tick>(0, now_ - kHalfCycle), pin, levels[number(pin)]);
    for (const Pin pin :
         {Pin::kLReq, Pin::kLSta, Pin::kIntr0, Pin::kPbtxd, Pin::kPbrts, Pin::kPbf, Pin::kBr, Pin::kReady})
      levels[number(pin)] = chip_.level(pin);
    levels[number(Pin::kDOut)] = dsdpv1::kLevelZ;
    if (spoil_) spoil_(levels, rising_edges_ - kPowerUpCycles - 1);
  }
  bool memory(std::uint8_t* image) const override {
    for (std::uint16_t i = 0; i < 0x800; ++i) image[i] = chip_.peek(i);
    if (wrong_cell_ >= 0 && rising_edges_ > kPowerUpCycles + 3000) image[wrong_cell_] ^= 0x5A;
    return true;
  }
  /// This cell of the DPRAM is wrong from cycle 3000 on.
  void spoil_cell(int address) { wrong_cell_ = address; }

 private:
  static constexpr long kPowerUpCycles = 8;  // those of RtlChip before tick 0
  static constexpr dsdpv1::Tick kHalfCycle = profibus::kTicksPerCycle / 2;

  void edge() {
    clk_ = !clk_;
    if (clk_) ++rising_edges_;
    chip_.advance(now_);
    now_ += kHalfCycle;
  }
  dsdpv1::Chip chip_;
  Spoil spoil_;
  bool clk_ = false;
  long rising_edges_ = 0;
  int wrong_cell_ = -1;
  dsdpv1::Tick now_ = 0;
};

}  // namespace dsdpv1::cosim_test
