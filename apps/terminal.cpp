#include "apps/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "tb/report/text_table.hpp"

namespace dsdpv1::app {
namespace {

struct Mark {
  bool whole_line;  ///< else its beginning
  std::string_view text;
  std::string_view colour;
};

constexpr std::string_view kGood = "\x1B[1;32m", kBad = "\x1B[1;31m", kOpen = "\x1B[1;33m", kNone = "\x1B[0m";

constexpr Mark kMarks[] = {{false, "PASSED", kGood},
                           {false, "FAILED", kBad},
                           {false, "NOTHING JUDGED", kOpen},
                           {true, "EQUAL", kGood},
                           {true, "DIFFERENT", kBad},
                           {false, "INTERRUPTED", kOpen},
                           {false, "  NOT MET  ", kBad},
                           {false, "  passed  ", kGood},
                           {false, "  failed  ", kBad},
                           {false, "  nothing_judged  ", kOpen},
                           {false, "  refused  ", kBad},
                           {false, "  crashed  ", kBad},
                           {false, "  hung  ", kBad},
                           // rows of regress as blocks, where the terminal is too narrow for its table
                           {true, "  verdict   passed", kGood},
                           {true, "  verdict   failed", kBad},
                           {true, "  verdict   nothing_judged", kOpen},
                           {true, "  verdict   refused", kBad},
                           {true, "  verdict   crashed", kBad},
                           {true, "  verdict   hung", kBad}};

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
    const std::size_t size = mark.text.size();
    if (line.compare(0, size, mark.text) != 0 || (mark.whole_line && line.size() != size)) continue;
    return std::string(mark.colour) + line.substr(0, size) + std::string(kNone) + line.substr(size);
  }
  return line;
}

}  // namespace dsdpv1::app
