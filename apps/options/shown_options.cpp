#include "apps/options/shown_options.hpp"

#include <algorithm>
#include <iterator>

namespace dsdpv1::app {
namespace {

struct Word {
  const char* option;
  const char* word;
};

/// Words for the values of options with the same name in all commands. Others set their word by type_name.
constexpr Word kWords[] = {{"as", "ADDRESS"},
                           {"baud", "RATE"},
                           {"build", "FOLDER"},
                           {"capture", "FILE"},
                           {"chip", "FILE"},
                           {"clock", "SIGNAL"},
                           {"difference", "FILE"},
                           {"directed", "FOLDER"},
                           {"folder", "FOLDER"},
                           {"for", "TIME"},
                           {"from", "TIME"},
                           {"gdb", "PORT"},
                           {"golden", "FOLDER"},
                           {"gsd", "FILE"},
                           {"json", "FILE"},
                           {"junit", "FILE"},
                           {"list", "FILE"},
                           {"log", "FILE"},
                           {"map", "FILE"},
                           {"out", "FOLDER"},
                           {"output", "FILE"},
                           {"param", "PATH=VALUES"},
                           {"pins", "FILE"},
                           {"pty", "LINK"},
                           {"rate", "RATE"},
                           {"replay", "FILE"},
                           {"report", "FILE"},
                           {"restore", "FILE"},
                           {"result", "FILE"},
                           {"rtl", "FOLDER"},
                           {"scenario", "FILE"},
                           {"scope", "SCOPE"},
                           {"scope-a", "SCOPE"},
                           {"scope-b", "SCOPE"},
                           {"serial", "DEVICE"},
                           {"set", "PATH=VALUE"},
                           {"shift", "TIME"},
                           {"signal", "NAME"},
                           {"state", "FOLDER"},
                           {"station", "ADDRESS"},
                           {"stimulus", "FILE"},
                           {"table", "FILE"},
                           {"tcp", "PORT"},
                           {"time-limit", "SECONDS"},
                           {"to", "TIME"},
                           {"tolerance", "TIME"},
                           {"top", "MODULE"},
                           {"trace", "FILE"},
                           {"tsv", "FILE"},
                           {"turn", "SECONDS"},
                           {"wave", "FILE"},
                           {"wave-around", "TIME"},
                           {"wave-from", "TIME"},
                           {"wave-on", "CODE"},
                           {"wave-signals", "PATTERN"},
                           {"wave-to", "TIME"}};

}  // namespace

std::string value_word(const CLI::Option& option) {
  const std::string type = option.get_type_name();  // followed by the texts of its checks
  std::string word = type.substr(0, type.find(':'));
  const bool is_text = word.rfind("TEXT", 0) == 0, is_number = word == "INT" || word == "UINT" || word == "FLOAT";
  if (!is_text && !is_number) return word;
  const std::vector<std::string>& names = option.get_lnames();
  const auto known = std::find_if(std::begin(kWords), std::end(kWords), [&names](const Word& each) {
    return !names.empty() && names.front() == each.option;
  });
  if (known != std::end(kWords)) return known->word;
  return is_text ? "WORD" : "NUMBER";
}

std::string arguments_of(const CLI::App& command) {
  std::string words;
  for (const CLI::Option* option : shown_positionals(command))
    words += option->get_required() ? " " + option->get_name(true) : " [" + option->get_name(true) + "]";
  for (const CLI::Option* option : shown_options(command))
    if (option->get_required()) words += " --" + option->get_lnames().front() + " " + value_word(*option);
  return words;
}

}  // namespace dsdpv1::app
