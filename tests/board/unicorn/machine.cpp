#include "tests/board/unicorn/machine.hpp"

#include <cstring>

namespace dsdpv1::arm::differential {
namespace {

class Ours : public Machine, private EngineEvents {
 public:
  Ours() : engine_(*this, 1) {
    engine_.map(kCode, kCodeBytes, code_.data(), false);
    engine_.map(kRam, kRamBytes, ram_.data(), true);
    engine_.map_events(kBus, kBusBytes);
  }

  std::string name() const override { return "ours"; }
  void load(const std::vector<std::uint8_t>& code) override {
    std::memcpy(code_.data(), code.data(), code.size());
    engine_.forget_code();
  }
  void set(const State& state) override {
    engine_.set_mode(state[Register::kXpsr], state[Register::kControl], state[Register::kMsp], state[Register::kPsp]);
    for (unsigned n = 0; n < kRegisterCount; ++n) {
      const auto which = static_cast<Register>(n);
      if (which <= Register::kR12 || which == Register::kLr || which == Register::kPc ||
          (which >= Register::kPrimask && which <= Register::kFaultmask))
        engine_.write(which, state.registers.at(n));
    }
    engine_.clear_exclusive();
  }
  Trap run() override {
    bus_.clear();
    end_ = engine_.now() + longest;
    engine_.attend_at(end_);
    return engine_.run();
  }
  State get() const override {
    State state;
    for (unsigned n = 0; n < kRegisterCount; ++n) state.registers.at(n) = engine_.read(static_cast<Register>(n));
    return state;
  }
  std::uint64_t instructions() const override { return engine_.instructions(); }
  std::uint32_t bad_address() const override { return engine_.bad_address(); }

 private:
  bool before_instruction() override {
    engine_.attend_at(end_);  // MSR and CPS make it 0
    return engine_.now() < end_;
  }
  std::uint32_t on_load(std::uint32_t address, unsigned bytes) override { return bus_load(address, bytes); }
  void on_store(std::uint32_t address, unsigned bytes, std::uint32_t value) override {
    bus_store(address, bytes, value);
  }
  void on_data(std::uint32_t /*address*/, unsigned /*bytes*/, bool /*write*/) override {}
  void on_event() override {}
  void on_watched_store() override {}

  std::uint64_t end_ = 0;
  std::vector<std::uint8_t> code_ = std::vector<std::uint8_t>(kCodeBytes);
  Engine engine_;
};

}  // namespace

/// The result of a load depends on all earlier accesses, so that a different order shows.
std::uint32_t Machine::bus_load(std::uint32_t address, unsigned bytes) {
  std::uint32_t value = (address + static_cast<std::uint32_t>(bus_.size())) * 2654435761U;
  value ^= value >> 15;
  if (bytes < 4) value &= (1U << 8 * bytes) - 1;
  bus_.push_back({false, address, bytes, value});
  return value;
}

void Machine::bus_store(std::uint32_t address, unsigned bytes, std::uint32_t value) {
  bus_.push_back({true, address, bytes, value});
}

std::unique_ptr<Machine> make_ours() { return std::make_unique<Ours>(); }

}  // namespace dsdpv1::arm::differential
