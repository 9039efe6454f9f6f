#include "kinds/spc3/inside_watch.hpp"

#include <fmt/format.h>

#include "bus/baud.hpp"
#include "registers/spc3_regs.hpp"

namespace dsdpv1::tb {
namespace {

namespace regs = spc3::regs;

constexpr std::array<std::uint16_t, 9> kRegisters = {regs::kStatus,  regs::kStatus + 1, regs::kDinSm,
                                                     regs::kDoutSm,  regs::kDiagSm,     regs::kIrr,
                                                     regs::kIrr + 1, regs::kIr,         regs::kIr + 1};
enum Place : std::size_t { kStatusLow, kStatusHigh, kDin, kDout, kDiag, kIrrLow, kIrrHigh, kIrLow, kIrHigh };
using Registers = std::array<std::uint8_t, kRegisters.size()>;

unsigned bits(std::uint8_t value, unsigned lowest) { return value >> lowest & 3U; }

const char* dp_word(std::uint8_t status) {
  constexpr const char* kWords[] = {"WAIT_PRM", "WAIT_CFG", "DATA_EX", "?"};
  return kWords[bits(status, 4)];
}

const char* wd_word(std::uint8_t status) {
  constexpr const char* kWords[] = {"search", "BAUD_CONTROL", "DP_CONTROL", "?"};
  return kWords[bits(status, 6)];
}

std::string baud_word(std::uint8_t status) {
  const int index = status & 0xF;
  return index < bus::kBaudCount ? std::string(bus::baud(index).name) : "-";
}

/// "D1 N- U2 F3"
std::string buffers_word(std::uint8_t code) {
  const auto buffer = [code](unsigned lowest) {
    const unsigned number = bits(code, lowest);
    return number == 0 ? std::string("-") : std::to_string(number);
  };
  return fmt::format("D{} N{} U{} F{}", buffer(0), buffer(2), buffer(4), buffer(6));
}

/// "1 user, 2 sends"
std::string diag_word(std::uint8_t code) {
  constexpr const char* kOwners[] = {"-", "user", "chip", "sends"};
  return fmt::format("1 {}, 2 {}", kOwners[bits(code, 0)], kOwners[bits(code, 2)]);
}

unsigned word_of(const Registers& at, Place low, Place high) { return at[low] | static_cast<unsigned>(at[high]) << 8; }

/// In the order of signals().
std::vector<std::string> words_of(const Registers& at) {
  return {(at[kStatusLow] & 1) != 0 ? "PASSIVE_IDLE" : "OFFLINE",
          dp_word(at[kStatusLow]),
          wd_word(at[kStatusLow]),
          baud_word(at[kStatusHigh]),
          buffers_word(at[kDin]),
          buffers_word(at[kDout]),
          diag_word(at[kDiag]),
          (at[kStatusLow] & 4) != 0 ? "yes" : "no",
          fmt::format("{:04X}", word_of(at, kIrrLow, kIrrHigh)),
          fmt::format("{:04X}", word_of(at, kIrLow, kIrHigh))};
}

}  // namespace

const std::vector<InnerSignal>& Spc3Inside::signals() {
  static const std::vector<InnerSignal> signals = {{"mac", 0},  {"dp", 0},   {"wd", 0},        {"baud", 0}, {"din", 0},
                                                   {"dout", 0}, {"diag", 0}, {"diag_flag", 0}, {"irr", 0},  {"ir", 0}};
  return signals;
}

void Spc3Inside::look(bus::Tick at, const spc3::Chip& chip, std::size_t number, ChipListener& listener) {
  Registers now{};
  for (std::size_t i = 0; i < now.size(); ++i) now.at(i) = chip.peek(kRegisters.at(i));
  if (!told_.empty() && now == last_) return;
  last_ = now;
  const std::vector<std::string> words = words_of(now);
  for (std::size_t i = 0; i < words.size(); ++i)
    if (told_.empty() || words[i] != told_[i]) listener.inside(number, at, i, kLevelZ, words[i]);
  told_ = words;
}

}  // namespace dsdpv1::tb
