#include "tb/scenario/event_codes.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>

namespace dsdpv1::tb::scenario {
namespace {

struct FlagText {
  bus::FlagKind kind;
  const char *source, *meaning, *advice;
};
constexpr FlagText kFlags[] = {
    {bus::FlagKind::kCollision, "PROFIBUS facts", "two stations drive the line at once",
     "Give each station a separate address, run one master at a time, and let requests wait for the answer or the "
     "slot time."},
    {bus::FlagKind::kGap, "S10", "more than 1 bit time of idle inside a telegram",
     "Send the characters of a telegram without a pause. Slaves ignore such a telegram."},
    {bus::FlagKind::kSynViolated, "S3", "a request began less than T_SYN (33 bit times) after the last activity",
     "The master must leave 33 bit times of idle before a request. Slaves ignore it otherwise."},
    {bus::FlagKind::kTsdrEarly, "S3, S11", "an answer came before min_TSDR",
     "Check min_TSDR of Set_Prm and the station that answered."},
    {bus::FlagKind::kTsdrLate, "S3, M11-4", "an answer came after max_TSDR",
     "Check the station that answered; MaxTsdr of the GSD file must hold at this baud rate."},
    {bus::FlagKind::kCharacterError, "PROFIBUS facts", "a character with wrong parity or a low stop bit",
     "Disturbed line, a second sender, or another baud rate or parity than 8E1."},
    {bus::FlagKind::kTelegramError, "PROFIBUS facts",
     "a telegram with a wrong delimiter, length or FCS, or one that broke off",
     "Disturbed line, or a sender that builds telegrams wrongly: `dsdpv1-sim decode` explains the bytes."},
    {bus::FlagKind::kUnanswered, "PROFIBUS facts", "no answer within the slot time",
     "Nothing while masters look for stations or slaves search the baud rate. Else the log has the slave's reason "
     "beside it."},
    {bus::FlagKind::kUnexpectedAnswer, "PROFIBUS facts", "an answer without a request, or by the wrong station",
     "Two stations with the same address, or a master whose slot time is too short: its request and the late answer "
     "overlap."},
    {bus::FlagKind::kGlitch, "S10", "a low level shorter than half a bit",
     "Disturbed line. The chip ignores it while idle (S10)."},
    {bus::FlagKind::kTwoMasters, "PROFIBUS facts", "a master sends while another has the token",
     "Masters on one segment must share the token: each takes part in the ring, with a separate address and the same "
     "slot time."},
};
static_assert(std::size(kFlags) == bus::kFlagKinds);

}  // namespace

std::string flag_code(bus::FlagKind kind) {
  std::string code = "BUS_";
  for (const char* c = bus::name(kind); *c != '\0'; ++c) {
    code += std::isalnum(static_cast<unsigned char>(*c)) != 0
                ? static_cast<char>(std::toupper(static_cast<unsigned char>(*c)))
                : '_';
  }
  return code;
}

std::vector<CodeText> flag_codes() {
  std::vector<CodeText> list;
  for (const FlagText& flag : kFlags)
    list.push_back({flag_code(flag.kind), flag.kind == bus::FlagKind::kUnanswered ? "info" : "violation", flag.source,
                    flag.meaning, flag.advice});
  return list;
}

CodeText host_code() {
  return {kHostEarly, "violation", "PROFIBUS facts",
          "a telegram of serve's host came before the answer to its request before had left",
          "The master must wait for the answer or the slot time before it sends again. It fails a run with --strict."};
}

const std::vector<std::string>& all_codes(const ChipKind& kind) {
  static std::map<const ChipKind*, std::vector<std::string>> all;
  std::vector<std::string>& list = all[&kind];
  if (!list.empty()) return list;
  for (const CodeTable& table : kind.codes())
    for (const CodeText& each : table.codes) list.push_back(each.code);
  for (std::size_t flag = 0; flag < bus::kFlagKinds; ++flag)
    list.push_back(flag_code(static_cast<bus::FlagKind>(flag)));
  list.emplace_back(kHostEarly);
  for (const checks::Rule& rule : kind.rules()) list.emplace_back(rule.id);
  return list;
}

bool is_code(const ChipKind& kind, const std::string& code) {
  const auto& reasons = kind.reasons();
  const auto has_code = [&code](profibus::Reason each) { return code == profibus::code(each); };
  if (std::any_of(reasons.begin(), reasons.end(), has_code)) return true;
  const std::vector<std::string>& all = all_codes(kind);
  return std::find(all.begin(), all.end(), code) != all.end();
}

}  // namespace dsdpv1::tb::scenario
