#include "apps/reasons_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iostream>

#include "apps/command_line.hpp"
#include "apps/interrupt.hpp"
#include "apps/outputs.hpp"
#include "bus/monitor/monitor.hpp"
#include "driver/dsdpv1.h"
#include "model/dsdpv1/reasons.hpp"
#include "tb/bench/record.hpp"
#include "tb/checks/check.hpp"
#include "tb/checks/markdown.hpp"
#include "tb/input/input_error.hpp"
#include "tb/input/suggest.hpp"
#include "tb/output/output_file.hpp"
#include "tb/scenario/event_codes.hpp"

namespace app {
namespace {

const char* advice_of(dsdpv1_error error) {
  switch (error) {
    case DSDPV1_OK: return "Nothing.";
    case DSDPV1_ERR_ARGUMENT: return "Fill in the port's functions and pass no null pointers.";
    case DSDPV1_ERR_NESTED:
      return "Let the interrupt handler return; the main program calls dsdpv1_service when it has released the DPRAM.";
    case DSDPV1_ERR_DPRAM_BUSY:
      return "Check that L_REQ and L_STA reach the CPU and that the chip has its clock and is out of reset; then allow "
             "more polls.";
    case DSDPV1_ERR_CHIP_SILENT:
      return "Check clock, RESET, R_REQ and R_STA: while one of the two stays high the chip cannot come to the DPRAM.";
    case DSDPV1_ERR_CHIP_NOT_READY:
      return "Wait 86 us or more after RESET rises (4096 cycles); check the read timing with B000..B003 = 01 0D 07 01.";
    case DSDPV1_ERR_NOT_INITIALISED: return "Call dsdpv1_initialise first and look at what it returns.";
    case DSDPV1_ERR_CONFIG_ADDRESS: return "Give a station address from 0 to 126.";
    case DSDPV1_ERR_CONFIG_INPUT:
    case DSDPV1_ERR_CONFIG_OUTPUT: return "Give a largest length from 0 to 244.";
    case DSDPV1_ERR_CONFIG_DIAG: return "Give a largest diagnosis length from 0 to 238.";
    case DSDPV1_ERR_CONFIG_PRM: return "Give a largest length of the user parameters from 0 to 237.";
    case DSDPV1_ERR_CONFIG_CFG: return "Give a largest configuration length from 1 to 200.";
    case DSDPV1_ERR_CONFIG_CFG_LENGTH: return "Pass the configuration bytes, no more than their largest length.";
    case DSDPV1_ERR_CONFIG_PRM_MODE:
    case DSDPV1_ERR_CONFIG_CFG_MODE: return "Use mode 0 (length), 1 (equal) or 2 (the user judges).";
    case DSDPV1_ERR_INIT_TIMEOUT:
      return "Check that R_REQ and R_STA fall after each hold and that the chip runs; then allow more polls.";
    case DSDPV1_ERR_INIT_CRC:
      return "The bytes did not arrive as written: check the write timing (HOST_ codes in the log).";
    case DSDPV1_ERR_INIT_LIMIT: return "Look at the chip's INIT_ reason in the log; it names the byte.";
    case DSDPV1_ERR_INIT_REFUSED: return "Check the read timing of B00A, B00B and B013.";
    case DSDPV1_ERR_INPUT_LENGTH: return "Pass no more input bytes than max_input.";
    case DSDPV1_ERR_INPUT_CRC:
      return "The bytes did not arrive as written: check the write timing (HOST_ codes in the log).";
    case DSDPV1_ERR_OUTPUT_LENGTH: return "Make the buffer as large as max_output; if it is, check the read timing.";
    case DSDPV1_ERR_OUTPUT_CRC: return "Check the read timing, and that nobody reads without owning the DPRAM.";
    case DSDPV1_ERR_DIAG_TYPE: return "Use one of the five types of table 22.";
    case DSDPV1_ERR_DIAG_LENGTH: return "Shorten the diagnosis or initialise with a larger max_diag.";
    case DSDPV1_ERR_DIAG_TIMEOUT: return "Check that R_REQ and R_STA fall after each hold; then allow more polls.";
    case DSDPV1_ERR_DIAG_CRC:
      return "The bytes did not arrive as written: check the write timing (HOST_ codes in the log).";
    case DSDPV1_ERR_PRM_LENGTH:
    case DSDPV1_ERR_PRM_CRC:
    case DSDPV1_ERR_CFG_LENGTH:
    case DSDPV1_ERR_CFG_CRC: return "Check the read timing, and that nobody reads without owning the DPRAM.";
    case DSDPV1_ERR_NO_VERDICT_DUE: return "Send a verdict once for each block, and only in judging mode 2.";
    case DSDPV1_ERR_VERDICT_STALE: return "Call dsdpv1_service: it hands over the newer block.";
    case DSDPV1_ERR_TABLE:
      return "Give each slot and index once, 0 <= min_length <= max_length <= 240, services and classes, and data or a "
             "handler for each service.";
    case DSDPV1_ERR_IM0: return "Give texts of at most 20 and 16 characters.";
    case DSDPV1_ERR_C1_LENGTH:
    case DSDPV1_ERR_C1_CRC:
    case DSDPV1_ERR_C2_LENGTH:
    case DSDPV1_ERR_C2_CRC: return "Check the read timing, and that nobody reads without owning the DPRAM.";
    case DSDPV1_ERR_ANSWER_LENGTH: return "Answer with 0 to 240 bytes.";
    case DSDPV1_ERR_NO_REQUEST_OPEN: return "Answer each deferred request once.";
    case DSDPV1_ERR_ANSWER_STALE: return "Forget the request: its master no longer waits for the answer.";
  }
  return "";
}

const char* meaning_of(bus::FlagKind kind) {
  switch (kind) {
    case bus::FlagKind::kCollision: return "two stations drive the line at once";
    case bus::FlagKind::kGap: return "more than 1 bit time of idle inside a telegram";
    case bus::FlagKind::kSynViolated: return "a request began less than T_SYN (33 bit times) after the last activity";
    case bus::FlagKind::kTsdrEarly: return "an answer came before min_TSDR";
    case bus::FlagKind::kTsdrLate: return "an answer came after max_TSDR";
    case bus::FlagKind::kCharacterError: return "a character with wrong parity or a low stop bit";
    case bus::FlagKind::kTelegramError:
      return "a telegram with a wrong delimiter, length or FCS, or one that broke off";
    case bus::FlagKind::kUnanswered: return "no answer within the slot time";
    case bus::FlagKind::kUnexpectedAnswer: return "an answer that nobody asked for, or by the wrong station";
    case bus::FlagKind::kGlitch: return "a low level shorter than half a bit";
    case bus::FlagKind::kTwoMasters: return "a master sends while another has the token";
  }
  return "";
}

const char* advice_of(bus::FlagKind kind) {
  switch (kind) {
    case bus::FlagKind::kCollision:
      return "Give each station an address of its own, run one master at a time, and let requests wait for the answer "
             "or the slot time.";
    case bus::FlagKind::kGap:
      return "Send the characters of a telegram without a pause. Slaves ignore such a telegram.";
    case bus::FlagKind::kSynViolated:
      return "The master must leave 33 bit times of idle before a request. Slaves ignore it otherwise.";
    case bus::FlagKind::kTsdrEarly: return "Look at min_TSDR of Set_Prm and at who answered.";
    case bus::FlagKind::kTsdrLate: return "Look at who answered; MaxTsdr of the GSD file must hold at this baud rate.";
    case bus::FlagKind::kCharacterError:
      return "Disturbed line, a second sender, or another baud rate or parity than 8E1.";
    case bus::FlagKind::kTelegramError:
      return "Disturbed line, or a sender that builds telegrams wrongly: `dsdpv1-sim decode` explains the bytes.";
    case bus::FlagKind::kUnanswered:
      return "Nothing while masters look for stations or slaves search the baud rate. Else the slave's own reason "
             "stands beside it in the log.";
    case bus::FlagKind::kUnexpectedAnswer:
      return "Two stations with the same address, or a master whose slot time is too short: its request and the late "
             "answer overlap.";
    case bus::FlagKind::kGlitch: return "Disturbed line. The chip ignores it while idle (S10).";
    case bus::FlagKind::kTwoMasters:
      return "Masters on one segment must share the token: each takes part in the ring, with an address of its own and "
             "the same slot time.";
  }
  return "";
}

void print(std::string& text, const std::vector<ReasonText>& reasons) {
  for (const ReasonText& each : reasons)
    text += fmt::format("{} ({})\n    {}\n    {}\n", each.code, each.severity, each.text, each.advice);
}

void print_table(std::string& text, const std::string& head, const std::vector<ReasonText>& reasons) {
  text += head + "\n| code | kind | text | what to do |\n|---|---|---|---|\n";
  for (const ReasonText& each : reasons)
    text += fmt::format("| `{}` | {} | {} | {} |\n", each.code, each.severity, each.text, each.advice);
}

std::string as_markdown() {
  std::string text =
      "# Reasons\n\nGenerated by `dsdpv1-sim reasons --markdown`; do not edit.\n\n"
      "Every code that a log, a result file or a scenario may hold, what it says, and what to do about it. `dsdpv1-sim "
      "reasons CODE` prints one of\n"
      "them. **info**: something was carried out; **refusal**: something that the master or the user asked for was "
      "not; **violation**: a rule was\n"
      "broken, and a scenario that does not allow it fails.\n";
  print_table(text, "\n## The chip\n\n`{a}`, `{b}`, `{c}` stand for values; `{a:4x}` is hexadecimal.\n",
              chip_reasons());
  print_table(text, "\n## The driver\n\nWhat a call of the C driver returned to the user program.\n", driver_reasons());
  print_table(text, "\n## The bus\n\nWhat the bus monitor saw on the line.\n", bus_reasons());
  print_table(text, "\n## The ARM board\n\nSee [arm_board.md](arm_board.md).\n", board_reasons());
  print_table(
      text,
      "\n## The checks\n\nWhat the checks on the user's side found broken, see [checks.md](checks.md). They fail a run "
      "with `--checks fail` only.\n",
      check_reasons());
  return text;
}

std::vector<ReasonText> all_reasons() {
  std::vector<ReasonText> all = chip_reasons();
  for (const auto& more : {driver_reasons(), bus_reasons(), board_reasons(), check_reasons()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// Codes are upper case; whoever types one need not be.
std::string in_capitals(std::string code) {
  std::transform(code.begin(), code.end(), code.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return code;
}

/// The only one with this code; throws InputError when there is none.
ReasonText find_reason(const std::vector<ReasonText>& all, const std::string& typed) {
  const std::string code = in_capitals(typed);
  const auto found =
      std::find_if(all.begin(), all.end(), [&code](const ReasonText& each) { return each.code == code; });
  if (found != all.end()) return *found;
  std::vector<std::string> codes;
  codes.reserve(all.size());
  for (const ReasonText& each : all) codes.push_back(each.code);
  throw tb::InputError(
      fmt::format("dsdpv1-sim reasons: unknown code {}{}, allowed are those that `dsdpv1-sim reasons` prints", typed,
                  tb::did_you_mean(code, codes)));
}

std::string as_text(const std::string& code) {
  const std::vector<ReasonText> all = all_reasons();
  std::string text;
  print(text, code.empty() ? all : std::vector<ReasonText>{find_reason(all, code)});
  return text;
}

}  // namespace

std::vector<ReasonText> chip_reasons() {
  std::vector<ReasonText> list;
  for (const profibus::Reason reason : dsdpv1::reasons())
    list.push_back({profibus::code(reason), tb::name(profibus::severity(reason)), dsdpv1::text_template(reason),
                    dsdpv1::advice(reason)});
  return list;
}

std::vector<ReasonText> driver_reasons() {
  return {
#define X(name, value, text) {#name, (name) == DSDPV1_OK ? "info" : "refusal", text, advice_of(name)},
      DSDPV1_ERROR_TABLE(X)
#undef X
  };
}

std::vector<ReasonText> bus_reasons() {
  std::vector<ReasonText> list;
  for (std::size_t i = 0; i < bus::kFlagKinds; ++i) {
    const auto kind = static_cast<bus::FlagKind>(i);
    list.push_back({tb::scenario::flag_code(kind), kind == bus::FlagKind::kUnanswered ? "info" : "violation",
                    meaning_of(kind), advice_of(kind)});
  }
  return list;
}

std::vector<ReasonText> board_reasons() {
  return {{tb::scenario::kFirmwareFault, "violation", "the firmware of an ARM board has met a fault; the run ends",
           "Look at the source line and the registers below the table, or run it again with --gdb."}};
}

std::vector<ReasonText> check_reasons() {
  std::vector<ReasonText> list;
  for (const checks::Check check : checks::kAllChecks) {
    const checks::Rule& rule = checks::rule(check);
    list.push_back({rule.id, "violation", std::string(rule.rule) + " (" + rule.clause + ")", rule.advice});
  }
  return list;
}

int reasons(const ReasonsArguments& arguments) {
  const std::string text = arguments.checks     ? checks::markdown()
                           : arguments.markdown ? as_markdown()
                                                : as_text(arguments.code);
  if (arguments.output.empty()) {
    std::cout << text << std::flush;
    return kPassed;
  }
  leave_nothing_on_signals();
  check_outputs("dsdpv1-sim reasons", {}, {{"--output", arguments.output}});
  tb::OutputFile file(arguments.output);
  file.write(text);
  file.commit();
  return kPassed;
}

}  // namespace app
