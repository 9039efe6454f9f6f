#pragma once
// The part of the command line in --help, manual pages and completions: commands and options that are not hidden.
#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace dsdpv1::app {

inline std::vector<const CLI::App*> shown_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

inline std::vector<const CLI::Option*> shown_options(const CLI::App& command) {
  return command.get_options(
      [](const CLI::Option* option) { return option->nonpositional() && !option->get_group().empty(); });
}

inline std::vector<const CLI::Option*> shown_positionals(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return option->get_positional(); });
}

inline bool takes_value(const CLI::Option& option) { return option.get_type_size() != 0; }

/// The placeholder of the option's value: "FILE", "TIME", "PATH=VALUE".
std::string value_word(const CLI::Option& option);

/// The required and optional arguments, without options: " CAPTURE --as ADDRESS", " [SCENARIO]".
std::string arguments_of(const CLI::App& command);

/// -q, --quiet
inline std::vector<std::string> spellings(const CLI::Option& option) {
  std::vector<std::string> words;
  for (const std::string& name : option.get_snames()) words.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) words.push_back("--" + name);
  return words;
}

}  // namespace dsdpv1::app
