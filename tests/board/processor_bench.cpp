#include "tests/board/processor_bench.hpp"

#include <cstring>
#include <fstream>
#include <iterator>

namespace dsdpv1::arm {

std::uint32_t NotingSystem::load(std::uint32_t address, unsigned bytes) {
  std::uint32_t value = 0;
  for (unsigned byte = 0; byte < bytes; ++byte)
    value |= static_cast<std::uint32_t>(memory[address + byte]) << (8 * byte);
  accesses.push_back({false, address, bytes, value, processor->cycles()});
  processor->advance_to(processor->cycles() + access_cycles);
  if (on_access) on_access(accesses.back());
  return value;
}

void NotingSystem::store(std::uint32_t address, unsigned bytes, std::uint32_t value) {
  if (address == kExit) {
    processor->stop();
    return;
  }
  if (address == kPort) {
    notes.push_back(value);
    note_cycles.push_back(processor->cycles());
  } else {
    accesses.push_back({true, address, bytes, value, processor->cycles()});
  }
  for (unsigned byte = 0; byte < bytes; ++byte) memory[address + byte] = static_cast<std::uint8_t>(value >> (8 * byte));
  processor->advance_to(processor->cycles() + access_cycles);
  if (on_access) on_access({true, address, bytes, value, processor->cycles()});
}

std::uint64_t NotingSystem::keep_up() {
  kept_up_at.push_back(processor->cycles());
  while (!interrupts.empty() && interrupts.begin()->first <= processor->cycles()) {
    processor->set_interrupt(interrupts.begin()->second);
    interrupts.erase(interrupts.begin());
  }
  if (on_keep_up) on_keep_up();
  return interrupts.empty() ? next_keep_up : std::min(next_keep_up, interrupts.begin()->first);
}

void NotingSystem::sleep(std::uint64_t until) {
  if (on_sleep) {
    on_sleep(until);
    return;
  }
  if (!interrupts.empty() && interrupts.begin()->first < until) {
    processor->advance_to(interrupts.begin()->first);
    processor->set_interrupt(interrupts.begin()->second);
    interrupts.erase(interrupts.begin());
  } else if (until != kNever) {
    processor->advance_to(until);
  } else {
    throw std::runtime_error("asleep for ever");
  }
}

std::vector<std::uint8_t> read_program(const std::string& name) {
  std::ifstream file(PROGRAMS "/" + name + ".bin", std::ios::binary);
  if (!file) throw std::runtime_error("no program " + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

Timing ProcessorBench::whole_cycles() {
  Timing timing;
  timing.millicycles_per_instruction = 1000;
  return timing;
}

ProcessorBench::ProcessorBench(const Timing& timing) : processor(system, MemoryMap{}, timing) {
  system.processor = &processor;
  processor.on_fault([this](const Fault& fault) { faults.push_back(fault); });
}

void ProcessorBench::run(const std::string& program) {
  const std::vector<std::uint8_t> image = read_program(program);
  processor.load(MemoryMap{}.flash_base, image.data(), image.size());
  processor.run();
}

std::uint32_t ProcessorBench::ram_word(std::uint32_t address) {
  std::uint32_t word = 0;
  std::memcpy(&word, processor.ram() + (address - MemoryMap{}.ram_base), sizeof word);
  return word;
}

}  // namespace dsdpv1::arm
