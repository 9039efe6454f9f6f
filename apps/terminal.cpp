#include "apps/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>
#include <utility>

#include "tb/report/text_table.hpp"

namespace dsdpv1::app {
namespace {

enum class Where : unsigned char { kWholeLine, kBeginning, kToTheEnd };

struct Mark {
  Where where;
  std::string_view text;
  std::string_view colour;
};

constexpr std::string_view kGood = "\x1B[1;32m", kBad = "\x1B[1;31m", kOpen = "\x1B[1;33m", kNone = "\x1B[0m";

constexpr Mark kMarks[] = {{Where::kBeginning, "PASSED", kGood},
                           {Where::kBeginning, "FAILED", kBad},
                           {Where::kBeginning, "NOTHING JUDGED", kOpen},
                           {Where::kWholeLine, "EQUAL", kGood},
                           {Where::kWholeLine, "DIFFERENT", kBad},
                           {Where::kBeginning, "INTERRUPTED", kOpen},
                           {Where::kBeginning, "  NOT MET  ", kBad},
                           {Where::kBeginning, "  passed  ", kGood},
                           {Where::kBeginning, "  failed  ", kBad},
                           {Where::kBeginning, "  nothing_judged  ", kOpen},
                           {Where::kBeginning, "  refused  ", kBad},
                           {Where::kBeginning, "  crashed  ", kBad},
                           {Where::kBeginning, "  hung  ", kBad},
                           // rows of regress as blocks, where the terminal is too narrow for its table
                           {Where::kWholeLine, "  verdict   passed", kGood},
                           {Where::kWholeLine, "  verdict   failed", kBad},
                           {Where::kWholeLine, "  verdict   nothing_judged", kOpen},
                           {Where::kWholeLine, "  verdict   refused", kBad},
                           {Where::kWholeLine, "  verdict   crashed", kBad},
                           {Where::kWholeLine, "  verdict   hung", kBad}};

/// Where in the line the colour is, from and to; from is npos when the mark is not there.
std::pair<std::size_t, std::size_t> place_of(const Mark& mark, std::string_view line) {
  constexpr auto kNowhere = std::string_view::npos;
  switch (mark.where) {
    case Where::kWholeLine: return {line == mark.text ? 0 : kNowhere, line.size()};
    case Where::kBeginning: return {line.substr(0, mark.text.size()) == mark.text ? 0 : kNowhere, mark.text.size()};
    case Where::kToTheEnd: break;
  }
  return {line.find(mark.text), line.size()};
}

}  // namespace

std::size_t terminal_columns() {
  winsize size{};
  const bool known = isatty(STDOUT_FILENO) != 0 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col != 0;
  return known ? size.ws_col : tb::TableWidth::kUnlimited;
}

bool wants_colour(const std::string& word) {
  if (word != "auto") return word == "always";
  const char* forbidden = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  return isatty(STDOUT_FILENO) != 0 && (forbidden == nullptr || *forbidden == '\0') && terminal != nullptr &&
         std::string_view(terminal) != "dumb";
}

std::string painted(const std::string& line) {
  for (const Mark& mark : kMarks) {
    const auto [from, to] = place_of(mark, line);
    if (from == std::string_view::npos) continue;
    return line.substr(0, from) + std::string(mark.colour) + line.substr(from, to - from) + std::string(kNone) +
           line.substr(to);
  }
  return line;
}

}  // namespace dsdpv1::app
