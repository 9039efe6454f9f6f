// A scenario: read and checked, not run. Lines "#set PATH=VALUE" at its beginning are settings of a command line.
#include "tb/scenario/scenario.hpp"

#include "io/input/input_error.hpp"
#include "tests/fuzz/input.hpp"

namespace dsdpv1 {
namespace {

std::vector<tb::scenario::Setting> settings(const std::string& text) {
  const std::string mark = "#set ";
  std::vector<std::string> lines;
  for (std::size_t at = 0; text.compare(at, mark.size(), mark) == 0;) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at + mark.size(), end - at - mark.size()));
    at = end + 1;
    if (at > text.size()) break;
  }
  return tb::scenario::parse_settings(lines);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const tb::scenario::Scenario scenario = tb::scenario::parse(text, "a.yaml", settings(text));
    fuzz::promise(!scenario.slaves.empty() && scenario.kind != nullptr, "a scenario has a slave and a kind of chip");
  } catch (const tb::InputError& error) {
    fuzz::promise(*error.what() != '\0', "an error has words");
  }
  return 0;
}

}  // namespace dsdpv1
