#include "kinds/spc3/checks/blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dsdpv1::spc3_checks {
namespace {

constexpr std::size_t kCfg = 1;
constexpr int kSweep = 4;  ///< reads in a row; a word has two

bool is_command(Address address) {
  return address == regs::kNewDin || address == regs::kNextDout ||
         (address >= regs::kNewDiag && address <= regs::kCfgNotOk) || address == regs::kSsaFree;
}

}  // namespace

void Blocks::drop() { entries_ = {}; }

void Blocks::start() {
  drop();
  spans_.clear();
  for (const Buffer& each : buffers_of(chip_))
    if (each.of_block) spans_.push_back(chip_.buffer(each.pointer, each.length));
  read_cfg_ = chip_.cell(regs::kOrgReadCfgPointer);
}

Span Blocks::span_of(std::uint8_t pointer, int length) const {
  const int begin = pointer << chip_.shift();
  return {begin, begin + length};
}

void Blocks::arrived(Tick at, std::size_t block) { entries_.at(block).answer.begins(at); }

void Blocks::left() {
  for (Entry& each : entries_)
    if (!each.seen) each.answer.ends();
}

void Blocks::pass(Tick now) {
  for (std::size_t i = 0; i < kBlocks.size(); ++i)
    entries_.at(i).answer.pass(
        recorder_, Check::kAckTime, now, [i] { return fmt::format("{}: no answer", kBlocks.at(i).name); });
}

// --- accesses --------------------------------------------------------------------------------------------------------

void Blocks::accessed(const RegisterAccess& access) {
  const bool sweeps = is_sweep(access);
  if (const auto events = events_in(access)) {
    for (std::size_t i = 0; i < kBlocks.size(); ++i) {
      if ((*events & kBlocks.at(i).event) == 0) continue;
      entries_.at(i).seen = true;
      entries_.at(i).answer.begins(access.at);
    }
    return;
  }
  if (access.address >= regs::kBuffers) return touched(access);
  if (access.write) return;
  for (std::size_t i = 0; i < kBlocks.size(); ++i) {
    Entry& entry = entries_.at(i);
    if (access.address == kBlocks.at(i).pointer && entry.seen) {
      entry.opened = true;
      entry.pointer = access.value;
    } else if (access.address == kBlocks.at(i).ok || access.address == kBlocks.at(i).not_ok) {
      if (chip_.online() && !sweeps) judge(access, i);
      answered(access, i);
    }
  }
}

/// A sweep counts once, at its first command.
bool Blocks::is_sweep(const RegisterAccess& access) {
  in_a_row_ = access.write ? 0 : access.address == last_read_ + 1 ? in_a_row_ + 1 : 1;
  last_read_ = access.write ? -1 : access.address;
  if (access.write || !is_command(access.address)) return false;
  const bool sweeps = in_a_row_ >= kSweep, begins = sweeps && !std::exchange(swept_, true);
  if (!sweeps) swept_ = false;
  recorder_.kept(Check::kAckSweep, access.at, !begins, [&] {
    return fmt::format("{:02X}H is read after {:02X}H and those before it", access.address, access.address - 1);
  });
  return sweeps;
}

void Blocks::touched(const RegisterAccess& access) {
  if (!chip_.online()) return;
  bool is_open = false;
  for (std::size_t i = 0; i < kBlocks.size(); ++i) {
    Entry& entry = entries_.at(i);
    if (!entry.opened || !span_of(entry.pointer, chip_.cell(length_cell(chip_, i))).has(access.address)) continue;
    is_open = entry.read = true;
  }
  const bool of_block =
      std::any_of(spans_.begin(), spans_.end(), [&](const Span& each) { return each.has(access.address); });
  if (of_block)
    recorder_.kept(Check::kUseBlock, access.at, is_open, [&] {
      return fmt::format("{:03X}H is in a buffer of the master's telegrams: no event seen and its pointer read since",
                         access.address);
    });
}

// --- answers ---------------------------------------------------------------------------------------------------------

void Blocks::judge(const RegisterAccess& access, std::size_t block) {
  const Entry& entry = entries_.at(block);
  recorder_.kept(Check::kAckFounded, access.at, entry.read, [&] {
    return fmt::format("{:02X}H (answer {}): {}{}", access.address, access.value & regs::kVerdictAnswer,
                       kBlocks.at(block).name, entry.seen ? ", its buffer was not read" : " was not seen");
  });
}

void Blocks::answered(const RegisterAccess& access, std::size_t block) {
  Entry& entry = entries_.at(block);
  const unsigned answer = access.address == regs::kSsaFree ? 0U : access.value & regs::kVerdictAnswer;
  entry.answer.met(recorder_, Check::kAckTime, access.at,
                   [&] { return fmt::format("{}: answer {:02X}", kBlocks.at(block).name, answer); });
  if (block == kCfg && access.address == regs::kCfgOk && answer == regs::kVerdictFinished) exchange_cfg(entry);
  entry = {};
  if (answer != regs::kVerdictConflict) return;
  entry.seen = true;
  entry.answer.begins(access.at);
}

/// A26.
void Blocks::exchange_cfg(const Entry& cfg) {
  if (!chip_.changes_cfg() || !cfg.opened) return;
  const int length = chip_.cell(length_cell(chip_, kCfg)), begin = span_of(cfg.pointer, 0).begin;
  for (Span& each : spans_)
    if (each.begin == begin) each = span_of(read_cfg_, length);
  read_cfg_ = cfg.pointer;
}

}  // namespace dsdpv1::spc3_checks
