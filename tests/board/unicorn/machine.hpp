#pragma once
// A processor without exceptions that executes code until it traps: ours or Unicorn's, for comparison.
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "board/cpu/engine.hpp"

namespace dsdpv1::arm::differential {

constexpr std::uint32_t kCode = 0x08000000, kCodeBytes = 0x10000;
constexpr std::uint32_t kRam = 0x20000000, kRamBytes = 0x10000;
constexpr std::uint32_t kBus = 0x40000000, kBusBytes = 0x100000;  ///< where accesses are noted

/// Registers by enumerator; of xPSR the flags and the exception's number.
struct State {
  std::array<std::uint32_t, kRegisterCount> registers{};
  std::uint32_t& operator[](Register which) { return registers.at(static_cast<std::size_t>(which)); }
  std::uint32_t operator[](Register which) const { return registers.at(static_cast<std::size_t>(which)); }
};

struct BusAccess {
  bool write = false;
  std::uint32_t address = 0;
  unsigned bytes = 0;
  std::uint32_t value = 0;
  bool operator==(const BusAccess& o) const {
    return write == o.write && address == o.address && bytes == o.bytes && value == o.value;
  }
};

class Machine {
 public:
  virtual ~Machine() = default;
  virtual std::string name() const = 0;
  /// Places `code` at kCode.
  virtual void load(const std::vector<std::uint8_t>& code) = 0;
  virtual void set(const State& state) = 0;
  std::uint64_t longest = 10'000;  ///< instructions of a run of ours
  /// Runs until a trap; kNone: ours reaches none. The bus's accesses are those of this run.
  virtual Trap run() = 0;
  virtual State get() const = 0;
  virtual std::uint64_t instructions() const { return 0; }
  /// For Trap::kBadFetch and kBadAccess.
  virtual std::uint32_t bad_address() const = 0;

  std::array<std::uint8_t, kRamBytes>& ram() { return ram_; }
  const std::vector<BusAccess>& bus() const { return bus_; }

 protected:
  std::uint32_t bus_load(std::uint32_t address, unsigned bytes);
  void bus_store(std::uint32_t address, unsigned bytes, std::uint32_t value);

  alignas(4096) std::array<std::uint8_t, kRamBytes> ram_{};
  std::vector<BusAccess> bus_;
};

std::unique_ptr<Machine> make_ours();
/// Throws std::runtime_error if the library refuses.
std::unique_ptr<Machine> make_unicorn();

}  // namespace dsdpv1::arm::differential
