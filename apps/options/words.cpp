#include "apps/options/words.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

#include "bus/baud.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "io/input/units.hpp"

namespace dsdpv1::app {

void check_word(const std::string& option, const std::string& word, const std::vector<std::string>& allowed) {
  if (std::find(allowed.begin(), allowed.end(), word) != allowed.end()) return;
  throw tb::InputError(option + " is " + word + tb::did_you_mean(word, allowed) + ", expected " + tb::join(allowed));
}

int baud_index(const std::string& option, const std::string& word) {
  std::vector<std::string> allowed;
  allowed.reserve(std::size(bus::kBauds));
  for (const bus::Baud& baud : bus::kBauds) allowed.emplace_back(baud.name);
  check_word(option, word, allowed);
  return *bus::baud_index(word);
}

bus::Tick time_of(const std::string& option, const std::string& text, bus::Tick least) {
  const std::optional<bus::Tick> time = tb::parse_time(text);
  if (!time || *time < least) throw tb::InputError(option + " is " + text + ", expected " + tb::kTimeForm);
  return *time;
}

}  // namespace dsdpv1::app
