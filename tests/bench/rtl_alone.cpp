#include "tests/bench/rtl_alone.hpp"

#include "Vdsdpv1.h"
#include "verilated.h"

namespace dsdpv1::speed {
namespace {

constexpr Tick kHalfCycle = profibus::kTicksPerCycle / 2;

}  // namespace

struct RtlAlone::Impl {
  VerilatedContext context;
  Vdsdpv1 model{&context};
  Tick next_edge = 0;
  std::uint64_t line_changes = 0, request_changes = 0;
  CData line = 1, request = 0;

  /// Some cycles out of reset and some in it, so that every asynchronous reset has had its edge.
  void power_up() {
    model.csr_i = model.rd_i = model.wr_i = model.pbrxd_i = 1;
    for (int cycle = 0; cycle < 8; ++cycle) {
      model.reset_i = cycle < 4;
      for (const CData clk : {CData{0}, CData{1}}) {
        model.clk_i = clk;
        model.eval();
      }
    }
    model.clk_i = 0;
    model.eval();
    line = model.pbtxd_o;
    request = model.l_req_o;
  }
  void eval() {
    model.eval();
    line_changes += model.pbtxd_o != line;
    request_changes += model.l_req_o != request;
    line = model.pbtxd_o;
    request = model.l_req_o;
  }
  void advance(Tick to) {
    for (; next_edge <= to; next_edge += kHalfCycle) {
      model.clk_i = !model.clk_i;
      eval();
    }
  }
  /// The strobes of the host port and RESET act at once, the others wait for an edge.
  void apply(Pin pin, Level level) {
    const auto bit = static_cast<CData>(level != 0);
    switch (pin) {
      case Pin::kReset: model.reset_i = bit; return eval();
      case Pin::kCsr: model.csr_i = bit; return eval();
      case Pin::kRd: model.rd_i = bit; return eval();
      case Pin::kWr: model.wr_i = bit; return eval();
      case Pin::kRReq: model.r_req_i = bit; return;
      case Pin::kRSta: model.r_sta_i = bit; return;
      case Pin::kA: model.a_i = static_cast<SData>(level); return;
      case Pin::kDIn: model.d_i = level < 0 ? 0xFF : static_cast<CData>(level); return;
      default: model.pbrxd_i = bit; return;
    }
  }
};

RtlAlone::RtlAlone() : impl_(std::make_unique<Impl>()) { impl_->power_up(); }
RtlAlone::~RtlAlone() { impl_->model.final(); }

void RtlAlone::set(Tick at, Pin pin, Level level) {
  impl_->advance(at);
  impl_->apply(pin, level);
}

void RtlAlone::advance(Tick to) { impl_->advance(to); }

Level RtlAlone::level(Pin pin) const {
  if (pin == Pin::kLSta) return impl_->model.l_sta_o;
  return pin == Pin::kLReq ? impl_->model.l_req_o : impl_->model.pbtxd_o;
}

std::uint64_t RtlAlone::line_changes() const { return impl_->line_changes; }
std::uint64_t RtlAlone::request_changes() const { return impl_->request_changes; }

}  // namespace dsdpv1::speed
