#pragma once
// A Verilated top of rtl_ref/, `dsdpv1` or `dsdpv1_rsu`, as an RtlTop. Included only where the reference RTL is
// compiled (reference_library.cpp), which says with RTL_INSIDE what a place below the top is called.
#include <memory>

#include "cosim/rtl_top.hpp"
#include "verilated.h"

namespace dsdpv1::cosim {

/// `Model` is the Verilated class. What is not reset begins with values that depend on the seed.
template <class Model>
class VerilatedTop : public RtlTop {
 public:
  explicit VerilatedTop(std::uint32_t seed) : context_(seeded(seed)), model_(std::make_unique<Model>(context_.get())) {}
  ~VerilatedTop() override { model_->final(); }

  void eval() override {
    drive();
    model_->eval();
    out.word = outputs();
  }

  /// Four memories interleaved by the low address bits, and up to two writes on their way to them, the older one first.
  bool dpram(DpramImage& image) const override {
    const auto& root = *model_->rootp;
    for (std::size_t i = 0; i < kDpramSize; i += 4) {
      image[i] = root.RTL_INSIDE(u_dpram__DOT__g_lane__BRA__0__KET____DOT__u_ram__DOT__memory_q)[i / 4];
      image[i + 1] = root.RTL_INSIDE(u_dpram__DOT__g_lane__BRA__1__KET____DOT__u_ram__DOT__memory_q)[i / 4];
      image[i + 2] = root.RTL_INSIDE(u_dpram__DOT__g_lane__BRA__2__KET____DOT__u_ram__DOT__memory_q)[i / 4];
      image[i + 3] = root.RTL_INSIDE(u_dpram__DOT__g_lane__BRA__3__KET____DOT__u_ram__DOT__memory_q)[i / 4];
    }
    if (root.RTL_INSIDE(u_dpram__DOT__first_valid_q)) put(image, root.RTL_INSIDE(u_dpram__DOT__first_q));
    if (root.RTL_INSIDE(u_dpram__DOT__second_valid_q)) put(image, root.RTL_INSIDE(u_dpram__DOT__second_q));
    return true;
  }

  Model& model() { return *model_; }
  const Model& model() const { return *model_; }
  VerilatedContext& context() { return *context_; }

 protected:
  static std::uint32_t wire(std::uint32_t level, Wire place) { return level << place; }
  /// The pins of table 1.
  void drive() {
    model_->clk_i = in.clk;
    model_->reset_i = in.reset;
    model_->r_req_i = in.r_req;
    model_->r_sta_i = in.r_sta;
    model_->csr_i = in.csr;
    model_->rd_i = in.rd;
    model_->wr_i = in.wr;
    model_->pbrxd_i = in.pbrxd;
    model_->a_i = in.a;
    model_->d_i = in.d;
  }
  std::uint32_t outputs() const {
    return wire(model_->l_req_o, kWireLReq) | wire(model_->l_sta_o, kWireLSta) | wire(model_->intr0_o, kWireIntr0) |
           wire(model_->pbtxd_o, kWirePbtxd) | wire(model_->pbrts_o, kWirePbrts) | wire(model_->pbf_o, kWirePbf) |
           wire(model_->br_o, kWireBr) | wire(model_->ready_o, kWireReady) | wire(model_->d_oe_o, kWireDriven) |
           (model_->d_oe_o != 0 ? model_->d_o : 0U);
  }

 private:
  static std::unique_ptr<VerilatedContext> seeded(std::uint32_t seed) {
    auto context = std::make_unique<VerilatedContext>();
    context->randReset(2);
    context->randSeed(static_cast<int>(seed % 0x7FFF'FFFF + 1));
    return context;
  }
  static void put(DpramImage& image, std::uint32_t write) {
    image.at(write >> 8 & (kDpramSize - 1)) = static_cast<std::uint8_t>(write & 0xFF);
  }

  std::unique_ptr<VerilatedContext> context_;
  std::unique_ptr<Model> model_;
};

}  // namespace dsdpv1::cosim
