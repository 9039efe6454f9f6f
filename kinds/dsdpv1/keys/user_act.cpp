#include "kinds/dsdpv1/keys/user_act.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "registers/dsdpv1_regs.hpp"

namespace dsdpv1::tb {
namespace {

using bus::Tick;
using user_cpu::Act;

/// Refusals of what the user handed over, by the begin of their codes, and the cell whose flag did that.
struct Refusal {
  std::string_view code;
  std::uint16_t cell;  ///< 0: a telegram
};
constexpr std::uint16_t kBlocks = regs::kUserCommand1, kAnswers = regs::kUserCommand2;
constexpr std::array<Refusal, 15> kRefusals = {{{"INIT_", kBlocks},
                                                {"INPUT_", kBlocks},
                                                {"DIAG_", kBlocks},
                                                {"VERDICT_", kBlocks},
                                                {"PRM_USER", kBlocks},
                                                {"CFG_USER", kBlocks},
                                                {"NOT_INITIALISED", kBlocks},
                                                {"C1_CRC", kAnswers},
                                                {"C2_CRC", kAnswers},
                                                {"DPV1_LENGTH", kAnswers},
                                                {"DPV1_NO_REQUEST", kAnswers},
                                                {"DPV1_ANSWER", kAnswers},
                                                {"TELEGRAM_", 0},
                                                {"UART_", 0},
                                                {"SPI_BUSY", 0}}};

bool begins(std::string_view code, std::string_view with) { return code.substr(0, with.size()) == with; }

}  // namespace

std::optional<Act> user_act_of(const profibus::Event& event) {
  const std::string_view code = profibus::code(event.reason);
  if (profibus::severity(event.reason) == profibus::Severity::kViolation) {
    if (code == "STRAP_CHANGED") return std::nullopt;
    if (code == "SPI_U_TIMER") return Act::omitted(event.at - Tick{event.a} * profibus::kTicksPerCycle, event.at);
    return Act::done(event.at);
  }
  if (profibus::severity(event.reason) != profibus::Severity::kRefusal || code == "PRM_USER_LENGTH")
    return std::nullopt;
  const auto* const found =
      std::find_if(kRefusals.begin(), kRefusals.end(), [code](const Refusal& each) { return begins(code, each.code); });
  if (found == kRefusals.end()) return std::nullopt;
  return found->cell != 0 ? Act::written(found->cell, event.at) : Act::done(event.at);
}

}  // namespace dsdpv1::tb
