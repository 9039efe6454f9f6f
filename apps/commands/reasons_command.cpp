// reasons: every code that logs, scenarios and result files may hold, with what to do about it.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "apps/commands/command.hpp"
#include "apps/options/outputs.hpp"
#include "bus/monitor/monitor.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "kinds/dsdpv1/checks/markdown.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/report/text_table.hpp"
#include "tb/scenario/event_codes.hpp"

namespace dsdpv1::app {
namespace {

struct FlagText {
  bus::FlagKind kind;
  const char *meaning, *advice;
};
constexpr FlagText kFlags[] = {
    {bus::FlagKind::kCollision, "two stations drive the line at once",
     "Give each station an address of its own, run one master at a time, and let requests wait for the answer or the "
     "slot time."},
    {bus::FlagKind::kGap, "more than 1 bit time of idle inside a telegram",
     "Send the characters of a telegram without a pause. Slaves ignore such a telegram."},
    {bus::FlagKind::kSynViolated, "a request began less than T_SYN (33 bit times) after the last activity",
     "The master must leave 33 bit times of idle before a request. Slaves ignore it otherwise."},
    {bus::FlagKind::kTsdrEarly, "an answer came before min_TSDR", "Look at min_TSDR of Set_Prm and at who answered."},
    {bus::FlagKind::kTsdrLate, "an answer came after max_TSDR",
     "Look at who answered; MaxTsdr of the GSD file must hold at this baud rate."},
    {bus::FlagKind::kCharacterError, "a character with wrong parity or a low stop bit",
     "Disturbed line, a second sender, or another baud rate or parity than 8E1."},
    {bus::FlagKind::kTelegramError, "a telegram with a wrong delimiter, length or FCS, or one that broke off",
     "Disturbed line, or a sender that builds telegrams wrongly: `dsdpv1-sim decode` explains the bytes."},
    {bus::FlagKind::kUnanswered, "no answer within the slot time",
     "Nothing while masters look for stations or slaves search the baud rate. Else the slave's own reason stands "
     "beside it in the log."},
    {bus::FlagKind::kUnexpectedAnswer, "an answer that nobody asked for, or by the wrong station",
     "Two stations with the same address, or a master whose slot time is too short: its request and the late answer "
     "overlap."},
    {bus::FlagKind::kGlitch, "a low level shorter than half a bit",
     "Disturbed line. The chip ignores it while idle (S10)."},
    {bus::FlagKind::kTwoMasters, "a master sends while another has the token",
     "Masters on one segment must share the token: each takes part in the ring, with an address of its own and the "
     "same slot time."},
};
static_assert(std::size(kFlags) == bus::kFlagKinds);

std::vector<tb::CodeText> bus_codes() {
  std::vector<tb::CodeText> list;
  for (const FlagText& flag : kFlags)
    list.push_back({tb::scenario::flag_code(flag.kind), flag.kind == bus::FlagKind::kUnanswered ? "info" : "violation",
                    flag.meaning, flag.advice});
  return list;
}

void add_check_codes(std::vector<tb::CodeText>& list, const tb::ChipKind& kind) {
  for (const checks::Rule& rule : kind.rules()) {
    const bool known =
        std::any_of(list.begin(), list.end(), [&](const tb::CodeText& each) { return each.code == rule.id; });
    if (known) continue;
    list.push_back({rule.id, "violation", std::string(rule.rule) + " (" + rule.clause + ")", rule.advice});
  }
}

/// Of `kind`, and those that other kinds have besides.
std::vector<tb::CodeText> check_codes(const tb::ChipKind& kind) {
  std::vector<tb::CodeText> list;
  add_check_codes(list, kind);
  for (const tb::ChipKind* other : tb::chip_kinds()) add_check_codes(list, *other);
  return list;
}

void print(std::string& text, const std::vector<tb::CodeText>& reasons) {
  for (const tb::CodeText& each : reasons)
    text += fmt::format("{} ({})\n", each.code, each.severity) +
            tb::named_line("", each.example.empty() ? each.text : "such as: " + each.example, 0) +
            tb::named_line("", each.advice, 0);
}

void print_table(std::string& text, const std::string& head, const std::vector<tb::CodeText>& reasons) {
  text += head + "\n| code | kind | text | what to do |\n|---|---|---|---|\n";
  for (const tb::CodeText& each : reasons)
    text += fmt::format("| `{}` | {} | {} | {} |\n", each.code, each.severity, each.text, each.advice);
}

/// Those of the monitor and of the checks stand beside those of the kind of chip.
std::vector<tb::CodeTable> all_tables(const tb::ChipKind& kind) {
  std::vector<tb::CodeTable> tables = kind.codes();
  tables.push_back({"The bus", "What the bus monitor saw on the line.", bus_codes()});
  if (!kind.rules().empty())
    tables.push_back({"The checks",
                      "What the checks on the user's side found broken, see [checks.md](checks.md). They fail a run "
                      "unless its checks are off or only reported.",
                      check_codes(kind)});
  return tables;
}

std::string as_markdown(const tb::ChipKind& kind) {
  std::string text =
      "# Reasons\n\nGenerated by `dsdpv1-sim reasons --markdown`; do not edit.\n\n"
      "Every code that a log, a result file or a scenario may hold, what it says, and what to do about it. `dsdpv1-sim "
      "reasons CODE` prints one of\n"
      "them. **info**: something was carried out; **refusal**: something that the master or the user asked for was "
      "not; **violation**: a rule was\n"
      "broken, and a scenario that does not allow it fails.\n";
  for (const tb::CodeTable& table : all_tables(kind))
    print_table(text, fmt::format("\n## {}\n\n{}\n", table.title, table.introduction), table.codes);
  return text;
}

std::vector<tb::CodeText> all_codes(const tb::ChipKind& kind) {
  std::vector<tb::CodeText> all;
  for (const tb::CodeTable& table : all_tables(kind)) all.insert(all.end(), table.codes.begin(), table.codes.end());
  return all;
}

/// Codes are upper case; whoever types one need not be.
std::string in_capitals(std::string code) {
  std::transform(code.begin(), code.end(), code.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return code;
}

/// The only one with this code; throws InputError when there is none.
tb::CodeText find_reason(const std::vector<tb::CodeText>& all, const std::string& typed) {
  const std::string code = in_capitals(typed);
  const auto found =
      std::find_if(all.begin(), all.end(), [&code](const tb::CodeText& each) { return each.code == code; });
  if (found != all.end()) return *found;
  std::vector<std::string> codes;
  codes.reserve(all.size());
  for (const tb::CodeText& each : all) codes.push_back(each.code);
  throw tb::InputError(
      fmt::format("dsdpv1-sim reasons: unknown code {}{}, allowed are those that `dsdpv1-sim reasons` prints", typed,
                  tb::did_you_mean(code, codes)));
}

std::string as_text(const tb::ChipKind& kind, const std::string& code) {
  const std::vector<tb::CodeText> all = all_codes(kind);
  std::string text;
  print(text, code.empty() ? all : std::vector<tb::CodeText>{find_reason(all, code)});
  return text;
}

class Reasons : public Command {
 public:
  Reasons() : Command("reasons", "Explains the codes of logs and results: what happened, what to do") {}

  void options(CLI::App& app) override {
    app.add_option("CODE", code_, "Only this one, in capitals or not");
    CLI::Option* markdown = app.add_flag("--markdown", markdown_, "Prints docs/reasons.md instead");
    app.add_flag("--checks", checks_, "Prints docs/checks.md instead")->excludes(markdown);
    app.add_option("--output,-o", output_, "Into this file");
    app.footer("\nExamples:\n  dsdpv1-sim reasons prm_ident\n  dsdpv1-sim reasons | less\n");
  }

  int carry_out() override {
    const tb::ChipKind& kind = *tb::chip_kinds().front();
    const std::string text = checks_ ? checks::markdown() : markdown_ ? as_markdown(kind) : as_text(kind, code_);
    return print_or_write("dsdpv1-sim reasons", text, output_);
  }

 private:
  std::string code_;  ///< only this one; empty: all
  bool markdown_ = false, checks_ = false;
  std::string output_;
};

}  // namespace

std::unique_ptr<Command> make_reasons() { return std::make_unique<Reasons>(); }

}  // namespace dsdpv1::app
