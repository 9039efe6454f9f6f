#include "tb/scenario/event_codes.hpp"

#include <cctype>
#include <map>

namespace dsdpv1::tb::scenario {

std::string flag_code(bus::FlagKind kind) {
  std::string code = "BUS_";
  for (const char* c = bus::name(kind); *c != '\0'; ++c) {
    code += std::isalnum(static_cast<unsigned char>(*c)) != 0
                ? static_cast<char>(std::toupper(static_cast<unsigned char>(*c)))
                : '_';
  }
  return code;
}

const std::vector<std::string>& all_codes(const ChipKind& kind) {
  static std::map<const ChipKind*, std::vector<std::string>> all;
  std::vector<std::string>& list = all[&kind];
  if (!list.empty()) return list;
  for (const CodeTable& table : kind.codes())
    for (const CodeText& each : table.codes) list.push_back(each.code);
  for (std::size_t flag = 0; flag < bus::kFlagKinds; ++flag)
    list.push_back(flag_code(static_cast<bus::FlagKind>(flag)));
  for (const checks::Rule& rule : kind.rules()) list.emplace_back(rule.id);
  return list;
}

}  // namespace dsdpv1::tb::scenario
