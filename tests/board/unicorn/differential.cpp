// Compares our engine with Unicorn: random instructions, registers, flags, memory, the order of accesses on the bus.
// GPL-2.0-only as a whole, because of Unicorn: never installed.
//
//   arm_differential [--instructions N] [--seed S]     random instructions
//   arm_differential IMAGE...                           code for 08000000 that ends at BKPT
//
// Exit 0: no difference, 1: a difference, which is printed, 2: wrong input.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <iterator>

#include "tests/board/unicorn/machine.hpp"
#include "tests/board/unicorn/random_code.hpp"

namespace dsdpv1::arm::differential {
namespace {

constexpr unsigned kInstructions = 96, kPasses = 24, kMostBlocks = 4'000;
constexpr std::uint32_t kFlagBits = 0xF8000000, kExceptionBits = 0x1FF, kItBits = 0x0600FC00, kThumb = 1U << 24;

State random_state(Random& random, std::uint32_t pc) {
  const auto word = [&random]() -> std::uint32_t {
    static constexpr std::uint32_t kEdges[] = {
        0, 1, 2, 31, 32, 33, 0x7F, 0x80, 0xFF, 0x7FFF, 0x8000, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFE, 0xFFFFFFFF};
    if (random() % 4 == 0) return kEdges[random() % std::size(kEdges)];
    return static_cast<std::uint32_t>(random());
  };
  const auto in_ram = [&random](std::uint32_t align) {
    return kRam + 0x4000 + (static_cast<std::uint32_t>(random()) & 0x7FFF & ~(align - 1));
  };
  State state;
  for (unsigned n = 0; n <= 14; ++n) state.registers.at(n) = word();
  for (const unsigned base : {6U, 7U, 8U, 10U, 11U}) state.registers.at(base) = in_ram(4);
  if (random() % 16 == 0) state.registers.at(10) = word() & ~(kBus | kRam);  // usually an address without memory
  if (random() % 8 == 0) state.registers.at(8) = in_ram(1);
  state.registers.at(kBusRegister) = kBus + 0x8000 + (static_cast<std::uint32_t>(random()) & 0x7FFC);
  state.registers.at(kIndexRegister) = static_cast<std::uint32_t>(random()) & 0xFC;
  state[Register::kMsp] = in_ram(4), state[Register::kPsp] = in_ram(4);
  const bool handler = random() % 4 == 0;
  state[Register::kXpsr] = (word() & kFlagBits) | kThumb | (handler ? 17 : 0);
  state[Register::kControl] = !handler && random() % 2 == 0 ? 2 : 0;
  state[Register::kSp] = state[Register::kControl] != 0 ? state[Register::kPsp] : state[Register::kMsp];
  state[Register::kPc] = pc;
  return state;
}

std::string hex(const std::vector<std::uint8_t>& code, std::uint32_t from, std::uint32_t count) {
  std::string text;
  for (std::uint32_t i = from; i + 1 < code.size() && i < from + count; i += 2)
    text += fmt::format(" {:04X}", code[i] | code[i + 1] << 8);
  return text;
}

/// Unicorn keeps bits of stack pointers that are 0 (B1.4.1), and its ITSTATE is internal.
std::uint32_t compared(Register which) {
  if (which == Register::kXpsr) return kFlagBits | kExceptionBits;
  return which == Register::kSp || which == Register::kMsp || which == Register::kPsp ? ~3U : ~0U;
}

/// The difference as text; empty: none.
std::string difference(Machine& a, Trap a_trap, Machine& b, Trap b_trap) {
  std::string text;
  if (a_trap != b_trap) text += fmt::format("  trap {} and {}\n", static_cast<int>(a_trap), static_cast<int>(b_trap));
  const State x = a.get(), y = b.get();
  for (unsigned n = 0; n < kRegisterCount; ++n) {
    const std::uint32_t mask = compared(static_cast<Register>(n));
    if (((x.registers.at(n) ^ y.registers.at(n)) & mask) != 0)
      text += fmt::format("  register {} is {:08X} and {:08X}\n", n, x.registers.at(n), y.registers.at(n));
  }
  if (a.ram() != b.ram()) {
    const auto [at, other] = std::mismatch(a.ram().begin(), a.ram().end(), b.ram().begin());
    text += fmt::format("  RAM at {:08X} is {:02X} and {:02X}\n",
                        kRam + static_cast<std::uint32_t>(at - a.ram().begin()), *at, *other);
  }
  if (!(a.bus() == b.bus())) {
    text += fmt::format("  {} and {} accesses on the bus\n", a.bus().size(), b.bus().size());
    for (std::size_t i = 0; i < std::max(a.bus().size(), b.bus().size()); ++i)
      for (const Machine* each : {&a, &b})
        if (i < each->bus().size())
          text += fmt::format("    {}: {} {:08X} {} {:X}\n", each->name(), each->bus()[i].write ? "store" : "load ",
                              each->bus()[i].address, each->bus()[i].bytes, each->bus()[i].value);
  }
  const std::uint32_t apart = a.bad_address() / 4 - b.bad_address() / 4;  // which part of an unaligned one fails
  if (a_trap == b_trap && a_trap == Trap::kBadAccess && apart != 0)
    text += fmt::format("  bad address {:08X} and {:08X}\n", a.bad_address(), b.bad_address());
  return text;
}

class Campaign {
 public:
  explicit Campaign(std::uint64_t seed) : random_(seed), ours_(make_ours()), unicorn_(make_unicorn()) {}

  /// Returns false, after printing it, for a difference.
  bool block() {
    if (++blocks_ % kMostBlocks == 0) renew();
    const std::vector<std::uint8_t> code = random_code(random_, kInstructions);
    ours_->load(code);
    unicorn_->load(code);
    for (unsigned pass = 0; pass < kPasses; ++pass)
      if (!this->pass(code)) return false;
    return true;
  }
  /// Code that calls functions and terminates.
  bool image(const std::vector<std::uint8_t>& code) {
    ours_->longest = 1'000'000'000;
    ours_->load(code);
    unicorn_->load(code);
    return pass(code);
  }
  /// Executed by both.
  std::uint64_t instructions() const { return compared_; }

 private:
  /// Unicorn sometimes crashes internally after this much code.
  void renew() {
    ours_ = make_ours();
    unicorn_ = make_unicorn();
  }
  /// Runs from the first instruction to the end; after a faulting one it continues with other registers.
  bool pass(const std::vector<std::uint8_t>& code) {
    for (std::uint32_t pc = kCode;;) {
      const State state = random_state(random_, pc);
      ours_->set(state);
      unicorn_->set(state);
      const std::uint64_t before = ours_->instructions();
      const Trap ours = ours_->run();
      const std::uint32_t at = ours_->get()[Register::kPc] - kCode;
      const Trap other = unicorn_->run();
      compared_ += ours_->instructions() - before;
      // A Cortex-M3 rejects unaligned LDM and others (A3.2.1), Unicorn does not.
      if (ours == Trap::kUnaligned || (ours == other && ours == Trap::kBadAccess && may_differ(opcode_at(code, at)))) {
        unicorn_->ram() = ours_->ram();
        return true;
      }
      if (const std::string text = difference(*ours_, ours, *unicorn_, other); !text.empty()) {
        tell(code, state, text);
        return false;
      }
      if (ours == Trap::kBreakpoint) return true;
      pc = kCode + at + (ours >= Trap::kInvalidState ? thumb_bytes(opcode_at(code, at)) : 0);
    }
  }
  static std::uint16_t opcode_at(const std::vector<std::uint8_t>& code, std::uint32_t at) {
    return static_cast<std::uint16_t>(code[at] | code[at + 1] << 8);
  }
  /// Effects of a failing access may differ: Unicorn executes the rest of an IT block, and loads the first of several
  /// registers.
  bool may_differ(std::uint16_t opcode) const {
    const bool in_block = (ours_->get()[Register::kXpsr] & kItBits) != 0;
    return in_block || (opcode & 0xFE00U) == 0xBC00 || (opcode & 0xF800U) == 0xC800 || (opcode & 0xFE00U) == 0xE800;
  }
  void tell(const std::vector<std::uint8_t>& code, const State& state, const std::string& text) const {
    const std::uint32_t at = ours_->get()[Register::kPc] - kCode;
    fmt::print("ours and Unicorn's after a run from {:08X} to {:08X}:\n{}  code:{}\n", state[Register::kPc], kCode + at,
               text, hex(code, state[Register::kPc] - kCode, at - (state[Register::kPc] - kCode) + 4));
    if (const std::uint32_t offset = kCode + at - kRam; offset + 4 <= kRamBytes)
      fmt::print("  in RAM: {:02X}\n", fmt::join(&ours_->ram()[offset], &ours_->ram()[offset] + 4, " "));
    for (unsigned n = 0; n < kRegisterCount; ++n) fmt::print("  register {} was {:08X}\n", n, state.registers.at(n));
  }

  Random random_;
  std::unique_ptr<Machine> ours_, unicorn_;
  std::uint64_t compared_ = 0;
  unsigned blocks_ = 0;
};

/// Days since 1970.
std::uint64_t today() {
  constexpr std::time_t kSeconds = 24 * 60 * 60;
  return static_cast<std::uint64_t>(std::time(nullptr) / kSeconds);
}

int run(std::uint64_t instructions, std::uint64_t seed) {
  Campaign campaign(seed);
  while (campaign.instructions() < instructions)
    if (!campaign.block()) return 1;
  fmt::print("{} instructions with seed {}: no difference\n", campaign.instructions(), seed);
  return 0;
}

int run(const std::vector<std::string>& images, std::uint64_t seed) {
  Campaign campaign(seed);
  for (const std::string& path : images) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    if (bytes.size() < 2 || bytes.size() > kCodeBytes) {
      fmt::print(stderr, "{}: holds {} bytes, expected 2 to {}\n", path, bytes.size(), kCodeBytes);
      return 2;
    }
    const std::uint64_t before = campaign.instructions();
    if (!campaign.image({bytes.begin(), bytes.end()})) return 1;
    fmt::print("{}: {} instructions, no difference\n", path, campaign.instructions() - before);
  }
  return 0;
}

int carry_out(int argc, char** argv) {
  CLI::App app("Our Cortex-M3 against Unicorn's: random instructions");
  std::uint64_t instructions = 1'000'000, seed = today();
  app.add_option("--instructions", instructions, "How many are executed")->capture_default_str();
  app.add_option("--seed", seed, "Other seeds, other instructions; left out: the number of the day")
      ->capture_default_str();
  std::vector<std::string> images;
  app.add_option("IMAGE", images, "Code for 08000000 that ends at BKPT, in place of random instructions");
  CLI11_PARSE(app, argc, argv);
  return images.empty() ? run(instructions, seed) : run(images, seed);
}

}  // namespace
}  // namespace dsdpv1::arm::differential

int main(int argc, char** argv) {
  try {
    return dsdpv1::arm::differential::carry_out(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
