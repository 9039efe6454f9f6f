#include "fake_target.hpp"

#include <cstring>

namespace dsdpv1::arm::test {
namespace {

constexpr MemoryRange kFlash{0x0800'0000, 4096}, kRam{0x2000'0000, 65536};
constexpr std::uint32_t kPage = 1024;
constexpr std::uint64_t kPollEvery = 64;

unsigned bits(std::uint32_t word, unsigned low, unsigned count) { return word >> low & ((1U << count) - 1U); }

}  // namespace

FakeTarget::FakeTarget(const ElfImage& firmware)
    : entry_(firmware.reset_handler & ~1U), flash_(kFlash.size, 0xFF), ram_(kRam.size) {
  for (const Segment& segment : firmware.segments)
    std::memcpy(&flash_.at(segment.address - kFlash.start), segment.bytes.data(), segment.bytes.size());
  start();
}

void FakeTarget::start() {
  reset_requested_ = false;
  registers_.fill(0);
  r(13) = load(kFlash.start, 4);
  write_register(Register::kMsp, r(13));
  write_register(Register::kXpsr, 0x0100'0000);
  write_register(Register::kPc, entry_);
}

bool FakeTarget::run(Debugger& debugger, std::uint64_t most) {
  while (!ended_ && done_ < most) {
    if (done_ % kPollEvery == 0 && (polls_when_wanted || !debugger.wanted())) debugger.poll();
    if (reset_requested_) start();
    const std::uint32_t pc = read_register(Register::kPc);
    if (debugger.wanted()) debugger.before_instruction(pc);
    if (reset_requested_) start();
    if (ended_ || read_register(Register::kPc) != pc) continue;  // with another pc it starts again
    if (!execute(debugger)) return false;
    ++done_;
  }
  return true;
}

bool FakeTarget::execute(Debugger& debugger) {
  std::uint32_t& pc = registers_.at(static_cast<std::size_t>(Register::kPc));
  const std::uint32_t code = load(pc, 2);
  pc += 2;
  const std::uint32_t address = r(bits(code, 3, 3)) + bits(code, 6, 5) * 4;
  const bool is_access = bits(code, 12, 4) == 6;
  if (is_access && reports_) debugger.data_access(address, 4, bits(code, 11, 1) == 0);
  switch (bits(code, 11, 5)) {
    case 0x00: r(bits(code, 0, 3)) = r(bits(code, 3, 3)) << bits(code, 6, 5); return true;  // LSLS immediate
    case 0x04: r(bits(code, 8, 3)) = bits(code, 0, 8); return true;                         // MOVS immediate
    case 0x06: r(bits(code, 8, 3)) += bits(code, 0, 8); return true;                        // ADDS immediate
    case 0x0C:                                                                              // STR immediate
      return write_memory(address, reinterpret_cast<const std::uint8_t*>(&r(bits(code, 0, 3))), 4);
    case 0x0D: r(bits(code, 0, 3)) = load(address, 4); return true;                                 // LDR immediate
    case 0x1C: pc += 2 + 2 * bits(code, 0, 11) - (bits(code, 10, 1) != 0 ? 4096 : 0); return true;  // B
    default: debugger.fault("an instruction that nobody knows"); return false;
  }
}

std::uint32_t FakeTarget::load(std::uint32_t address, std::uint32_t size) const {
  std::uint32_t word = 0;
  read_memory(address, reinterpret_cast<std::uint8_t*>(&word), size);
  return word;
}

std::vector<MemoryRegion> FakeTarget::memory_map() const {
  return {{kFlash.start, kFlash.size, false, kPage}, {kRam.start, kRam.size, true}};
}

std::size_t FakeTarget::read_memory(std::uint32_t address, std::uint8_t* to, std::size_t count) const {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t at = address + static_cast<std::uint32_t>(i);
    if (kFlash.holds(at, 1))
      to[i] = flash_.at(at - kFlash.start);
    else if (kRam.holds(at, 1))
      to[i] = ram_.at(at - kRam.start);
    else
      return i;
  }
  return count;
}

bool FakeTarget::write_memory(std::uint32_t address, const std::uint8_t* from, std::size_t count) {
  if (!kRam.holds(address, count)) return false;
  std::memcpy(ram_.data() + (address - kRam.start), from, count);
  return true;
}

bool FakeTarget::report_data_accesses(bool on) {
  reports_ = on && watchable;
  return watchable;
}

}  // namespace dsdpv1::arm::test
