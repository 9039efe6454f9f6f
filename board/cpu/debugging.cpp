// The processor as a debugger sees it (DebugTarget), and its registers for a report.
#include <cstring>

#include "board/cpu/cortex_m3.hpp"

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kFlashPage = 2048;  // of an STM32F103xE

}  // namespace

std::uint32_t CortexM3::read_register(Register which) const { return engine_.read(which); }

/// Another PC is outside of any IT block.
void CortexM3::write_register(Register which, std::uint32_t value) {
  engine_.write(which, value);
  if (which != Register::kPc) return;
  constexpr std::uint32_t kItBits = 0x0600FC00;
  engine_.write(Register::kXpsr, engine_.read(Register::kXpsr) & ~kItBits);
  moved_ = true;
  attend_soon();
}

Registers CortexM3::registers() const {
  Registers all{};
  for (std::size_t n = 0; n < all.r.size(); ++n) all.r[n] = engine_.read(static_cast<Register>(n));
  all.sp = engine_.read(Register::kSp);
  all.lr = engine_.read(Register::kLr);
  all.pc = pc();
  all.xpsr = engine_.read(Register::kXpsr);
  all.msp = engine_.read(Register::kMsp);
  all.psp = engine_.read(Register::kPsp);
  all.primask = engine_.read(Register::kPrimask);
  all.basepri = engine_.read(Register::kBasepri);
  all.faultmask = engine_.read(Register::kFaultmask);
  all.control = engine_.read(Register::kControl);
  return all;
}

std::vector<MemoryRegion> CortexM3::memory_map() const {
  std::vector<MemoryRegion> all = {{0, map_.flash_size, false},
                                   {map_.flash_base, map_.flash_size, false, kFlashPage},
                                   {map_.ram_base, map_.ram_size, true}};
  const std::vector<MemoryRegion> outside = system_.regions();
  all.insert(all.end(), outside.begin(), outside.end());
  return all;
}

std::size_t CortexM3::read_memory(std::uint32_t address, std::uint8_t* to, std::size_t count) const {
  std::size_t done = 0;
  for (; done < count; ++done) {
    const std::uint32_t at = address + static_cast<std::uint32_t>(done);
    if (const std::uint8_t* byte = host(at))
      to[done] = *byte;
    else if (const std::optional<std::uint32_t> word = system_.peek(at & ~3U))
      to[done] = static_cast<std::uint8_t>(*word >> at % 4 * 8);
    else
      break;
  }
  return done;
}

bool CortexM3::write_memory(std::uint32_t address, const std::uint8_t* from, std::size_t count) {
  if (count > map_.ram_size || !in_ram(address, static_cast<std::uint32_t>(count))) return false;
  std::memcpy(ram_ + (address - map_.ram_base), from, count);
  engine_.forget_code();
  return true;
}

bool CortexM3::report_data_accesses(bool on) {
  engine_.report_data(on);
  return true;
}

bool CortexM3::reset() {
  reset_requested_ = true;
  attend_soon();
  return true;
}

}  // namespace dsdpv1::arm
