#include "apps/command_line.hpp"

#include <algorithm>
#include <iostream>
#include <optional>
#include <utility>

#include "apps/commands/command.hpp"
#include "apps/help.hpp"
#include "apps/options/shown_options.hpp"
#include "apps/options/words.hpp"
#include "apps/terminal.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::app {
namespace {

constexpr const char* kRun = "Run scenarios";
constexpr const char* kLook = "Look into runs, captures and files";
constexpr const char* kRtl = "Model and RTL";
constexpr const char* kBeside = "Beside them";

struct Entry {
  const char* group;
  std::unique_ptr<Command> (*make)();
};

/// In the order of --help.
constexpr Entry kCommands[] = {{kRun, make_demo},       {kRun, make_run},        {kRun, make_serve},
                               {kRun, make_sweep},      {kRun, make_regress},    {kRun, make_accept},
                               {kLook, make_decode},    {kLook, make_compare},   {kLook, make_replay},
                               {kLook, make_calibrate}, {kLook, make_recover},   {kLook, make_gsd},
                               {kLook, make_reasons},   {kRtl, make_cosim},      {kRtl, make_rtl_random},
                               {kRtl, make_rtl_faults}, {kRtl, make_verify_rtl}, {kRtl, make_traces},
                               {kBeside, make_schema},  {kBeside, make_manual},  {kBeside, make_completion}};

using Commands = std::vector<std::unique_ptr<Command>>;

Commands make_commands() {
  Commands commands;
  for (const Entry& entry : kCommands) commands.push_back(entry.make());
  return commands;
}

/// Before the command and after it.
void add_color_option(CLI::App& app, std::string& word) {
  app.add_option("--color", word, "Verdicts in colour: auto (on a terminal, unless NO_COLOR is set), always, never")
      ->capture_default_str();
}

/// Only those that may be called have their options: it takes longer to say them all than to start many a run.
void add_commands(CLI::App& app, const Commands& commands, const std::vector<std::string>& words, std::string& color) {
  const auto is_named = [&words](const Command& command) {
    return std::find(words.begin(), words.end(), command.name()) != words.end();
  };
  const bool all = std::any_of(commands.begin(), commands.end(),
                               [&](const auto& each) { return each->shows_all() && is_named(*each); });
  for (std::size_t i = 0; i < commands.size(); ++i) {
    Command& command = *commands[i];
    CLI::App& added = *app.add_subcommand(command.name(), command.line())->group(kCommands[i].group);
    if (!all && !is_named(command)) continue;
    command.options(added);
    add_color_option(added, color);
  }
}

void describe_program(CLI::App& app) {
  app.set_version_flag("--version", "dsdpv1-sim " DSDPV1_VERSION);
  app.require_subcommand(1);
  app.footer(std::string("\nExamples:\n  dsdpv1-sim demo\n  dsdpv1-sim run scenarios/power_on_12m.yaml --wave "
                         "out.fst\n  dsdpv1-sim gsd "
                         "scenarios/dsdpv1.gsd\n"
                         "  dsdpv1-sim decode capture.txt\n  dsdpv1-sim run --help\n") +
             kExitCodes);
}

/// The command that was called, or the one of it.
CLI::App& called_of(CLI::App& app) {
  CLI::App* called = &app;
  while (!called->get_subcommands().empty()) called = called->get_subcommands().back();
  return *called;
}

/// "dsdpv1-sim traces check".
std::string words_of(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return (parent != nullptr ? words_of(*parent) + " " : "") + command.get_name();
}

std::vector<std::string> names_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : shown_commands(app)) names.push_back(command->get_name());
  return names;
}

/// The first option that the command does not have, else the first word too many.
std::string unexpected(const CLI::App& command, const std::vector<std::string>& words) {
  const auto option = std::find_if(words.begin(), words.end(), [](const std::string& each) { return each[0] == '-'; });
  const std::vector<std::string> actions = names_of(command);
  if (option == words.end() && !actions.empty())
    return "unknown action " + words.front() + tb::did_you_mean(words.front(), actions);
  if (option == words.end()) return "unexpected argument " + words.front();
  std::vector<std::string> known;
  for (const CLI::Option* each : shown_options(command))
    for (std::string& word : spellings(*each)) known.push_back(std::move(word));
  return "unknown option " + *option + tb::did_you_mean(*option, known);
}

std::string without_command(const CLI::App& app, const std::string& first) {
  const std::vector<std::string> names = names_of(app);
  const std::string allowed = ", expected " + tb::join(names);
  if (app.get_option_no_throw(first) != nullptr) return "dsdpv1-sim: a command is missing" + allowed;
  if (first[0] == '-') return "dsdpv1-sim: " + unexpected(app, {first}) + ", see --help for what is allowed";
  return "dsdpv1-sim: unknown command " + first + tb::did_you_mean(first, names) + allowed;
}

/// "FILE is missing", "--log needs FILE"; else as CLI11 says it.
std::string what_is_wrong(CLI::App& app, const CLI::App& called, const CLI::ParseError& error) {
  std::string text = error.what();
  const std::vector<std::string> more = app.remaining(true);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !more.empty()) return unexpected(called, more);
  if (const std::size_t at = text.find(" is required"); error.get_name() == "RequiredError" && at != std::string::npos)
    return text.substr(0, at) + " is missing (" + words_of(called) + arguments_of(called) + ")";
  const CLI::Option* option = called.get_option_no_throw(text.substr(0, text.find(':')));
  if (error.get_name() == "ArgumentMismatch" && option != nullptr && text.find(" required ") != std::string::npos)
    return option->get_name() + " needs " + value_word(*option);
  return text;
}

/// A wrong command line as one line that says what is allowed.
std::string in_one_line(CLI::App& app, const CLI::ParseError& error, const std::string& first) {
  const CLI::App& called = called_of(app);
  if (&called == &app) return without_command(app, first);
  std::string text = what_is_wrong(app, called, error);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return words_of(called) + ": " + text + ", see --help for what is allowed";
}

/// The exit code to return at once: after --help and --version, and without a command.
std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  if (argc < 2) {
    std::cerr << app.help();
    return kWrongInput;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    throw tb::InputError(in_one_line(app, error, argv[1]));
  }
  return std::nullopt;
}

}  // namespace

int command_line(int argc, char** argv, PrintableOutput& output) {
  CLI::App app("Cycle-accurate simulation of the DSDPV1 PROFIBUS-DP slave chip with its bus and its user CPU.",
               "dsdpv1-sim");
  const auto help = std::make_shared<Help>();
  help->label("Positionals", "Arguments");
  help->label("SUBCOMMAND", "COMMAND");
  app.formatter(help);
  describe_program(app);
  const Commands commands = make_commands();
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  std::string color = "auto";
  add_commands(app, commands, words, color);
  add_color_option(app, color);
  if (const std::optional<int> status = parse(app, argc, argv)) return *status;
  check_word("dsdpv1-sim --color", color, {"auto", "always", "never"});
  if (wants_colour(color)) output.paint();
  const tb::TableWidth as_wide_as_the_terminal(terminal_columns());
  const auto called = std::find_if(commands.begin(), commands.end(),
                                   [&app](const auto& each) { return app.got_subcommand(each->name()); });
  (*called)->words = words;
  return (*called)->carry_out();
}

}  // namespace dsdpv1::app
