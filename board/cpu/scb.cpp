#include "board/cpu/scb.hpp"

namespace dsdpv1::arm {

namespace {

// Offsets from 0xE000E000, ARMv7-M table B3-4.
constexpr std::uint32_t kCpuid = 0xD00, kIcsr = 0xD04, kVtor = 0xD08, kAircr = 0xD0C, kScr = 0xD10, kCcr = 0xD14,
                        kShpr = 0xD18, kShprEnd = 0xD24, kShcsr = 0xD24, kCfsr = 0xD28, kHfsr = 0xD2C, kMmfar = 0xD34,
                        kBfar = 0xD38, kDemcr = 0xDFC;
constexpr std::uint32_t kCortexM3R1p1 = 0x411FC231;  // that of the STM32F103

constexpr std::uint32_t kIcsrNmiSet = 1U << 31, kIcsrPendSvSet = 1U << 28, kIcsrPendSvClear = 1U << 27,
                        kIcsrPendStSet = 1U << 26, kIcsrPendStClear = 1U << 25, kIcsrIsrPending = 1U << 22,
                        kIcsrRetToBase = 1U << 11;
constexpr unsigned kIcsrVectPending = 12;

constexpr std::uint32_t kVectKey = 0x05FA0000, kVectKeyRead = 0xFA050000, kVectKeyBits = 0xFFFF0000,
                        kSysResetReq = 1U << 2;
constexpr unsigned kPriGroup = 8;

constexpr std::uint32_t kVtorBits = 0x3FFFFF80, kScrBits = 0x16, kCcrBits = 0x31B, kShcsrEnables = 0x70000,
                        kDemcrBits = 0x010107F1;

constexpr std::uint32_t kDwtCtrl = 0, kDwtCycCnt = 4;
constexpr std::uint32_t kDwtComparators = 4U << 28;

void merge(std::uint32_t& reg, std::uint32_t value, std::uint32_t lanes, std::uint32_t implemented) {
  reg = (reg & ~(lanes & implemented)) | (value & lanes & implemented);
}

struct HandlerBit {
  unsigned exception;
  unsigned active_bit;
  unsigned pending_bit;  // 0: not in SHCSR
};
// SHCSR, B3.2.13.
constexpr HandlerBit kHandlerBits[] = {{kMemManage, 0, 13}, {kBusFault, 1, 14},    {kUsageFault, 3, 12},
                                       {kSvCall, 7, 15},    {kDebugMonitor, 8, 0}, {kPendSv, 10, 0},
                                       {kSysTick, 11, 0}};

}  // namespace

void Scb::reset() { *this = Scb(); }

void Scb::record_bus_fault(std::uint32_t cfsr_bits, std::uint32_t address) {
  cfsr_ |= cfsr_bits | kBfArValid;
  bfar_ = address;
}

bool Scb::take_reset_request() {
  const bool request = reset_request_;
  reset_request_ = false;
  return request;
}

std::uint32_t Scb::interrupt_control(const Nvic& nvic, unsigned handler) const {
  std::uint32_t value = handler | nvic.foremost() << kIcsrVectPending;
  value |= nvic.pending(kNmi) ? kIcsrNmiSet : 0;
  value |= nvic.pending(kPendSv) ? kIcsrPendSvSet : 0;
  value |= nvic.pending(kSysTick) ? kIcsrPendStSet : 0;
  value |= nvic.foremost() >= kFirstInterrupt ? kIcsrIsrPending : 0;
  value |= nvic.active_count() <= 1 ? kIcsrRetToBase : 0;
  return value;
}

std::uint32_t Scb::handler_control(const Nvic& nvic) const {
  std::uint32_t value = shcsr_;
  for (const HandlerBit& bit : kHandlerBits) {
    value |= (nvic.active(bit.exception) ? 1U : 0U) << bit.active_bit;
    value |= (bit.pending_bit != 0 && nvic.pending(bit.exception) ? 1U : 0U) << bit.pending_bit;
  }
  return value;
}

std::uint32_t Scb::load(std::uint32_t offset, const Nvic& nvic, unsigned handler) const {
  if (offset >= kShpr && offset < kShprEnd) return nvic.load_priorities(kMemManage + offset - kShpr);
  switch (offset) {
    case kCpuid: return kCortexM3R1p1;
    case kIcsr: return interrupt_control(nvic, handler);
    case kVtor: return vtor_;
    case kAircr: return kVectKeyRead | nvic.grouping() << kPriGroup;
    case kScr: return scr_;
    case kCcr: return ccr_;
    case kShcsr: return handler_control(nvic);
    case kCfsr: return cfsr_;
    case kHfsr: return hfsr_;
    case kMmfar: return mmfar_;
    case kBfar: return bfar_;
    case kDemcr: return demcr_;
    default: return 0;
  }
}

void Scb::store_interrupt_control(std::uint32_t value, Nvic& nvic) {
  if ((value & kIcsrNmiSet) != 0) nvic.set_pending(kNmi);
  if ((value & kIcsrPendSvSet) != 0)
    nvic.set_pending(kPendSv);
  else if ((value & kIcsrPendSvClear) != 0)
    nvic.clear_pending(kPendSv);
  if ((value & kIcsrPendStSet) != 0)
    nvic.set_pending(kSysTick);
  else if ((value & kIcsrPendStClear) != 0)
    nvic.clear_pending(kSysTick);
}

void Scb::store_reset_control(std::uint32_t value, std::uint32_t lanes, Nvic& nvic) {
  if ((value & lanes & kVectKeyBits) != kVectKey) return;  // without the key the write is ignored (B3.2.6)
  nvic.set_grouping(value >> kPriGroup);
  reset_request_ = reset_request_ || (value & kSysResetReq) != 0;
}

void Scb::store(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes, Nvic& nvic) {
  if (offset >= kShpr && offset < kShprEnd) {
    nvic.store_priorities(kMemManage + offset - kShpr, value, lanes);
    return;
  }
  switch (offset) {
    case kIcsr: store_interrupt_control(value & lanes, nvic); break;
    case kVtor: merge(vtor_, value, lanes, kVtorBits); break;
    case kAircr: store_reset_control(value, lanes, nvic); break;
    case kScr: merge(scr_, value, lanes, kScrBits); break;
    case kCcr: merge(ccr_, value, lanes, kCcrBits); break;
    case kShcsr: merge(shcsr_, value, lanes, kShcsrEnables); break;
    case kCfsr: cfsr_ &= ~(value & lanes); break;  // write one to clear
    case kHfsr: hfsr_ &= ~(value & lanes); break;
    case kMmfar: merge(mmfar_, value, lanes, ~0U); break;
    case kBfar: merge(bfar_, value, lanes, ~0U); break;
    case kDemcr: merge(demcr_, value, lanes, kDemcrBits); break;
    default: break;
  }
}

std::uint32_t Scb::load_dwt(std::uint32_t offset, std::uint64_t cycles) const {
  switch (offset) {
    case kDwtCtrl: return kDwtComparators | dwt_control_;
    case kDwtCycCnt: return counting() ? static_cast<std::uint32_t>(cycles - counts_from_) : cycle_count_;
    default: return 0;
  }
}

void Scb::store_dwt(std::uint32_t offset, std::uint32_t value, std::uint64_t cycles) {
  const std::uint32_t count = offset == kDwtCycCnt ? value : load_dwt(kDwtCycCnt, cycles);
  if (offset == kDwtCtrl) dwt_control_ = value & kCycCntEna;
  cycle_count_ = count;
  counts_from_ = cycles - count;
}

}  // namespace dsdpv1::arm
