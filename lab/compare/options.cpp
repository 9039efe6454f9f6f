#include "lab/compare/options.hpp"

#include "io/input/input_error.hpp"

namespace dsdpv1::tb::compare {

Mask parse_mask(const std::string& text) {
  const std::size_t equal = text.find('='), at = text.rfind('@');
  const bool not_equal = equal != std::string::npos && equal > 0 && text[equal - 1] == '!';
  const std::size_t name = equal - (not_equal ? 1 : 0);
  const bool target = at != std::string::npos && at > equal;
  const std::string value =
      equal == std::string::npos ? "" : text.substr(equal + 1, target ? at - equal - 1 : std::string::npos);
  if (equal == std::string::npos || name == 0 || value.empty() || (target && at + 1 == text.size()))
    throw InputError("dsdpv1-sim compare: --mask is " + text +
                     ", expected SIGNAL=VALUE, SIGNAL!=VALUE, and with @SIGNAL after it for one signal alone");
  return {text.substr(0, name), value, !not_equal, target ? text.substr(at + 1) : ""};
}

Clock parse_clock(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const std::string edge = colon == std::string::npos ? "" : text.substr(colon);
  if (edge == ":rise" || edge == ":fall") return {text.substr(0, colon), edge == ":rise"};
  return {text, true};
}

NamedPair parse_pair(const std::string& text) {
  const std::size_t equal = text.find('=');
  const bool inverted = equal != std::string::npos && text.compare(equal, 2, "=!") == 0;
  NamedPair pair;
  pair.a = text.substr(0, equal);
  pair.inverted = inverted;
  if (equal != std::string::npos) pair.b = text.substr(equal + (inverted ? 2 : 1));
  if (pair.a.empty() || pair.b.empty())
    throw InputError("dsdpv1-sim compare: --signal is " + text + ", expected A=B and, for the other level, A=!B");
  return pair;
}

}  // namespace dsdpv1::tb::compare
