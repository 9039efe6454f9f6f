#pragma once
// The saturated bus of saturated_bus.hpp for a chip of the SPC3 family. Its user is idle, too, except for its
// watchdog: inputs were given once, and outputs are not fetched.
#include <cstdint>

#include "model/spc3/chip.hpp"
#include "registers/spc3_regs.hpp"
#include "tests/bench/saturated_bus.hpp"

namespace dsdpv1::speed {

class SaturatedSpc3 : public RequestLine<spc3::Chip, spc3::Pin::kRxd> {
 public:
  using RequestLine::RequestLine;

  /// From power-on to data exchange.
  void start() {
    set(10 * profibus::kTicksPerCycle, spc3::Pin::kReset, 0);
    wait(kMillisecond);
    initialise();
    device_.load(cycle(), spc3::regs::kNewDin);
    store(spc3::regs::kMode1S, spc3::regs::kMode1Start | spc3::regs::kMode1ResUserWd);
    wait(kMillisecond);
    for (const Bytes& request : bring_up(io_)) bring_up_by(request);
    device_.load(cycle(), spc3::regs::kCfgOk);
    wait(kMillisecond);
  }
  void exchange_for(Tick duration) {
    store(spc3::regs::kMode1S, spc3::regs::kMode1ResUserWd);
    RequestLine::exchange_for(duration);
  }

 private:
  profibus::Cycle cycle() const { return now() / profibus::kTicksPerCycle; }
  void store(int address, int value) {
    device_.store(cycle(), static_cast<spc3::Address>(address), static_cast<std::uint8_t>(value));
  }
  /// Buffers of the same size, one after the other, in the order of their pointers.
  void initialise() {
    namespace regs = spc3::regs;
    const conformance::Init init;
    store(regs::kOrgAddress, init.address);
    store(regs::kOrgIdentLow, init.ident & 0xFF);
    store(regs::kOrgIdentHigh, init.ident >> 8);
    store(regs::kOrgDoutLength, io_);
    store(regs::kOrgDinLength, io_);
    store(regs::kOrgAuxLength, kBuffer);
    int segment = regs::kBuffers / kSegment;
    for (const int pointer : {regs::kOrgDoutPointer + 0, regs::kOrgDoutPointer + 1, regs::kOrgDoutPointer + 2,
                              regs::kOrgDinPointer + 0, regs::kOrgDinPointer + 1, regs::kOrgDinPointer + 2,
                              regs::kOrgAuxPointer + 0, regs::kOrgPrmPointer + 0, regs::kOrgCfgPointer + 0}) {
      store(pointer, segment);
      segment += kBuffer / kSegment;
    }
    store(regs::kMode0 + 1, regs::kMode0DpMode >> 8);
  }
  static constexpr int kSegment = 8, kBuffer = 64;  // bytes; at least `io`
};

/// Counts the changes of the watched pins, as PinCounter.
struct Spc3PinCounter {
  static constexpr std::uint32_t kWatched = spc3::mask(spc3::Pin::kXInt) | spc3::mask(spc3::Pin::kTxd);
  std::uint64_t line = 0;

  spc3::PinSink sink() {
    return {[](void* self, Tick, spc3::Pin pin, spc3::Level) {
              if (pin == spc3::Pin::kTxd) ++static_cast<Spc3PinCounter*>(self)->line;
            },
            this};
  }
  bool has_seen() const { return line > 0; }
};

}  // namespace dsdpv1::speed
