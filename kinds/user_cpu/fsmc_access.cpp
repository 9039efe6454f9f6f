#include "kinds/user_cpu/fsmc_access.hpp"

#include "bus/time.hpp"

namespace dsdpv1::user_cpu {
namespace {

/// Converts HCLK periods to ticks, rounded to the nearest.
class Hclk {
 public:
  explicit Hclk(std::int64_t hz) : hz_(hz) {}
  Tick operator()(int periods) const { return (periods * bus::kTicksPerSecond + hz_ / 2) / hz_; }

 private:
  std::int64_t hz_;
};

/// From the end of one access to the earliest fall of CSR in the next: the minimum of RM0008.
int high_time(const FsmcTiming& timing, FsmcMode mode) { return timing.busturn + (mode == FsmcMode::k1 ? 1 : 2); }

AccessTiming read_timing(const FsmcTiming& timing, FsmcMode mode, const Hclk& at) {
  const int fall = mode == FsmcMode::k1 ? 0 : timing.addset + 1;
  const int sample = timing.addset + 1 + timing.datast + 1;
  const int rise = sample + 2;
  AccessTiming access;
  access.address_setup = access.cs_lead = at(fall);
  access.rd_sample = at(sample) - at(fall);
  access.rd_low = at(rise) - at(fall);
  access.address_hold = access.cs_trail = 0;
  access.recovery = at(rise + high_time(timing, mode)) - at(rise);
  return access;
}

AccessTiming write_timing(const FsmcTiming& timing, FsmcMode mode, const Hclk& at) {
  const int fall = timing.addset + 1;
  const int rise = fall + timing.datast;
  const int end = rise + 1;
  AccessTiming access;
  access.address_setup = access.cs_lead = at(fall);
  access.wr_low = access.data_setup = at(rise) - at(fall);
  access.data_hold = access.address_hold = access.cs_trail = at(end) - at(rise);
  access.recovery = at(end + high_time(timing, mode)) - at(end);
  return access;
}

}  // namespace

FsmcAccess access_timing(const FsmcBank& bank) {
  const Hclk at(bank.hclk_hz);
  return {read_timing(bank.read, bank.mode, at), write_timing(bank.write, bank.mode, at)};
}

}  // namespace dsdpv1::user_cpu
