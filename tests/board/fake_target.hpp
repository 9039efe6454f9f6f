#pragma once
// A processor for the tests of the gdb server: the handful of Thumb instructions of firmware/loop.c, 1 us each.
#include <array>
#include <map>
#include <string>
#include <vector>

#include "board/cpu/debug_target.hpp"
#include "board/firmware/elf_image.hpp"

namespace dsdpv1::arm::test {

class FakeTarget final : public DebugTarget {
 public:
  explicit FakeTarget(const ElfImage& firmware);

  /// Runs until `most` instructions are done or a debugger ends the run; false: an instruction that it does not know.
  bool run(Debugger& debugger, std::uint64_t most);

  std::uint32_t read_register(Register which) const override { return registers_.at(static_cast<std::size_t>(which)); }
  void write_register(Register which, std::uint32_t value) override {
    registers_.at(static_cast<std::size_t>(which)) = value;
  }
  std::vector<MemoryRegion> memory_map() const override;
  std::size_t read_memory(std::uint32_t address, std::uint8_t* to, std::size_t count) const override;
  bool write_memory(std::uint32_t address, const std::uint8_t* from, std::size_t count) override;
  bool report_data_accesses(bool on) override;
  bool reset() override {
    reset_requested_ = resettable;
    return resettable;
  }
  bus::Tick now() const override { return static_cast<bus::Tick>(done_) * bus::kTicksPerUs; }
  std::uint64_t instructions() const override { return done_; }
  void end_run() override { ended_ = true; }

  bool watchable = true, resettable = true;
  std::uint64_t done() const { return done_; }  ///< instructions
  bool ended() const { return ended_; }
  /// Whether run() also calls poll() while before_instruction() is wanted; it need not.
  bool polls_when_wanted = true;
  bool reports_accesses() const { return reports_; }

 private:
  std::uint32_t& r(unsigned number) { return registers_.at(number); }
  void start();
  bool execute(Debugger& debugger);
  std::uint32_t load(std::uint32_t address, std::uint32_t size) const;

  std::uint32_t entry_;
  std::vector<std::uint8_t> flash_, ram_;
  std::array<std::uint32_t, kRegisterCount> registers_{};
  std::uint64_t done_ = 0;
  bool ended_ = false, reports_ = false, reset_requested_ = false;
};

}  // namespace dsdpv1::arm::test
