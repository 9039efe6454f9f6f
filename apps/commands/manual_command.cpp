// manual: the program's own options as a manual page in roff, for man(1), so that it cannot go stale.
#include <fmt/format.h>

#include <iostream>

#include "apps/commands/command.hpp"
#include "apps/options/shown_options.hpp"
#include "io/input/suggest.hpp"

namespace dsdpv1::app {
namespace {

/// A text of roff: every - as it is typed, no \, nothing that begins a line as a request.
std::string roff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool begins = result.empty() || result.back() == '\n';
    if (begins && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string value(const CLI::Option& option) {
  if (!takes_value(option)) return "";
  const std::string usual = option.get_default_str();
  return " " + italic(value_word(option)) + (usual.empty() ? "" : roff(" (default: " + usual + ")"));
}

std::string paragraph(const std::string& head, const std::string& text) {
  return ".TP\n" + head + "\n" + roff(text) + "\n";
}

std::string option_paragraph(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : spellings(option)) names.push_back(bold(name));
  return paragraph(tb::join(names) + value(option), option.get_description());
}

/// Examples and exit codes, line by line as --help shows them.
std::string footer(const CLI::App& command) {
  const std::string text = command.get_footer();
  return text.empty() ? ""
                      : ".PP\n.nf\n" + roff(text.substr(text.find_first_not_of('\n'))) +
                            (text.back() == '\n' ? "" : "\n") + ".fi\n";
}

std::string command_section(const CLI::App& command) {
  std::string text = fmt::format(".SS \"{}\"\n{}\n", roff(command.get_name() + arguments_of(command) + " [OPTIONS]"),
                                 roff(command.get_description()));
  for (const CLI::Option* option : shown_positionals(command))
    text += paragraph(bold(option->get_name(true)), option->get_description());
  for (const CLI::Option* option : shown_options(command)) text += option_paragraph(*option);
  return text + footer(command);
}

std::string manual_page(const CLI::App& app) {
  const std::string& name = app.get_name();
  std::string text = fmt::format(".\\\" Made by `{} manual`.\n.TH {} 1 \"\" \"{}\" \"User Commands\"\n", name,
                                 CLI::detail::to_lower(name), roff(app.version()));
  text += fmt::format(".SH NAME\n{} \\- {}\n", roff(name), roff(app.get_description()));
  text += fmt::format(".SH SYNOPSIS\n{} {} [{}]\n", bold(name), italic("COMMAND"), italic("ARGUMENTS"));
  text += ".SH OPTIONS\n";
  for (const CLI::Option* option : shown_options(app)) text += option_paragraph(*option);
  text += ".SH COMMANDS\n";
  for (const CLI::App* command : shown_commands(app)) text += command_section(*command);
  return text + ".SH EXAMPLES AND EXIT CODES\n" + footer(app);
}

class Manual : public Command {
 public:
  Manual() : Command("manual", "Print the manual page of this program, in roff") {}

  bool shows_all() const override { return true; }

  void options(CLI::App& app) override {
    program_ = app.get_parent();
    app.footer("\nExample:\n  dsdpv1-sim manual | man -l -\n");
  }

  int carry_out() override {
    std::cout << manual_page(*program_) << std::flush;
    return kPassed;
  }

 private:
  const CLI::App* program_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_manual() { return std::make_unique<Manual>(); }

}  // namespace dsdpv1::app
