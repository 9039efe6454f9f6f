#include "bus/capture/csv_characters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "bus/baud.hpp"
#include "bus/capture/lower_case.hpp"

namespace dsdpv1::bus::capture {
namespace {

struct Character {
  Tick start;
  std::uint8_t byte;
  bool wrong_parity, wrong_stop;
};

std::optional<std::size_t> column(const std::vector<std::string>& headings, const std::string& part) {
  for (std::size_t i = 0; i < headings.size(); ++i)
    if (lower_case(headings[i]).find(part) != std::string::npos) return i;
  return std::nullopt;
}

class CharacterTable {
 public:
  CharacterTable(CsvLines& lines, const CharacterColumns& columns, const LogicSettings& settings)
      : lines_(lines), columns_(columns), settings_(settings) {}

  LogicSource read(const TakeTelegram& take) {
    for (std::string line; lines_.next(line);)
      if (!line.empty() && line != "\r") row(cells_of(line));
    LogicSettings settings = settings_;
    if (!settings.baud) settings.baud = rate();
    LogicDecoder decoder(settings, take);
    decoder.level(0, true);
    for (const Character& character : characters_) send(character, bus::baud(*settings.baud).bit, decoder);
    decoder.finish(end_);
    return {"characters", *settings.baud};
  }

 private:
  void row(const std::vector<std::string>& cells) {
    constexpr std::size_t kMost = 20'000'000;
    if (cells.size() <= std::max(columns_.time, columns_.value)) lines_.fail("has too few columns");
    if (!error(cells, columns_.framing, "framing") && cells[columns_.value].empty()) return;  // a remark of the decoder
    const std::optional<Tick> at = times_.read(cells[columns_.time], 1);
    if (!at)
      lines_.fail(fmt::format("time {}, expected a number or a date and time", cells[columns_.time].substr(0, 40)));
    if (!characters_.empty() && *at < characters_.back().start)
      lines_.fail("goes back in time, expected the order of time");
    if (characters_.size() >= kMost) lines_.fail(fmt::format("more than {} characters", kMost));
    characters_.push_back({*at, byte(cells[columns_.value]), error(cells, columns_.parity, "parity"),
                           error(cells, columns_.framing, "framing")});
  }

  std::uint8_t byte(const std::string& cell) const {
    char* end = nullptr;
    const long value = std::strtol(cell.c_str(), &end, 0);
    if (cell.empty() || *end != '\0' || value < 0 || value > 0xFF)
      lines_.fail(fmt::format("value {}, expected 0x00 to 0xFF: export with hexadecimal values", cell.substr(0, 40)));
    return static_cast<std::uint8_t>(value);
  }

  bool error(const std::vector<std::string>& cells, std::size_t own, const char* word) const {
    const auto cell = [&cells](std::size_t at) { return at < cells.size() ? lower_case(cells[at]) : std::string(); };
    const std::string flag = cell(own);
    return (!flag.empty() && flag != "0" && flag != "false") || cell(columns_.error).find(word) != std::string::npos;
  }

  int rate() const {
    Tick least = kNever;
    for (std::size_t i = 1; i < characters_.size(); ++i)
      least = std::min(least, characters_[i].start - characters_[i - 1].start);
    if (least == kNever) throw CaptureError("has fewer than two characters, name the rate with --baud");
    int best = 0;
    const auto off = [least](int index) {
      return std::abs(
          std::log(static_cast<double>(least) / static_cast<double>(kCharacterBits * bus::baud(index).bit)));
    };
    for (int i = 1; i < kBaudCount; ++i)
      if (off(i) < off(best)) best = i;
    return best;
  }

  void send(const Character& character, Tick bit, LogicDecoder& decoder) {
    const Tick start = std::max(character.start, end_);
    bool parity = character.wrong_parity;
    decoder.level(start, false);
    for (int i = 0; i < 8; ++i) {
      const bool one = ((character.byte >> i) & 1) != 0;
      parity ^= one;
      decoder.level(start + (i + 1) * bit, one);
    }
    decoder.level(start + 9 * bit, parity);
    decoder.level(start + 10 * bit, !character.wrong_stop);
    end_ = start + kCharacterBits * bit;
    if (character.wrong_stop) decoder.level(end_, true);
  }

  CsvLines& lines_;
  CharacterColumns columns_;
  const LogicSettings& settings_;
  TimeCell times_;
  std::vector<Character> characters_;
  Tick end_ = 0;
};

}  // namespace

std::optional<CharacterColumns> character_columns(const std::vector<std::string>& headings) {
  constexpr std::size_t kNone = ~std::size_t{0};
  const auto parity = column(headings, "parity"), framing = column(headings, "framing");
  const auto value = column(headings, "value");
  if (parity && framing && value && seconds_of(headings[0]) != 0)
    return CharacterColumns{0, *value, *parity, *framing, kNone};
  const auto start = column(headings, "start_time"), data = column(headings, "data");
  if (!start || !data || !column(headings, "type")) return std::nullopt;
  return CharacterColumns{*start, *data, kNone, kNone, column(headings, "error").value_or(kNone)};
}

LogicSource read_characters(CsvLines& lines, const CharacterColumns& columns, const LogicSettings& settings,
                            const TakeTelegram& take) {
  return CharacterTable(lines, columns, settings).read(take);
}

}  // namespace dsdpv1::bus::capture
