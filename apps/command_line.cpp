#include "apps/command_line.hpp"

#include <algorithm>
#include <optional>

#include "apps/commands/command.hpp"
#include "apps/options/words.hpp"
#include "apps/terminal.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::app {
namespace {

/// In the order of --help.
constexpr std::unique_ptr<Command> (*kCommands[])() = {
    make_run,    make_schema,    make_gsd,        make_decode,     make_serve,  make_reasons,
    make_sweep,  make_regress,   make_rtl_random, make_rtl_faults, make_cosim,  make_compare,
    make_replay, make_calibrate, make_traces,     make_recover,    make_manual, make_completion};

std::vector<CLI::App*> subcommands(CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::unique_ptr<Command>> add_commands(CLI::App& app) {
  std::vector<std::unique_ptr<Command>> commands;
  for (const auto make : kCommands) {
    commands.push_back(make());
    Command& command = *commands.back();
    command.options(*app.add_subcommand(command.name(), command.line()));
  }
  return commands;
}

/// Before the command and after it.
void add_color_option(CLI::App& app, std::string& word) {
  std::vector<CLI::App*> all = subcommands(app);
  all.push_back(&app);
  for (CLI::App* each : all)
    each->add_option("--color", word, "Verdicts in colour: auto (on a terminal, unless NO_COLOR is set), always, never")
        ->capture_default_str();
}

void describe_program(CLI::App& app) {
  app.set_version_flag("--version", "dsdpv1-sim " DSDPV1_VERSION);
  app.require_subcommand(1);
  app.footer(std::string("\nExamples:\n  dsdpv1-sim run scenarios/power_on_12m.yaml --wave out.fst\n  dsdpv1-sim gsd "
                         "scenarios/dsdpv1.gsd\n"
                         "  dsdpv1-sim decode capture.txt\n  dsdpv1-sim run --help\n") +
             kExitCodes);
}

/// CLI11's words for a wrong command line, as one line that says what is allowed.
std::string in_one_line(CLI::App& app, const CLI::ParseError& error, const std::string& first) {
  std::vector<std::string> names;
  for (const CLI::App* command : subcommands(app)) names.push_back(command->get_name());
  const bool known = std::find(names.begin(), names.end(), first) != names.end();
  if (first.empty()) return "dsdpv1-sim: a command is missing, allowed are " + tb::join(names);
  if (!known && first[0] != '-')
    return "dsdpv1-sim: unknown command " + first + tb::did_you_mean(first, names) + ", allowed are " + tb::join(names);
  if (!known)
    return "dsdpv1-sim: unknown option " + first + ", allowed are --help, --version and the commands " +
           tb::join(names);
  std::string text = error.what();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return "dsdpv1-sim " + first + ": " + text + ", see --help for what is allowed";
}

/// What to return at once, after --help and --version.
std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    throw tb::InputError(in_one_line(app, error, argc > 1 ? argv[1] : ""));
  }
  return std::nullopt;
}

}  // namespace

int command_line(int argc, char** argv, PrintableOutput& output) {
  CLI::App app("Cycle-accurate simulation of the DSDPV1 PROFIBUS-DP slave chip with its bus and its user CPU.",
               "dsdpv1-sim");
  describe_program(app);
  const std::vector<std::unique_ptr<Command>> commands = add_commands(app);
  std::string color = "auto";
  add_color_option(app, color);
  if (const std::optional<int> status = parse(app, argc, argv)) return *status;
  check_word("dsdpv1-sim --color", color, {"auto", "always", "never"});
  if (wants_colour(color)) output.paint();
  const tb::TableWidth as_wide_as_the_terminal(terminal_columns());
  const auto called = std::find_if(commands.begin(), commands.end(),
                                   [&app](const auto& each) { return app.got_subcommand(each->name()); });
  (*called)->words.assign(argv + 1, argv + argc);
  return (*called)->carry_out();
}

}  // namespace dsdpv1::app
