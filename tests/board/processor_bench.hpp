#pragma once
// A CortexM3 with a program from tests/board/programs and a System that records its calls.
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "board/cpu/cortex_m3.hpp"

namespace dsdpv1::arm {

struct Access {
  bool write;
  std::uint32_t address;
  unsigned bytes;
  std::uint32_t value;
  std::uint64_t cycle;
};

/// Peripherals are plain memory; PORT and EXIT as programs/vectors.inc has them.
class NotingSystem : public System {
 public:
  static constexpr std::uint32_t kPort = 0x40000000, kExit = 0x4000F000;

  std::uint32_t load(std::uint32_t address, unsigned bytes) override;
  void store(std::uint32_t address, unsigned bytes, std::uint32_t value) override;
  std::uint64_t keep_up() override;
  void sleep(std::uint64_t until) override;
  void reset() override { ++resets; }

  CortexM3* processor = nullptr;
  std::vector<Access> accesses;      // all but those to EXIT and PORT
  std::vector<std::uint32_t> notes;  // values stored to PORT
  std::vector<std::uint64_t> note_cycles;
  std::map<std::uint32_t, std::uint8_t> memory;
  std::function<void(const Access&)> on_access;
  std::function<void()> on_keep_up;
  std::function<void(std::uint64_t)> on_sleep;
  std::vector<std::uint64_t> kept_up_at;
  std::uint64_t next_keep_up = kNever;
  std::uint32_t access_cycles = 0;  // each access takes this
  unsigned resets = 0;
  std::map<std::uint64_t, unsigned> interrupts;  // cycle -> irq, set by keep_up and sleep
};

class ProcessorBench : public testing::Test {
 protected:
  explicit ProcessorBench(const Timing& timing = whole_cycles());
  /// One instruction a cycle, so that cycles are easily counted.
  static Timing whole_cycles();
  void run(const std::string& program);
  std::uint32_t r(unsigned n) { return processor.registers().r[n]; }
  std::uint32_t ram_word(std::uint32_t address);

  NotingSystem system;
  CortexM3 processor;
  std::vector<Fault> faults;
};

std::vector<std::uint8_t> read_program(const std::string& name);

}  // namespace dsdpv1::arm
