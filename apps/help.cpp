#include "apps/help.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

#include "apps/options/shown_options.hpp"
#include "apps/terminal.hpp"
#include "io/input/suggest.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::app {
namespace {

constexpr std::size_t kColumns = 80;  ///< where it goes to no terminal
constexpr std::size_t kNames = 24;    ///< that commands and options take beside their text

tb::TableWidth help_width() {
  const std::size_t columns = terminal_columns();
  return tb::TableWidth(columns == tb::TableWidth::kUnlimited ? kColumns : columns);
}

/// The text beside the name, or below a long one.
std::string entry(const std::string& name, const std::string& text) {
  const tb::TableWidth width = help_width();
  if (name.size() <= kNames) return tb::named_line(name, text, kNames);
  return tb::line_of(name) + tb::named_line("", text, kNames);
}

std::string option_name(const CLI::Option& option, bool is_positional) {
  if (is_positional) return option.get_name(true);
  std::string name = tb::join(spellings(option));
  if (takes_value(option)) name += " " + value_word(option);
  return name;
}

std::string option_text(const CLI::Option& option) {
  std::string text = option.get_description();
  if (takes_value(option) && !option.get_default_str().empty()) text += " (default: " + option.get_default_str() + ")";
  return option.nonpositional() && option.get_required() ? text + " (required)" : text;
}

}  // namespace

std::string Help::make_description(const CLI::App* app) const {
  const tb::TableWidth width = help_width();
  return tb::wrapped_text(app->get_description()) + "\n";
}

std::string Help::make_subcommand(const CLI::App* command) const {
  const tb::TableWidth width = help_width();
  return tb::named_line(command->get_name(), command->get_description(), 10);
}

std::string Help::make_option(const CLI::Option* option, bool is_positional) const {
  return entry(option_name(*option, is_positional), option_text(*option));
}

/// Lines of commands stay as they are, long ones are continued after a backslash; other lines become paragraphs.
std::string Help::make_footer(const CLI::App* app) const {
  const tb::TableWidth width = help_width();
  const std::string footer = app->get_footer();
  std::istringstream lines(footer.substr(std::min(footer.find_first_not_of('\n'), footer.size())));
  std::string text, paragraph;
  const auto end_paragraph = [&] {
    if (!paragraph.empty()) text += tb::wrapped_text(paragraph);
    paragraph.clear();
  };
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == ' ' || line.back() == ':') end_paragraph();
    if (line.empty() || line[0] == ' ')
      text += tb::command_lines(line);
    else
      paragraph += (paragraph.empty() ? "" : " ") + line;
  }
  end_paragraph();
  return text;
}

}  // namespace dsdpv1::app
