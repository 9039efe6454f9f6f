// Complete accesses of the host bus: the same edges as those of tb's user CPUs.
#include <algorithm>
#include <array>
#include <cstring>

#include "capi/chip.hpp"
#include "capi/names.hpp"
#include "capi/sized.hpp"
#include "model/dsdpv1/host_access.hpp"

namespace {

using capi::guarded;
using capi::need;
using capi::Tick;
using dsdpv1::AccessTiming;
using dsdpv1::HostAccess;

constexpr Tick kMostTime = 100 * bus::kTicksPerUs;

/// A parallel host bus: a kind's names of the pins of HostAccess, of straps that are low for it, its default times.
struct HostBusRow {
  const char *a, *csr, *rd, *wr, *d_in;
  std::array<const char*, 3> straps;  ///< SERIAL is only a VPC3+'s
  AccessTiming timing;
};

/// Long enough for XREADY (A42).
constexpr AccessTiming for_xready() {
  AccessTiming timing;
  timing.rd_low = timing.wr_low = 2500;
  timing.rd_sample = 2333;
  return timing;
}

constexpr std::array<HostBusRow, 2> kHostBuses = {
    {{"A", "CSR", "RD", "WR", "D_IN", {}, {}},
     {"AB", "XCS", "XRD_R_W", "XWR_E_CLOCK", "DB_IN", {"XINT_MOT", "MODE", "SERIAL"}, for_xready()}}};

/// That bus at the pins of a kind.
class HostBus {
 public:
  /// Throws for a kind without one, and for a chip that is strapped to another.
  explicit HostBus(const dpsim_chip& chip) : pins_(chip.kind.chip.pins()) {
    const auto row = std::find_if(kHostBuses.begin(), kHostBuses.end(),
                                  [this](const HostBusRow& each) { return find(each.csr) != kNone; });
    if (row == kHostBuses.end()) capi::refuse_host_bus();
    for (const char* strap : row->straps)
      if (strap != nullptr && find(strap) != kNone && chip.level(find(strap)) != 0)
        capi::fail(DPSIM_ERR_UNSUPPORTED, "the straps choose another bus than the asynchronous one of Intel");
    a_ = find(row->a);
    csr_ = find(row->csr);
    rd_ = find(row->rd);
    wr_ = find(row->wr);
    d_in_ = find(row->d_in);
    timing_ = &row->timing;
  }

  tb::PinNumber pin(dsdpv1::Pin role) const {
    using dsdpv1::Pin;
    switch (role) {
      case Pin::kA: return a_;
      case Pin::kCsr: return csr_;
      case Pin::kRd: return rd_;
      case Pin::kWr: return wr_;
      default: return d_in_;
    }
  }
  const AccessTiming& timing() const { return *timing_; }

 private:
  static constexpr tb::PinNumber kNone = tb::kMostPins;
  tb::PinNumber find(const char* name) const {
    for (std::size_t i = 0; i < pins_.size(); ++i)
      if (std::strcmp(pins_[i].name, name) == 0) return static_cast<tb::PinNumber>(i);
    return kNone;
  }

  const tb::PinTable& pins_;
  tb::PinNumber a_ = kNone, csr_ = kNone, rd_ = kNone, wr_ = kNone, d_in_ = kNone;
  const AccessTiming* timing_ = nullptr;
};

/// Those of `usual` without given ones.
AccessTiming timing_of(const dpsim_access_timing* given, const AccessTiming& usual) {
  if (given == nullptr) return usual;
  const dpsim_access_timing own = capi::options_of(given, "timing");
  const auto need_time = [](const char* name, std::int64_t time, Tick least) {
    capi::need_range(name, time, least, kMostTime);
  };
  need_time("address_setup", own.address_setup, -kMostTime);
  need_time("cs_lead", own.cs_lead, 0);
  need_time("rd_low", own.rd_low, 1);
  need_time("rd_sample", own.rd_sample, 0);
  need_time("wr_low", own.wr_low, 1);
  need_time("data_setup", own.data_setup, -kMostTime);
  need_time("data_hold", own.data_hold, 0);
  need_time("address_hold", own.address_hold, 0);
  need_time("cs_trail", own.cs_trail, 0);
  need_time("recovery", own.recovery, 0);
  return {own.address_setup, own.cs_lead,   own.rd_low,       own.rd_sample, own.wr_low,
          own.data_setup,    own.data_hold, own.address_hold, own.cs_trail,  own.recovery};
}

/// Returns the sampled value; for a write, none.
tb::Level carry_out(dpsim_chip& chip, const HostBus& bus, std::uint64_t tick, const HostAccess& access,
                    std::uint64_t* end) {
  const Tick begin = capi::tick_from(tick, chip.clock.now);
  const capi::Running running(chip.clock);
  tb::Level sampled = DPSIM_X;
  for (const HostAccess::Edge& edge : access)
    if (edge.pin == dsdpv1::Pin::kDOut)
      sampled = chip.device().sample(begin + edge.at);
    else
      chip.set(begin + edge.at, bus.pin(edge.pin), edge.level);
  chip.advance(begin + access.duration());
  chip.clock.now = begin + access.duration();
  chip.changes.check();
  if (end != nullptr) *end = capi::tick_out(begin + access.duration());
  return sampled;
}

/// The port of a chip that has been advanced to the access; this moves the present tick there.
tb::RegisterPort& port_at(dpsim_chip& chip, Tick at) {
  tb::RegisterPort* const port = chip.device().registers();
  if (port == nullptr)
    capi::fail(DPSIM_ERR_UNSUPPORTED, "a chip of this kind is accessed by the pins of its host bus or port");
  chip.advance(at);
  chip.clock.now = at;
  return *port;
}

}  // namespace

dpsim_status dpsim_access_timing_default(dpsim_access_timing* timing) {
  return guarded(
      __func__,
      [&] {
        const AccessTiming own;
        dpsim_access_timing filled{};
        filled.address_setup = own.address_setup;
        filled.cs_lead = own.cs_lead;
        filled.rd_low = own.rd_low;
        filled.rd_sample = own.rd_sample;
        filled.wr_low = own.wr_low;
        filled.data_setup = own.data_setup;
        filled.data_hold = own.data_hold;
        filled.address_hold = own.address_hold;
        filled.cs_trail = own.cs_trail;
        filled.recovery = own.recovery;
        capi::give(filled, timing, "timing");
      });
}

dpsim_status dpsim_chip_read(dpsim_chip* chip, uint64_t tick, uint16_t address, const dpsim_access_timing* timing,
                             dpsim_level* value, uint64_t* end) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        need(value, "value");
        capi::need_range("address", address, 0, HostAccess::kIdleAddress);
        const HostBus bus(*chip);
        *value = carry_out(*chip, bus, tick, HostAccess::read(address, timing_of(timing, bus.timing())), end);
      });
}

dpsim_status dpsim_chip_write(dpsim_chip* chip, uint64_t tick, uint16_t address, uint8_t value,
                              const dpsim_access_timing* timing, uint64_t* end) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        capi::need_range("address", address, 0, HostAccess::kIdleAddress);
        const HostBus bus(*chip);
        carry_out(*chip, bus, tick, HostAccess::write(address, value, timing_of(timing, bus.timing())), end);
      });
}

dpsim_status dpsim_chip_load(dpsim_chip* chip, uint64_t tick, uint16_t address, uint8_t* value) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        need(value, "value");
        const Tick at = capi::tick_from(tick, chip->clock.now);
        const capi::Running running(chip->clock);
        *value = port_at(*chip, at).load(at, address);
        chip->changes.check();
      });
}

dpsim_status dpsim_chip_store(dpsim_chip* chip, uint64_t tick, uint16_t address, uint8_t value) {
  return guarded(
      __func__,
      [&] {
        need(chip, "chip");
        const Tick at = capi::tick_from(tick, chip->clock.now);
        const capi::Running running(chip->clock);
        port_at(*chip, at).store(at, address, value);
        chip->changes.check();
      });
}
