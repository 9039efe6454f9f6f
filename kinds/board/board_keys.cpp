#include "kinds/board/board_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "io/input/input_error.hpp"

namespace dsdpv1::tb {

using keys::Name;
using keys::ObjectOf;
using keys::WordFor;

const ObjectOf<Fsmc>& fsmc_keys() {
  static const ObjectOf<Fsmc> keys = [] {
    using user_cpu::FsmcMode;
    ObjectOf<Fsmc> o(
        "fsmc",
        "Bus timing of an STM32F103's FSMC from its registers (bank 1, SRAM, 8 bits). Default: the values that the "
        "firmware of an ARM board writes; for a native CPU addset 1, datast 5, busturn 0, mode 1, hclk 72.");
    o.integer("addset", &Fsmc::addset, {0, 15}, "HCLK", "ADDSET: WR (and in mode A RD) falls one HCLK more after CSR.");
    o.integer("datast", &Fsmc::datast, {0, 255}, "HCLK",
              "DATAST: low time of WR; D is sampled one HCLK more after the address phase. The manual reserves 0: WR "
              "would have no low time (Ts).");
    o.integer("busturn", &Fsmc::busturn, {0, 15}, "HCLK", "BUSTURN: additional high time of CSR between accesses.");
    o.integer("hclk", &Fsmc::hclk_mhz, {1, 72}, "MHz", "Frequency of HCLK (default: RCC's on an ARM board, else 72).");
    o.word("mode", &Fsmc::mode,
           std::vector<WordFor<FsmcMode>>{{FsmcMode::k1, "1", "RD falls with CSR"},
                                          {FsmcMode::kA, "A", "RD falls addset + 1 HCLK after CSR"}},
           "Access mode.");
    return o;
  }();
  return keys;
}

std::optional<Switch> parse_switch(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals < 3 || equals > 4 || text[0] != 'P') return std::nullopt;
  const std::string level = text.substr(equals + 1);
  if (text[1] < 'A' || text[1] > 'G' || (level != "low" && level != "high")) return std::nullopt;
  // 0 to 15, without a leading zero
  const std::string number = text.substr(2, equals - 2);
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  if (!std::all_of(number.begin(), number.end(), digit) || (number.size() > 1 && number[0] == '0')) return std::nullopt;
  const auto bit = static_cast<unsigned>(std::stoi(number));
  if (bit > 15) return std::nullopt;
  return Switch{static_cast<unsigned>(text[1] - 'A'), bit, level == "high"};
}

namespace {

void check_switches(const BoardKeys& board, bool arm, const WiredPins& wired, const std::string& file) {
  std::map<std::pair<unsigned, unsigned>, std::string> seen;
  for (const Name& text : board.switches) {
    const auto fail = [&](const std::string& why) { throw InputError(file, text.line, why); };
    if (!arm) fail("switches without kind: arm, expected those of an ARM board");
    const std::optional<Switch> one = parse_switch(text.text);
    if (!one) fail(fmt::format("switches holds {}, expected something like PA0=low or PG15=high", text.text));
    if ((wired.at(one->port) >> one->pin & 1U) != 0)
      fail(fmt::format("switches holds {}, a pin that the board wires to the chip; expected the others of PA0 to PG15",
                       text.text));
    if (!seen.emplace(std::pair(one->port, one->pin), text.text).second)
      fail(fmt::format("switches holds {}, a pin that is there twice, expected once", text.text));
  }
}

}  // namespace

void check_board_keys(const BoardKeys& board, bool arm, const WiredPins& wired, const std::string& file,
                      const std::string& slave, int line) {
  if (arm && board.elf.empty())
    throw InputError(file, line, fmt::format("elf is missing, slave {} has an ARM board that runs it", slave));
  if (!arm && !board.elf.empty())
    throw InputError(file, board.elf.line, "elf without kind: arm, expected both (--set user_cpu.kind=arm)");
  check_switches(board, arm, wired, file);
}

}  // namespace dsdpv1::tb
