#include "apps/command_line.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>

#include "apps/reasons_command.hpp"
#include "apps/recover_command.hpp"
#include "apps/rtl_commands.hpp"
#include "apps/serve_command.hpp"
#include "apps/sweep_command.hpp"
#include "tb/input/input_error.hpp"
#include "tb/input/suggest.hpp"

namespace app {
namespace {

const char* const kExitCodes =
    "\nExit codes: 0 passed, 1 a check or expectation failed, 2 wrong input (one line says where, what, and what is "
    "allowed),\n"
    "130 interrupted.\n";

const char* const kLogHelp =
    "Everything that happened, one line a thing; FILE.jsonl: a JSON object a line, for programs (docs/log.md)";
const char* const kLogWholeHelp =
    "All bytes of telegrams and data in the log, not only the first 32 of each; FILE.jsonl has them anyway";

void add_set_option(CLI::App& command, std::vector<std::string>& settings) {
  command
      .add_option("--set", settings,
                  "PATH=VALUE instead of what the scenario says, once for each key: slaves.0.user_cpu.cycle=40us, "
                  "slaves.plant.init.dpv1=true, or of every slave user_cpu.fsmc.datast=3")
      ->allow_extra_args(false);
}

void add_output_options(CLI::App& command, std::optional<bool>& progress, bool& quiet) {
  command.add_flag_callback(
      "--progress", [&progress] { progress = true; }, "Show a progress bar (on a terminal it is shown anyway)");
  command.add_flag_callback(
      "--no-progress", [&progress] { progress = false; }, "Show none");
  command.add_flag("--quiet,-q", quiet, "No table at the end");
}

void describe_run(CLI::App& app, RunArguments& arguments) {
  CLI::App* command = app.add_subcommand("run", "Carries out a scenario and judges it");
  command->add_option("SCENARIO", arguments.scenario, "Scenario in YAML, see docs/scenarios.md")->required();
  command
      ->add_option(
          "--engine", arguments.engine,
          "How the chips are executed: step (every cycle), skip (from event to event), rtl (the reference RTL), "
          "lockstep (model and RTL side by side, compared)")
      ->capture_default_str();
  command->add_option("--view", arguments.view, "How the user CPUs reach them: pins, tlm (SystemC)")
      ->capture_default_str();
  add_wave_options(*command, arguments.wave);
  CLI::Option* log = command->add_option("--log", arguments.log, kLogHelp);
  command->add_flag("--log-whole", arguments.log_whole, kLogWholeHelp)->needs(log);
  command->add_option("--result", arguments.result, "Result and measurements as JSON");
  command
      ->add_option(
          "--checks", arguments.checks,
          "The checks of docs/checks.md on handshake, bus timing and DPRAM: report (listed), fail (exit 1 on a "
          "violation that the scenario does not allow), off")
      ->capture_default_str();
  command->add_option("--trace", arguments.trace, "Every change of every output pin, for comparisons");
  command
      ->add_option("--difference", arguments.difference,
                   "Wave of both sides, written when --engine lockstep finds a difference")
      ->capture_default_str();
  add_set_option(*command, arguments.set);
  command
      ->add_option(
          "--gdb", arguments.gdb,
          "TCP port (0: any free one) where gdb-multiarch attaches to the first ARM board; the run waits for it")
      ->check(CLI::Range(0, 65535));
  add_output_options(*command, arguments.progress, arguments.quiet);
  command->footer(
      std::string(
          "\nExamples:\n"
          "  dsdpv1-sim run scenarios/power_on_12m.yaml\n"
          "  dsdpv1-sim run scenarios/power_on_9k6.yaml --wave slow.fst --log slow.log --result slow.json\n"
          "  dsdpv1-sim run my.yaml --wave bad.fst --wave-on violation --wave-around 50us --wave-clk\n"
          "  dsdpv1-sim run my.yaml --wave bus.vcd --wave-signals 'bus.*' --wave-signals '*.PB?XD' --wave-from 2ms\n"
          "  dsdpv1-sim run my.yaml --log my.log --log-whole\n"
          "  dsdpv1-sim run my.yaml --log my.jsonl\n"
          "  dsdpv1-sim run my.yaml --engine step --trace step.txt\n"
          "  dsdpv1-sim run my.yaml --set end=50ms --set user_cpu.fsmc.datast=3\n"
          "  dsdpv1-sim run scenarios/arm_board_12m.yaml --gdb 3333\n"
          "  dsdpv1-sim run my.yaml --engine lockstep --difference both.vcd\n") +
      kExitCodes);
}

void describe_schema(CLI::App& app, SchemaArguments& arguments) {
  CLI::App* command = app.add_subcommand("schema", "Prints the scenario's JSON Schema");
  command->add_flag("--markdown", arguments.markdown, "Prints docs/scenarios.md instead");
  command->add_option("--output,-o", arguments.output, "Into this file");
  command->footer(
      "\nExamples:\n  dsdpv1-sim schema > scenario.schema.json\n"
      "  and in the first line of a scenario, for editors with the YAML language server:\n"
      "  # yaml-language-server: $schema=scenario.schema.json\n");
}

void describe_gsd(CLI::App& app, GsdArguments& arguments) {
  CLI::App* command = app.add_subcommand("gsd", "Checks a PROFIBUS GSD file and prints what a master makes of it");
  command->add_option("FILE", arguments.file, "GSD file, revision 1 to 5")->required();
  command
      ->add_option("--module,-m", arguments.modules,
                   "Module by name or number, once for each slot; left out: the file's presets")
      ->allow_extra_args(false);
  command->add_flag("--json", arguments.json, "As JSON");
  command->footer(
      "\nExamples:\n  dsdpv1-sim gsd scenarios/dsdpv1.gsd\n  dsdpv1-sim gsd my_device.gsd --module \"8 bytes in\" "
      "--module 3 --json\n");
}

void describe_decode(CLI::App& app, DecodeArguments& arguments) {
  CLI::App* command =
      app.add_subcommand("decode", "Reads telegrams as hexadecimal text, or a log, and explains every byte");
  command->add_option("FILE", arguments.file, "Text file, or a log of run or serve; left out or -: standard input");
  command->footer(
      "\nAny spacing, 0x and commas allowed; one telegram a line or a continuous stream; # begins a comment.\n"
      "A log is known by its lines, text or JSON; its telegrams are taken, best from one with all bytes "
      "(--log-whole).\n"
      "\nExamples:\n  dsdpv1-sim decode capture.txt\n  dsdpv1-sim decode my.jsonl\n  echo 68 05 05 68 85 82 6D 3C 3E "
      "EE 16 | dsdpv1-sim decode\n"
      "\nExit codes: 0 all right, 1 some bytes are no right telegram, 2 not hexadecimal.\n");
}

void describe_serve(CLI::App& app, ServeArguments& arguments) {
  CLI::App* command = app.add_subcommand("serve", "Lets a real master talk to a scenario's slaves, in real time");
  command
      ->add_option("SCENARIO", arguments.scenario,
                   "Scenario in YAML; it needs no masters, and its end is not looked at")
      ->required();
  CLI::Option* pty =
      command->add_option("--pty", arguments.link, "At a pseudo-terminal (default) with this name as a link to it")
          ->expected(0, 1);
  CLI::Option* tcp =
      command->add_option("--tcp", arguments.tcp, "At this TCP port (0: any free one), a byte a character")
          ->check(CLI::Range(0, 65535));
  CLI::Option* serial =
      command->add_option("--serial", arguments.serial, "At this serial port, 8E1, with an RS-485 transceiver");
  pty->excludes(tcp)->excludes(serial);
  tcp->excludes(serial);
  command->add_option("--bind", arguments.bind, "IPv4 address of --tcp")->capture_default_str()->needs(tcp);
  command
      ->add_flag("--rts", arguments.rts, "RTS of the serial port switches the transceiver; else it does so by itself")
      ->needs(serial);
  command->add_option("--baud", arguments.baud, "Baud rate; left out: that of the scenario");
  command->add_option("--for", arguments.duration, "Ends after this time, for example 10s; left out: Ctrl-C");
  add_wave_options(*command, arguments.wave);
  CLI::Option* log = command->add_option("--log", arguments.log, "As of run; where it grows is said at the start");
  command->add_flag("--log-whole", arguments.log_whole, "As of run")->needs(log);
  command->add_option("--result", arguments.result, "As of run, and how well real time was kept");
  command->add_flag("--quiet,-q", arguments.quiet, "No table at the end");
  command->footer(std::string("\nExamples:\n"
                              "  dsdpv1-sim serve scenarios/serve_19k2.yaml --pty dp --log serve.log\n"
                              "  dsdpv1-sim serve scenarios/serve_19k2.yaml --tcp 5020\n"
                              "  dsdpv1-sim serve scenarios/serve_19k2.yaml --serial /dev/ttyUSB0 --baud 93.75k\n"
                              "docs/pyprofibus.md and docs/usb_rs485.md take you through it.\n") +
                  kExitCodes);
}

void describe_sweep(CLI::App& app, SweepArguments& arguments) {
  CLI::App* command = app.add_subcommand("sweep", "Runs a scenario at every combination of some keys' values");
  command->add_option("SCENARIO", arguments.scenario, "Scenario in YAML")->required();
  command
      ->add_option("--param", arguments.parameters,
                   "PATH=VALUES, once for each key that varies: user_cpu.fsmc.datast=0..15, "
                   "user_cpu.cycle=40us..100us/20us, baud=12M,6M,500k")
      ->allow_extra_args(false);
  add_set_option(*command, arguments.set);
  command->add_option("--checks", arguments.checks, "As of run, report or fail; left out: as run does");
  command->add_option("--map", arguments.map, "Check whose margin the pictures show; left out: the worst of all");
  command->add_option("--out", arguments.out,
                      "Folder for the points and results; left out: sweep_ and the scenario's name");
  command->add_option("--jobs", arguments.jobs, "Processes at a time; left out: one a processor")
      ->check(CLI::Range(1, 256));
  add_output_options(*command, arguments.progress, arguments.quiet);
  command->footer(
      "\nExamples:\n"
      "  dsdpv1-sim sweep scenarios/power_on_12m.yaml --param user_cpu.fsmc.datast=0..15 --param "
      "user_cpu.fsmc.addset=0..3\n"
      "  dsdpv1-sim sweep my.yaml --set user_cpu.fsmc.mode=A --param user_cpu.fsmc.datast=1..8 --out mode_a\n"
      "  dsdpv1-sim sweep my.yaml --param baud=12M,6M,500k --param slaves.plant.user_cpu.cycle=40us..200us/20us --jobs "
      "4\n"
      "The same command again goes on with an interrupted sweep. docs/sweep.md explains the results.\n"
      "\nExit codes: 0 all points were run, whatever they showed, 2 wrong input, 130 interrupted.\n");
}

void describe_rtl_random(CLI::App& app, RtlRandomArguments& arguments) {
  CLI::App* command = app.add_subcommand("rtl-random", "Random stimulus for model and reference RTL in lockstep");
  command->add_option("--cycles", arguments.cycles, "How many cycles to compare")->capture_default_str();
  command->add_option("--seed", arguments.seed, "The same cases for the same seed")->capture_default_str();
  command->add_option("--jobs", arguments.jobs, "Threads; left out: one a processor")->check(CLI::Range(1, 256));
  command->add_option("--replay", arguments.replay, "This stimulus file instead of random cases");
  command->add_option("--fault", arguments.fault, "With this single fault of rtl_ref/faults.txt")
      ->check(CLI::Range(0, 255));
  command->add_option("--stimulus", arguments.stimulus, "File for a case that differs, shrunk")->capture_default_str();
  command->add_option("--difference", arguments.difference, "Wave of both sides for it")->capture_default_str();
  command->footer(
      "\nExamples:\n  dsdpv1-sim rtl-random --cycles 100000000 --seed 7\n"
      "  dsdpv1-sim rtl-random --replay lockstep.stimulus --difference both.fst\n"
      "\nExit codes: 0 no difference, 1 a difference, 2 wrong input, 130 interrupted.\n");
}

void describe_rtl_faults(CLI::App& app, RtlFaultsArguments& arguments) {
  CLI::App* command =
      app.add_subcommand("rtl-faults", "Checks the lockstep itself: every single fault in the RTL must be found");
  command->add_option("--list", arguments.list, "The list of faults; left out: rtl_ref/faults.txt of this source tree");
  command->add_option("--directed", arguments.directed,
                      "Folder of stimulus files that are played first; left out: tests/cosim/stimuli of this source "
                      "tree");
  command->add_option("--cycles", arguments.cycles, "Random cycles for each fault at most")->capture_default_str();
  command->add_option("--seed", arguments.seed, "Of the random cases")->capture_default_str();
  command->add_option("--jobs", arguments.jobs, "Threads; left out: one a processor")->check(CLI::Range(1, 256));
  command->add_option("--tsv", arguments.tsv, "The table also as tab-separated text into this file");
  command->footer(
      "\nExamples:\n  dsdpv1-sim rtl-faults --tsv kills.tsv\n  dsdpv1-sim rtl-faults --list my_faults.txt --cycles "
      "5000000\n"
      "\nExit codes: 0 all found, 1 some not, 2 wrong input, 130 interrupted.\n");
}

void describe_cosim(CLI::App& app, CosimArguments& arguments) {
  CLI::App* command =
      app.add_subcommand("cosim", "Builds RTL of your own with Verilator and holds it against the model");
  command->add_option("SCENARIO", arguments.scenario, "Scenario in YAML")->required();
  command->add_option("--rtl", arguments.rtl, "Folder of the RTL")->required();
  command->add_option("--top", arguments.top, "Its top module")->required();
  command->add_option("--pins", arguments.pins, "Names, polarities and tolerances of its pins, see docs/cosim.md");
  command->add_option("--build", arguments.build, "Folder for what is built")->capture_default_str();
  command->add_option("--difference", arguments.difference, "Wave of both sides, written when they differ")
      ->capture_default_str();
  command->footer(
      "\nExamples:\n  dsdpv1-sim cosim --rtl examples/own_rtl --top board_chip --pins examples/own_rtl/pins.yaml "
      "scenarios/two_slaves.yaml\n"
      "\nExit codes: 0 no difference and the scenario passed, 1 otherwise, 2 wrong input, 130 "
      "interrupted.\n");
}

void describe_reasons(CLI::App& app, ReasonsArguments& arguments) {
  CLI::App* command =
      app.add_subcommand("reasons", "Explains the codes of logs and results: what happened, what to do");
  command->add_option("CODE", arguments.code, "Only this one, in capitals or not");
  CLI::Option* markdown = command->add_flag("--markdown", arguments.markdown, "Prints docs/reasons.md instead");
  command->add_flag("--checks", arguments.checks, "Prints docs/checks.md instead")->excludes(markdown);
  command->add_option("--output,-o", arguments.output, "Into this file");
  command->footer("\nExamples:\n  dsdpv1-sim reasons prm_ident\n  dsdpv1-sim reasons | less\n");
}

void describe_recover(CLI::App& app, RecoverArguments& arguments) {
  CLI::App* command =
      app.add_subcommand("recover", "Makes a complete wave of what a killed run (SIGKILL) has left of it");
  command->add_option("FILE", arguments.part, "The wave's temporary file, NAME.PID.part; FST needs FILE.hier beside it")
      ->required();
  command->add_option("--output,-o", arguments.output, "The wave; left out: NAME, when there is none yet");
  command->footer(
      "\nIt says until when the wave is complete. The files that it reads stay.\n"
      "\nExamples:\n  dsdpv1-sim recover out/demo.fst.4711.part\n"
      "  dsdpv1-sim recover demo.vcd.4711.part --output killed.vcd\n"
      "\nExit codes: 0 recovered, 2 wrong input or nothing to recover, 130 interrupted.\n");
}

std::vector<std::string> subcommand_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

/// CLI11's words for a wrong command line, as one line that says what is allowed.
std::string in_one_line(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const std::vector<std::string> commands = subcommand_names(app);
  const std::string first = argc > 1 ? argv[1] : "";
  const bool known = std::find(commands.begin(), commands.end(), first) != commands.end();
  if (first.empty()) return "dsdpv1-sim: a command is missing, allowed are " + tb::join(commands);
  if (!known && first[0] != '-')
    return "dsdpv1-sim: unknown command " + first + tb::did_you_mean(first, commands) + ", allowed are " +
           tb::join(commands);
  if (!known)
    return "dsdpv1-sim: unknown option " + first + ", allowed are --help, --version and the commands " +
           tb::join(commands);
  std::string text = error.what();
  for (char& c : text) c = c == '\n' ? ' ' : c;
  return "dsdpv1-sim " + first + ": " + text + ", see --help for what is allowed";
}

}  // namespace

void check_word(const std::string& option, const std::string& word, const std::vector<std::string>& allowed) {
  if (std::find(allowed.begin(), allowed.end(), word) != allowed.end()) return;
  throw tb::InputError("dsdpv1-sim " + option + " is " + word + tb::did_you_mean(word, allowed) + ", allowed are " +
                       tb::join(allowed));
}

int command_line(int argc, char** argv) {
  CLI::App app("Cycle-accurate simulation of the DSDPV1 PROFIBUS-DP slave chip with its bus and its user CPU.",
               "dsdpv1-sim");
  app.set_version_flag("--version", "dsdpv1-sim " DSDPV1_VERSION);
  app.require_subcommand(1);
  app.footer(std::string("\nExamples:\n  dsdpv1-sim run scenarios/power_on_12m.yaml --wave out.fst\n  dsdpv1-sim gsd "
                         "scenarios/dsdpv1.gsd\n"
                         "  dsdpv1-sim decode capture.txt\n  dsdpv1-sim run --help\n") +
             kExitCodes);
  RunArguments run_arguments;
  SchemaArguments schema_arguments;
  GsdArguments gsd_arguments;
  DecodeArguments decode_arguments;
  describe_run(app, run_arguments);
  describe_schema(app, schema_arguments);
  describe_gsd(app, gsd_arguments);
  describe_decode(app, decode_arguments);
  ReasonsArguments reasons_arguments;
  ServeArguments serve_arguments;
  describe_serve(app, serve_arguments);
  describe_reasons(app, reasons_arguments);
  SweepArguments sweep_arguments;
  describe_sweep(app, sweep_arguments);
  RtlRandomArguments rtl_random_arguments;
  RtlFaultsArguments rtl_faults_arguments;
  describe_rtl_random(app, rtl_random_arguments);
  describe_rtl_faults(app, rtl_faults_arguments);
  CosimArguments cosim_arguments;
  describe_cosim(app, cosim_arguments);
  RecoverArguments recover_arguments;
  describe_recover(app, recover_arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    throw tb::InputError(in_one_line(app, error, argc, argv));
  }
  if (app.got_subcommand("run")) return run(run_arguments);
  if (app.got_subcommand("serve")) return serve(serve_arguments);
  if (app.got_subcommand("sweep")) return sweep(sweep_arguments);
  if (app.got_subcommand("rtl-random")) return rtl_random(rtl_random_arguments);
  if (app.got_subcommand("rtl-faults")) return rtl_faults(rtl_faults_arguments);
  if (app.got_subcommand("cosim")) return cosim_own_rtl(cosim_arguments);
  if (app.got_subcommand("recover")) return recover(recover_arguments);
  if (app.got_subcommand("schema")) return schema(schema_arguments);
  if (app.got_subcommand("gsd")) return gsd(gsd_arguments);
  if (app.got_subcommand("reasons")) return reasons(reasons_arguments);
  return decode(decode_arguments);
}

}  // namespace app
