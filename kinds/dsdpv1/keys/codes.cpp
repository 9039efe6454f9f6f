#include "kinds/dsdpv1/keys/codes.hpp"

#include "driver/dsdpv1.h"
#include "kinds/board/board_codes.hpp"
#include "kinds/dsdpv1/user_cpu/process_user.hpp"
#include "model/dsdpv1/reasons.hpp"
#include "tb/bench/record.hpp"
#include "tb/scenario/event_codes.hpp"

namespace dsdpv1::tb {
namespace {

struct Explained {
  const char *source, *advice;
};

constexpr const char* kReadTiming = "Check the read timing, and that the DPRAM is read only by its owner.";
constexpr const char* kWriteTiming =
    "The bytes did not arrive as written: check the write timing (HOST_ codes in the log).";
constexpr const char* kModes = "Use mode 0 (length), 1 (equal) or 2 (the user judges).";

Explained explain(dsdpv1_error error) {  // NOLINT(readability-function-size): a table
  switch (error) {
    case DSDPV1_OK: return {"M5-functions", "Continue."};
    case DSDPV1_ERR_ARGUMENT: return {"M5-functions", "Fill in the port's functions and pass no null pointers."};
    case DSDPV1_ERR_NESTED:
      return {
          "5.1-6",
          "Let the interrupt handler return; the main program calls dsdpv1_service when it has released the DPRAM."};
    case DSDPV1_ERR_DPRAM_BUSY:
      return {
          "H2, 5.1-8",
          "Check that L_REQ and L_STA reach the CPU and that the chip has its clock and is out of reset; then allow "
          "more polls."};
    case DSDPV1_ERR_CHIP_SILENT:
      return {
          "D18, 8-5",
          "Check clock, RESET, R_REQ and R_STA: while one of the two stays high the chip cannot come to the DPRAM."};
    case DSDPV1_ERR_CHIP_NOT_READY:
      return {
          "H6, 8-6",
          "Wait 86 us or more after RESET rises (4096 cycles); check the read timing with B000..B003 = 01 0D 07 01."};
    case DSDPV1_ERR_NO_REPLY:
      return {"R11, SP11, UA2",
              "Check the straps MODE, ADR and UBR against the port, its wiring, and that the chip is out of reset."};
    case DSDPV1_ERR_REPLY: return {"R15", "Check clock or baud rate, edges and wiring: replies arrive changed."};
    case DSDPV1_ERR_TELEGRAM:
      return {
          "SP10, UA13",
          "Check the port's serial.error_code and the chip's TELEGRAM_ reasons in the log; repeated CRC errors come "
          "from the wiring."};
    case DSDPV1_ERR_NOT_INITIALISED: return {"8-2", "Call dsdpv1_initialise first and check its return value."};
    case DSDPV1_ERR_CONFIG_ADDRESS: return {"D7, T2-021", "Give a station address from 0 to 126."};
    case DSDPV1_ERR_CONFIG_INPUT: return {"D7, T2-027", "Give a largest length from 0 to 244."};
    case DSDPV1_ERR_CONFIG_OUTPUT: return {"D7, T2-028", "Give a largest length from 0 to 244."};
    case DSDPV1_ERR_CONFIG_DIAG: return {"D7, T2-029", "Give a largest diagnosis length from 0 to 238."};
    case DSDPV1_ERR_CONFIG_PRM: return {"D7, T2-02A", "Give a largest length of the user parameters from 0 to 237."};
    case DSDPV1_ERR_CONFIG_CFG: return {"D7, T2-02C", "Give a largest configuration length from 1 to 200."};
    case DSDPV1_ERR_CONFIG_CFG_LENGTH:
      return {"D7, T2-02E", "Pass the configuration bytes, no more than their largest length."};
    case DSDPV1_ERR_CONFIG_PRM_MODE: return {"D11, T2-02B", kModes};
    case DSDPV1_ERR_CONFIG_CFG_MODE: return {"D11, T2-02D", kModes};
    case DSDPV1_ERR_INIT_TIMEOUT:
      return {"H5, T10-B010.2",
              "Check that R_REQ and R_STA fall after each hold and that the chip runs; then allow more polls."};
    case DSDPV1_ERR_INIT_CRC: return {"D7, T4-B00B.0", kWriteTiming};
    case DSDPV1_ERR_INIT_LIMIT:
      return {"D7, M2.T8-013.0", "See the chip's INIT_ reason in the log; it names the byte."};
    case DSDPV1_ERR_INIT_REFUSED: return {"D7, 4.1.1-3", "Check the read timing of B00A, B00B and B013."};
    case DSDPV1_ERR_INPUT_LENGTH: return {"D10, T2-130", "Pass no more input bytes than max_input."};
    case DSDPV1_ERR_INPUT_CRC: return {"D3, D5, 4.2-5, T4-B00B.2", kWriteTiming};
    case DSDPV1_ERR_OUTPUT_LENGTH:
      return {"2-16, T2-028, T2-319", "Make the buffer as large as max_output; if it is, check the read timing."};
    case DSDPV1_ERR_OUTPUT_CRC: return {"D3, T7-B00D.2", kReadTiming};
    case DSDPV1_ERR_DIAG_TYPE: return {"D14, T22-0", "Use one of the five types of table 22."};
    case DSDPV1_ERR_DIAG_LENGTH: return {"D14, T2-228", "Shorten the diagnosis or initialise with a larger max_diag."};
    case DSDPV1_ERR_DIAG_TIMEOUT:
      return {"H5, T10-B010.1", "Check that R_REQ and R_STA fall after each hold; then allow more polls."};
    case DSDPV1_ERR_DIAG_CRC: return {"D3, D5, 4.2-5, T4-B00B.3", kWriteTiming};
    case DSDPV1_ERR_PRM_LENGTH: return {"2-13, T2-410", kReadTiming};
    case DSDPV1_ERR_PRM_CRC: return {"D3, T7-B00D.1", kReadTiming};
    case DSDPV1_ERR_CFG_LENGTH: return {"2-15, T2-500", kReadTiming};
    case DSDPV1_ERR_CFG_CRC: return {"D3, T7-B00D.0", kReadTiming};
    case DSDPV1_ERR_NO_VERDICT_DUE: return {"H7", "Send a verdict once for each block, and only in judging mode 2."};
    case DSDPV1_ERR_VERDICT_STALE: return {"H7", "Call dsdpv1_service: it hands over the newer block."};
    case DSDPV1_ERR_TABLE:
      return {
          "M5-slots, M1-6, V14",
          "Give each slot and index once, 0 <= min_length <= max_length <= 240, services and classes, and data or a "
          "handler for each service."};
    case DSDPV1_ERR_IM0: return {"M1-8", "Give texts of at most 20 and 16 characters."};
    case DSDPV1_ERR_C1_LENGTH: return {"7.2-3, T2-5D1", kReadTiming};
    case DSDPV1_ERR_C1_CRC: return {"D3, T7-B00D.4", kReadTiming};
    case DSDPV1_ERR_C2_LENGTH: return {"7.3-3, T2-6D0", kReadTiming};
    case DSDPV1_ERR_C2_CRC: return {"D3, T7-B00D.3", kReadTiming};
    case DSDPV1_ERR_ANSWER_LENGTH: return {"V14", "Answer with 0 to 240 bytes."};
    case DSDPV1_ERR_NO_REQUEST_OPEN: return {"V14", "Answer each deferred request once."};
    case DSDPV1_ERR_ANSWER_STALE: return {"V13, V14", "Forget the request: its master no longer waits for the answer."};
  }
  return {"", ""};
}

/// The text with example values: for levels and words the first listed in the text, else numbers and addresses.
std::string example_of(profibus::Reason reason) {
  const std::string text = dsdpv1::text_template(reason);
  const auto has = [&text](const char* words) { return text.find(words) != std::string::npos; };
  const bool is_choice = (has("(0") || has("(1 ") || has(": 0 ") || has(" = ")) && !has("needed");
  profibus::Event event{0, reason, 5, 12, 1};
  if (is_choice) event = {0, reason, 1, 1, 0};
  if (has("{a:4x}")) event.a = 0x0CC9;
  if (has("{a:high}")) event.a = 0x015F;
  if (has("12.500 ns")) event.b = 120;
  if (has("31.250 ns")) event.b = 360;
  if (has("{a:ns}")) event.a = 480, event.b = 600;
  if (has("{b:4x}")) event.b = 0x1234;
  const std::string example = dsdpv1::describe(event);
  return example == text ? "" : example;
}

std::vector<CodeText> chip_codes() {
  std::vector<CodeText> list;
  for (const profibus::Reason reason : dsdpv1::reasons())
    list.push_back({profibus::code(reason), tb::name(profibus::severity(reason)), reason.row().source,
                    dsdpv1::text_template(reason), dsdpv1::advice(reason), example_of(reason)});
  return list;
}

std::vector<CodeText> driver_codes() {
  return {
#define X(name, value, text) \
  {#name, (name) == DSDPV1_OK ? "info" : "refusal", explain(name).source, #value ": " text, explain(name).advice},
      DSDPV1_ERROR_TABLE(X)
#undef X
  };
}

std::vector<CodeText> process_codes() {
  return {{user_cpu::kProcessEnded, "violation", "host process",
           "a program of kind: process has ended, or does not call its port; its chip goes on without a user",
           "Look at its exit code or signal. With a debugger at the program set user_cpu.patience=0s."}};
}

}  // namespace

const std::vector<CodeTable>& dsdpv1_codes() {
  static const std::vector<CodeTable> tables = {
      {"The chip", "`{a}`, `{b}`, `{c}` stand for values; `{a:4x}` is hexadecimal, `{a:ns}` a time.", chip_codes()},
      {"The driver", "Results of the C driver's calls, with their values.", driver_codes()},
      board_codes(),
      {"The host process", "See [C driver on the host](tutorials/c_driver_on_host.md).", process_codes()}};
  return tables;
}

}  // namespace dsdpv1::tb
