// The codes of the SPC3 family: the chip's reasons, and the errors of its driver.
#include <string>

#include "driver/spc3/spc3.h"
#include "kinds/board/board_codes.hpp"
#include "kinds/spc3/settings.hpp"
#include "model/spc3/reasons.hpp"
#include "tb/bench/record.hpp"

namespace dsdpv1::tb {
namespace {

/// With example values; empty: the text has none.
std::string example_of(profibus::Reason reason) {
  const std::string example = spc3::describe({0, reason, 5, 12, 1});
  return example == spc3::text_template(reason) ? "" : example;
}

std::vector<CodeText> chip_codes() {
  std::vector<CodeText> list;
  for (const profibus::Reason reason : spc3::reasons())
    list.push_back({profibus::code(reason), tb::name(profibus::severity(reason)), reason.row().source,
                    spc3::text_template(reason), spc3::advice(reason), example_of(reason)});
  return list;
}

struct Explained {
  const char *source, *advice;
};

Explained explain(spc3_error error) {
  switch (error) {
    case SPC3_OK: return {"A54", "Continue."};
    case SPC3_ERR_ARGUMENT: return {"A16", "Fill in the port's functions and pass no null pointers."};
    case SPC3_ERR_NOT_OFFLINE: return {"A55", "Call spc3_initialise again after some microseconds."};
    case SPC3_ERR_RAM: return {"A3", "Check wiring, RESET and chip select; set vpc3 only for a VPC3+."};
    case SPC3_ERR_CONFIG_ADDRESS: return {"A5", "Give a station address from 0 to 126."};
    case SPC3_ERR_CONFIG_LENGTH: return {"A4", "Give lengths up to 244, of a diagnosis up to 238."};
    case SPC3_ERR_CONFIG_CFG: return {"A26", "Pass the configuration bytes, no more than their largest length."};
    case SPC3_ERR_CONFIG_FIT:
      return {"A4", "Shorten the diagnosis, parameters or configuration: the RAM has 1472 bytes for all buffers."};
    case SPC3_ERR_INPUT_LENGTH: return {"A27", "Give as many inputs as the accepted configuration has."};
    case SPC3_ERR_OUTPUT_LENGTH: return {"A27", "Make the buffer as large as max_output."};
    case SPC3_ERR_DIAG_LENGTH: return {"A4", "Shorten the diagnosis or initialise with a larger max_diag."};
    case SPC3_ERR_DIAG_BUSY: return {"A19", "Call again after the event diag_changed."};
  }
  return {"", ""};
}

std::vector<CodeText> driver_codes() {
  return {
#define X(name, value, text) \
  {#name, (name) == SPC3_OK ? "info" : "refusal", explain(name).source, #value ": " text, explain(name).advice},
      SPC3_ERROR_TABLE(X)
#undef X
  };
}

}  // namespace

const std::vector<CodeTable>& spc3_codes() {
  static const std::vector<CodeTable> tables = {
      {"The chips of the SPC3 family", "Codes besides those of every DP slave.", chip_codes()},
      {"The driver of the SPC3 family", "Results of its calls.", driver_codes()},
      board_codes()};
  return tables;
}

}  // namespace dsdpv1::tb
