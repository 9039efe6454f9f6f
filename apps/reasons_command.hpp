#pragma once
// reasons: every code that logs, scenarios and result files may hold, with what to do about it.
#include <string>
#include <vector>

namespace app {

struct ReasonsArguments {
  std::string code;  ///< only this one; empty: all
  bool markdown = false;
  bool checks = false;  ///< docs/checks.md
  std::string output;   ///< empty: standard output
};

/// One code as a user reads it.
struct ReasonText {
  std::string code, severity, text, advice;
};

/// Those of the chip, of the driver's calls, of the bus monitor, of the ARM board, of the checks.
std::vector<ReasonText> chip_reasons();
std::vector<ReasonText> driver_reasons();
std::vector<ReasonText> bus_reasons();
std::vector<ReasonText> board_reasons();
std::vector<ReasonText> check_reasons();

int reasons(const ReasonsArguments& arguments);

}  // namespace app
