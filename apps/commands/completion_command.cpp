// completion: the program's own options as completions of shells, so that they cannot go stale.
#include <fmt/format.h>

#include <iostream>

#include "apps/commands/command.hpp"
#include "apps/options/shown_options.hpp"
#include "apps/options/words.hpp"

namespace dsdpv1::app {
namespace {

std::string option_words(const CLI::App& command) {
  std::string words;
  for (const CLI::Option* option : shown_options(command))
    for (const std::string& word : spellings(*option)) words += (words.empty() ? "" : " ") + word;
  return words;
}

std::string command_words(const CLI::App& app) {
  std::string words;
  for (const CLI::App* command : shown_commands(app)) words += (words.empty() ? "" : " ") + command->get_name();
  return words;
}

// The command is the first word that is one; before it and for it the options that fit, everywhere else names of files.
constexpr const char* kBash = R"(# bash completion for {0}, made by `{0} completion bash`.
_dsdpv1_sim() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} commands="{1}" command="" each words
  for each in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    if [[ -z $command && " $commands " == *" $each "* ]]; then command=$each; fi
  done
  case $command in
    "") words="$commands {2}" ;;
{3}  esac
  COMPREPLY=()
  if [[ -z $command || $word == -* ]]; then
    while IFS= read -r each; do COMPREPLY+=("$each"); done < <(compgen -W "$words" -- "$word")
  fi
}}
complete -o default -F _dsdpv1_sim {0}
)";

std::string bash(const CLI::App& app) {
  std::string cases;
  for (const CLI::App* command : shown_commands(app))
    cases += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(), option_words(*command));
  return fmt::format(kBash, app.get_name(), command_words(app), option_words(app), cases);
}

/// A description of zsh's _arguments and _describe, in single quotes.
std::string in_zsh(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return result;
}

std::string zsh_option(const CLI::Option& option) {
  std::string text;
  for (const std::string& word : spellings(option))
    text += fmt::format(" \\\n        '{}{}[{}]{}'", option.get_items_expected_max() > 1 ? "*" : "", word,
                        in_zsh(option.get_description()),
                        takes_value(option) ? ":" + in_zsh(value_word(option)) + ":_files" : "");
  return text;
}

std::string zsh_case(const CLI::App& command) {
  std::string text = fmt::format("    {})\n      _arguments", command.get_name());
  for (const CLI::Option* option : shown_options(command)) text += zsh_option(*option);
  return text + " \\\n        '*:file:_files' ;;\n";
}

constexpr const char* kZsh = R"(#compdef {0}
# zsh completion for {0}, made by `{0} completion zsh`.
local -a commands
commands=(
{1})
if (( CURRENT == 2 )); then
  _describe command commands
else
  shift words
  (( CURRENT-- ))
  case $words[1] in
{2}  esac
fi
)";

std::string zsh(const CLI::App& app) {
  std::string commands, cases;
  for (const CLI::App* command : shown_commands(app)) {
    commands += fmt::format("  '{}:{}'\n", command->get_name(), in_zsh(command->get_description()));
    cases += zsh_case(*command);
  }
  return fmt::format(kZsh, app.get_name(), commands, cases);
}

class Completion : public Command {
 public:
  Completion() : Command("completion", "Print the completion of this program's command line for a shell") {}

  bool shows_all() const override { return true; }

  void options(CLI::App& app) override {
    program_ = app.get_parent();
    shell_ = app.add_option("SHELL", "bash or zsh")->required();
    app.footer(
        "\nExamples:\n  source <(dsdpv1-sim completion bash)\n"
        "  dsdpv1-sim completion zsh > ~/.zfunc/_dsdpv1-sim\n");
  }

  int carry_out() override {
    const auto shell = shell_->as<std::string>();
    check_word("dsdpv1-sim completion: SHELL", shell, {"bash", "zsh"});
    std::cout << (shell == "bash" ? bash(*program_) : zsh(*program_)) << std::flush;
    return kPassed;
  }

 private:
  const CLI::App* program_ = nullptr;
  const CLI::Option* shell_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_completion() { return std::make_unique<Completion>(); }

}  // namespace dsdpv1::app
