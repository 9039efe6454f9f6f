#include "tb/scenario/event_codes.hpp"

#include <cctype>

#include "model/dsdpv1/reasons.hpp"
#include "tb/checks/check.hpp"

namespace tb::scenario {

std::string flag_code(bus::FlagKind kind) {
  std::string code = "BUS_";
  for (const char* c = bus::name(kind); *c != '\0'; ++c) {
    code += std::isalnum(static_cast<unsigned char>(*c)) != 0
                ? static_cast<char>(std::toupper(static_cast<unsigned char>(*c)))
                : '_';
  }
  return code;
}

std::string driver_error_code(dsdpv1_error error) {
#define X(name, value, text) \
  if (error == (name)) return #name;
  DSDPV1_ERROR_TABLE(X)
#undef X
  return "DSDPV1_ERR_UNKNOWN";
}

const std::vector<std::string>& all_codes() {
  static const std::vector<std::string> codes = [] {
    std::vector<std::string> list;
    for (const profibus::Reason reason : dsdpv1::reasons()) list.emplace_back(profibus::code(reason));
#define X(name, value, text) list.emplace_back(#name);
    DSDPV1_ERROR_TABLE(X)
#undef X
    for (std::size_t kind = 0; kind < bus::kFlagKinds; ++kind)
      list.push_back(flag_code(static_cast<bus::FlagKind>(kind)));
    list.emplace_back(kFirmwareFault);
    for (const checks::Check check : checks::kAllChecks) list.emplace_back(checks::rule(check).id);
    return list;
  }();
  return codes;
}

}  // namespace tb::scenario
