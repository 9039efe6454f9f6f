#include "apps/command_line.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <optional>

#include "apps/commands/calibrate_command.hpp"
#include "apps/commands/compare_command.hpp"
#include "apps/commands/manual_command.hpp"
#include "apps/commands/reasons_command.hpp"
#include "apps/commands/recover_command.hpp"
#include "apps/commands/regress_command.hpp"
#include "apps/commands/replay_command.hpp"
#include "apps/commands/rtl_commands.hpp"
#include "apps/commands/serve_command.hpp"
#include "apps/commands/sweep_command.hpp"
#include "apps/commands/traces_command.hpp"
#include "apps/options/checks.hpp"
#include "apps/terminal.hpp"
#include "bus/baud.hpp"
#include "bus/capture/link_type.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::app {
namespace {

const char* const kExitCodes =
    "\nExit codes: 0 passed, 1 a check or expectation failed, 2 wrong input (one line says where, what, and what is "
    "allowed),\n"
    "3 nothing was judged, 130 interrupted.\n";

const char* const kLogHelp =
    "Everything that happened, one line a thing; FILE.jsonl: a JSON object a line, for programs (docs/log.md)";
const char* const kLogWholeHelp =
    "All bytes of telegrams and data in the log, not only the first 32 of each; FILE.jsonl has them anyway";

CLI::Option* add_set_option(CLI::App& command, std::vector<std::string>& settings) {
  return command
      .add_option("--set", settings,
                  "PATH=VALUE instead of what the scenario says, once for each key: slaves.0.user_cpu.cycle=40us, "
                  "slaves.plant.init.dpv1=true, or of every slave user_cpu.fsmc.datast=3")
      ->allow_extra_args(false);
}

const char* const kReportHelp =
    "The run as one HTML page with its charts and timing diagrams, which needs no network (docs/report.md)";

const char* const kCaptureHelp =
    "Every telegram with its time as FILE.pcapng, for Wireshark and tshark (docs/captures.md)";

void add_capture_options(CLI::App& command, std::string& capture, std::string& link) {
  CLI::Option* option = command.add_option("--capture", capture, kCaptureHelp);
  command
      .add_option("--capture-link", link,
                  "Its link type: profibus (257), or user0 to user15 for a Wireshark that does not know 257")
      ->capture_default_str()
      ->needs(option);
}

void add_output_options(CLI::App& command, std::optional<bool>& progress, bool& quiet) {
  command.add_flag_callback(
      "--progress", [&progress] { progress = true; }, "Show a progress bar (on a terminal it is shown anyway)");
  command.add_flag_callback(
      "--no-progress", [&progress] { progress = false; }, "Show none");
  command.add_flag("--quiet,-q", quiet, "No table at the end");
}

/// What sweep and regress have in common.
void add_campaign_options(CLI::App& command, CampaignArguments& arguments, const std::string& usual_folder) {
  command.add_option("--out", arguments.out, "Folder for the runs and results; left out: " + usual_folder);
  command.add_option("--jobs", arguments.jobs, "Processes at a time; left out: one a processor")
      ->check(CLI::Range(1, 256));
  CLI::Option* slurm = command.add_flag(
      "--slurm", arguments.slurm, "As a job array of a Slurm cluster (sbatch); the folder must be seen by its nodes");
  command
      .add_option("--slurm-options", arguments.slurm_options, "More options for sbatch: \"--partition=x --time=10\"")
      ->needs(slurm);
  command.add_option("--slurm-task", arguments.slurm_task)->group("");  // what the tasks of an array call
  add_output_options(command, arguments.progress, arguments.quiet);
}

const char* const kRunExamples =
    "\nExamples:\n"
    "  dsdpv1-sim run scenarios/power_on_12m.yaml\n"
    "  dsdpv1-sim run scenarios/power_on_9k6.yaml --wave slow.fst --log slow.log --result slow.json\n"
    "  dsdpv1-sim run my.yaml --wave bad.fst --wave-on violation --wave-around 50us --wave-clk\n"
    "  dsdpv1-sim run my.yaml --wave my.fst --wave-inside --wave-save\n"
    "  dsdpv1-sim run my.yaml --wave bus.vcd --wave-signals 'bus.*' --wave-signals '*.PB?XD' --wave-from 2ms\n"
    "  dsdpv1-sim run my.yaml --log my.log --log-whole\n"
    "  dsdpv1-sim run my.yaml --log my.jsonl\n"
    "  dsdpv1-sim run my.yaml --report my.html --junit my.xml\n"
    "  dsdpv1-sim run my.yaml --capture my.pcapng --capture-link user0\n"
    "  dsdpv1-sim run my.yaml --engine step --trace step.txt\n"
    "  dsdpv1-sim run my.yaml --set end=50ms --set user_cpu.fsmc.datast=3\n"
    "  dsdpv1-sim run scenarios/arm_board_12m.yaml --gdb 3333\n"
    "  dsdpv1-sim run my.yaml --save-at 5ms at_5ms.run --save-at 20ms at_20ms.run\n"
    "  dsdpv1-sim run my.yaml --wave bad.fst --rewind-on violation 100us\n"
    "  dsdpv1-sim run --restore at_20ms.run --log rest.log --wave rest.fst\n"
    "  dsdpv1-sim run my.yaml --engine lockstep --difference both.vcd\n";

/// What a run leaves besides its wave and its capture.
void add_report_options(CLI::App& command, RunArguments& arguments) {
  CLI::Option* log = command.add_option("--log", arguments.log, kLogHelp);
  command.add_flag("--log-whole", arguments.log_whole, kLogWholeHelp)->needs(log);
  command.add_option("--result", arguments.result, "Result and measurements as JSON");
  command.add_option("--report", arguments.report, kReportHelp);
  command.add_option(
      "--junit", arguments.junit,
      "The verdict for CI as JUnit's XML: a case for the run, its violations, each check and expectation");
}

/// What a run is held against, and with what RTL; those that a saved run already has.
std::vector<CLI::Option*> add_comparison_options(CLI::App& command, RunArguments& arguments) {
  command.add_option("--trace", arguments.trace, "Every change of every output pin, for comparisons");
  command
      .add_option("--difference", arguments.difference,
                  "Wave of both sides, written when --engine lockstep finds a difference")
      ->capture_default_str();
  CLI::Option* golden = command.add_option(
      "--golden", arguments.golden,
      "Folder of golden traces (traces): every change of every pin is compared, the first difference "
      "ends the run (docs/traces.md)");
  CLI::Option* fault =
      command
          .add_option("--fault", arguments.fault,
                      "With this single fault of rtl_ref/faults.txt, or faults_rsu.txt, in the reference RTL")
          ->check(CLI::Range(0, 255));
  CLI::Option* seed =
      command.add_option("--seed", arguments.seed,
                         "With --engine rtl or lockstep: what RTL begins with where nothing is reset; left out: 1");
  return {golden, fault, seed};
}

void describe_run(CLI::App& app, RunArguments& arguments) {
  CLI::App* command = app.add_subcommand("run", "Carries out a scenario and judges it");
  CLI::Option* scenario =
      command->add_option("SCENARIO", arguments.scenario, "Scenario in YAML, see docs/scenarios.md");
  CLI::Option* engine =
      command
          ->add_option(
              "--engine", arguments.engine,
              "How the chips are executed: step (every cycle), skip (from event to event), rtl (the reference RTL), "
              "lockstep (model and RTL side by side, compared)")
          ->capture_default_str();
  CLI::Option* view = command
                          ->add_option("--view", arguments.view,
                                       "How the user CPUs reach them: pins, tlm (SystemC; not with an ARM board)")
                          ->capture_default_str();
  add_wave_options(*command, arguments.wave);
  add_report_options(*command, arguments);
  add_capture_options(*command, arguments.capture, arguments.capture_link);
  CLI::Option* checks = add_checks_option(*command, arguments.checks);
  std::vector<CLI::Option*> of_whole_run = add_comparison_options(*command, arguments);
  of_whole_run.insert(of_whole_run.end(), {scenario, engine, view, checks, add_set_option(*command, arguments.set)});
  command
      ->add_option("--save-at", arguments.save_at,
                   "TIME FILE: saves the run as it is then, for --restore; once for each time (docs/save_restore.md)")
      ->type_name("TIME FILE")
      ->allow_extra_args(false);
  CLI::Option* rewind =
      command
          ->add_option(
              "--rewind-on", arguments.rewind_on,
              "CODE TIME: no wave until an event with this code of the log, or a violation, happens; then the run is "
              "done again "
              "from a snapshot, with the wave from so long before it to as long behind it (docs/save_restore.md)")
          ->type_name("CODE TIME")
          ->needs(command->get_option("--wave"));
  for (const char* each : {"--wave-on", "--wave-from", "--wave-to", "--wave-inside"})
    rewind->excludes(command->get_option(each));
  CLI::Option* restore = command->add_option(
      "--restore", arguments.restore,
      "A saved run in the place of a scenario: it goes on from there, and log, wave, trace and capture begin there");
  for (CLI::Option* each : of_whole_run) restore->excludes(each);
  rewind->excludes(restore);
  command
      ->add_option(
          "--gdb", arguments.gdb,
          "TCP port (0: any free one) where gdb-multiarch attaches to the first ARM board; the run waits for it")
      ->excludes(rewind)
      ->check(CLI::Range(0, 65535));
  add_output_options(*command, arguments.progress, arguments.quiet);
  command->footer(std::string(kRunExamples) + kExitCodes);
}

void describe_schema(CLI::App& app, SchemaArguments& arguments) {
  CLI::App* command = app.add_subcommand("schema", "Prints the JSON Schema of a scenario, or of a result");
  CLI::Option* result = command->add_flag("--result", arguments.result, "Of the file that run --result writes");
  command->add_flag("--rtl-random", arguments.rtl_random, "Of the file that rtl-random --result writes")
      ->excludes(result);
  command->add_flag("--markdown", arguments.markdown,
                    "Prints docs/scenarios.md, docs/result.md, or the table of docs/cosim.md instead");
  command->add_option("--output,-o", arguments.output, "Into this file");
  command->footer(
      "\nExamples:\n  dsdpv1-sim schema > scenario.schema.json\n  dsdpv1-sim schema --result > result.schema.json\n"
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
      app.add_subcommand("decode", "Explains every byte of telegrams: text, logs, captures, recordings of the line");
  command->add_option("FILE", arguments.file,
                      "Hexadecimal text, a log of run or serve, pcapng, pcap, VCD or FST of any simulator, a session "
                      "of sigrok, CSV of a logic "
                      "analyser, known by what is in it; left out or -: standard input");
  command->add_option("--baud", arguments.baud, "Baud rate of a recording of the line; left out: it is found");
  command->add_option("--signal", arguments.signal,
                      "Which signal of a recording is the line; left out: the only one, or line, PBRXD, PBTXD");
  command->add_flag("--invert", arguments.inverted, "The recording's idle level is low");
  command->add_option("--table", arguments.table, "Of a capture or recording: a line a telegram, separated by tabs");
  command->add_option("--json", arguments.json, "The same as JSON, with words");
  command->add_flag("--quiet,-q", arguments.quiet, "Nothing is printed");
  command->footer(
      "\nAny spacing, 0x and commas allowed; one telegram a line or a continuous stream; # begins a comment.\n"
      "A log is known by its lines, text or JSON; its telegrams are taken, best from one with all bytes "
      "(--log-whole).\n"
      "\nExamples:\n  dsdpv1-sim decode capture.txt\n  dsdpv1-sim decode my.jsonl\n  dsdpv1-sim decode my.pcapng\n  "
      "dsdpv1-sim decode logic.sr --signal D2 --invert\n  dsdpv1-sim decode my.pcapng --quiet --table my.tsv\n  echo "
      "68 05 05 68 85 82 6D 3C 3E "
      "EE 16 | dsdpv1-sim decode\n"
      "\nExit codes: 0 all right, 1 some bytes are no right telegram, 2 wrong input.\n");
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
      ->add_option("--turn", arguments.turn,
                   "Seconds; a host that sends nothing for so long while others wait loses the TCP port (0: keeps it)")
      ->check(CLI::Range(0, 86400))
      ->capture_default_str()
      ->needs(tcp);
  command
      ->add_flag("--rts", arguments.rts, "RTS of the serial port switches the transceiver; else it does so by itself")
      ->needs(serial);
  command->add_option("--baud", arguments.baud, "Baud rate; left out: that of the scenario");
  command->add_option("--for", arguments.duration, "Ends after this time, for example 10s; left out: Ctrl-C");
  add_wave_options(*command, arguments.wave);
  CLI::Option* log = command->add_option("--log", arguments.log, "As of run; where it grows is said at the start");
  command->add_flag("--log-whole", arguments.log_whole, "As of run")->needs(log);
  command->add_option("--result", arguments.result, "As of run, and how well real time was kept");
  command->add_option("--report", arguments.report, kReportHelp);
  command->add_option("--junit", arguments.junit, "As of run");
  add_checks_option(*command, arguments.checks);
  add_set_option(*command, arguments.set);
  add_capture_options(*command, arguments.capture, arguments.capture_link);
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
  command->add_flag("--strict", arguments.strict, "Exit 1 when a point does not hold, 3 when one judged nothing");
  command->add_option("--map", arguments.map, "Check whose margin the pictures show; left out: the worst of all");
  add_campaign_options(*command, arguments.campaign, "sweep_ and the scenario's name");
  command->footer(
      "\nExamples:\n"
      "  dsdpv1-sim sweep scenarios/power_on_12m.yaml --param user_cpu.fsmc.datast=0..15 --param "
      "user_cpu.fsmc.addset=0..3\n"
      "  dsdpv1-sim sweep my.yaml --set user_cpu.fsmc.mode=A --param user_cpu.fsmc.datast=1..8 --out mode_a\n"
      "  dsdpv1-sim sweep my.yaml --param baud=12M,6M,500k --param slaves.plant.user_cpu.cycle=40us..200us/20us --jobs "
      "4\n"
      "The same command again goes on with an interrupted sweep. docs/sweep.md explains the results.\n"
      "\nExit codes: 0 all points were run, whatever they showed (--strict: and hold, else 1 or 3), 2 wrong input, 130 "
      "interrupted.\n");
}

void describe_regress(CLI::App& app, RegressArguments& arguments) {
  CLI::App* command =
      app.add_subcommand("regress", "Runs scenarios by engines, views and settings, and judges each run");
  CLI::Option* scenarios = command->add_option("SCENARIO", arguments.scenarios,
                                               "Scenarios, and folders of them (.yaml, .yml); left out: ./scenarios");
  CLI::Option* engine =
      command->add_option("--engine", arguments.engines, "Of run, several with commas; left out: skip")->delimiter(',');
  CLI::Option* view =
      command->add_option("--view", arguments.views, "Of run, several with commas; left out: pins")->delimiter(',');
  CLI::Option* seed =
      command->add_option("--seed", arguments.seeds, "Of run with RTL: 1..4,7; left out: the usual one");
  CLI::Option* set = command
                         ->add_option("--set", arguments.set,
                                      "PATH=VALUES, once for each key, lists and ranges as --param of sweep: "
                                      "user_cpu.fsmc.datast=2..5")
                         ->allow_extra_args(false);
  CLI::Option* checks = command->add_option("--checks", arguments.checks, "As of run");
  CLI::Option* shard =
      command->add_option("--shard", arguments.shard, "2/5: the second fifth of the runs, always the same");
  CLI::Option* wave = command->add_option("--wave", arguments.wave, "Each run writes waves: vcd, fst; left out: none");
  CLI::Option* report = command->add_flag("--report", arguments.report,
                                          "Each run writes its page of charts and timing diagrams (docs/report.md)");
  CLI::Option* keep =
      command->add_option("--keep", arguments.keep,
                          "Of which runs log, result, wave and report are kept: none, failed, all; left out: failed");
  CLI::Option* failed =
      command->add_flag("--failed", arguments.failed, "Again what has not passed the last time in --out");
  for (CLI::Option* other : {scenarios, engine, view, seed, set, checks, shard, wave, report, keep})
    failed->excludes(other);
  command
      ->add_option("--time-limit", arguments.time_limit, "Seconds after which a run is killed and has failed; 0: none")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command->add_option("--junit", arguments.junit, "The report for CI as JUnit's XML");
  command->add_flag("--json", arguments.json, "The table as JSON");
  add_campaign_options(*command, arguments.campaign, "regression");
  command->footer(
      "\nExamples:\n"
      "  dsdpv1-sim regress\n"
      "  dsdpv1-sim regress scenarios my.yaml --engine step,skip,lockstep --view pins,tlm --junit report.xml\n"
      "  dsdpv1-sim regress my.yaml --set user_cpu.fsmc.datast=2..5 --set baud=12M,6M --wave fst --report\n"
      "  dsdpv1-sim regress --engine rtl --seed 1..8 --shard 2/5 --out part_2\n"
      "  dsdpv1-sim regress --failed\n"
      "The same command again goes on with an interrupted regression. docs/regress.md explains the results.\n"
      "\nExit codes: 0 all runs passed, 1 some did not, 2 wrong input, 3 none failed, but some judged nothing, 130 "
      "interrupted.\n");
}

/// The reference RTL of which chip, and for random cases its port.
void add_chip_options(CLI::App& command, std::string& chip, std::string& mode) {
  command.add_option("--chip", chip, "The chip of the reference RTL: dsdpv1, dsdpv1_r, dsdpv1_rsu")
      ->capture_default_str();
  command.add_option("--mode", mode, "Of the dsdpv1_rsu, for random cases: the host's port, parallel, spi or uart")
      ->capture_default_str();
}

void describe_rtl_random(CLI::App& app, RtlRandomArguments& arguments) {
  CLI::App* command =
      app.add_subcommand("rtl-random", "Random stimulus for model and RTL in lockstep, the reference RTL or your own");
  add_chip_options(*command, arguments.chip, arguments.mode);
  command->add_option("--cycles", arguments.cycles, "How many cycles to compare")->capture_default_str();
  command->add_option("--seed", arguments.seed, "The same cases for the same seed")->capture_default_str();
  command->add_option("--jobs", arguments.jobs, "Threads; left out: one a processor")->check(CLI::Range(1, 256));
  command->add_option("--replay", arguments.replay, "This stimulus file instead of random cases");
  add_own_rtl_options(*command, arguments.own, false);
  command->add_option("--fault", arguments.fault, "With this single fault of rtl_ref/faults.txt in the reference RTL")
      ->check(CLI::Range(0, 255))
      ->excludes("--rtl");
  CLI::Option* campaign =
      command->add_flag("--campaign", arguments.campaign,
                        "At the DSDPV1 and at each port of the DSDPV1-RSU in turn; goes on where --state ends");
  for (const char* each : {"--chip", "--mode", "--replay", "--rtl"}) campaign->excludes(each);
  command->add_option("--state", arguments.state, "Folder that keeps what a campaign has compared")
      ->capture_default_str()
      ->needs(campaign);
  command
      ->add_option("--set", arguments.set,
                   "chip.KEY=VALUE, once for each: a parameter of the model, as a scenario has it; left out: those of "
                   "scenarios, with the reference RTL short times")
      ->allow_extra_args(false);
  command->add_option("--stimulus", arguments.stimulus, "File for a case that differs, shrunk")->capture_default_str();
  command->add_option("--difference", arguments.difference, "Wave of both sides' pins for it")->capture_default_str();
  CLI::Option* wave =
      command
          ->add_option("--wave", arguments.wave,
                       "Wave of it with the inside of your RTL beside the model's: FILE.vcd or FILE.fst")
          ->needs("--rtl");
  add_wave_save_option(*command, arguments.wave_save, wave);
  command->add_option("--log", arguments.log,
                      "Log of it: every change of every pin, events, telegrams; FILE.jsonl: for programs");
  command->add_option("--result", arguments.result, "The result as JSON, also when nothing differs (docs/cosim.md)")
      ->excludes(campaign);
  command
      ->add_option("--tsv", arguments.tsv,
                   "What occurred, and what did not: states, services, refusals, situations at the host port, with "
                   "their counts")
      ->excludes("--replay");
  command->footer(
      "\n--wave and --log are written of the case that differs, and of a stimulus that --replay plays.\n"
      "\nExamples:\n  dsdpv1-sim rtl-random --cycles 100000000 --seed 7\n"
      "  dsdpv1-sim rtl-random --chip dsdpv1_rsu --mode spi --cycles 100000000\n"
      "  dsdpv1-sim rtl-random --campaign --cycles 1000000000 --state nightly --tsv situations.tsv\n"
      "  dsdpv1-sim rtl-random --replay lockstep.stimulus --difference both.fst --log case.log\n"
      "  dsdpv1-sim rtl-random --rtl my_chip --top chip --pins pins.yaml --set chip.search_window_ms=1 --result "
      "r.json\n"
      "  dsdpv1-sim rtl-random --rtl my_chip --top chip --replay lockstep.stimulus --wave inside.fst\n"
      "\nExit codes: 0 no difference, 1 a difference, 2 wrong input, 130 interrupted.\n");
}

void describe_rtl_faults(CLI::App& app, RtlFaultsArguments& arguments) {
  CLI::App* command =
      app.add_subcommand("rtl-faults", "Checks the lockstep itself: every single fault in the RTL must be found");
  add_chip_options(*command, arguments.chip, arguments.mode);
  command->add_option("--list", arguments.list,
                      "The list of faults; left out: rtl_ref/faults.txt or faults_rsu.txt of this source tree");
  command->add_option(
      "--directed", arguments.directed,
      "Folder of stimulus files that are played first; left out: tests/cosim/stimuli or stimuli_rsu of this "
      "source tree");
  command->add_option("--cycles", arguments.cycles, "Random cycles for each fault at most")->capture_default_str();
  command->add_option("--seed", arguments.seed, "Of the random cases")->capture_default_str();
  command->add_option("--jobs", arguments.jobs, "Threads; left out: one a processor")->check(CLI::Range(1, 256));
  command->add_option("--tsv", arguments.tsv, "The table also as tab-separated text into this file");
  command->footer(
      "\nExamples:\n  dsdpv1-sim rtl-faults --tsv kills.tsv\n  dsdpv1-sim rtl-faults --chip dsdpv1_rsu --mode spi\n  "
      "dsdpv1-sim rtl-faults --list my_faults.txt --cycles "
      "5000000\n"
      "\nExit codes: 0 all found, 1 some not, 2 wrong input, 130 interrupted.\n");
}

void describe_cosim(CLI::App& app, CosimArguments& arguments) {
  CLI::App* command =
      app.add_subcommand("cosim", "Builds RTL of your own with Verilator and holds it against the model");
  command->add_option("SCENARIO", arguments.scenario, "Scenario in YAML");
  CLI::Option* replay = command->add_option("--replay", arguments.replay,
                                            "A stimulus file in its place: a case of rtl-random, with its --set");
  add_own_rtl_options(*command, arguments.own, true);
  command->add_option("--difference", arguments.difference, "Wave of both sides' pins, written when they differ")
      ->capture_default_str();
  CLI::Option* wave =
      command->add_option("--wave", arguments.wave.file,
                          "Wave of the run with the inside of your RTL beside the model's: FILE.vcd or FILE.fst");
  command->add_option("--wave-from", arguments.wave.from, "Only from this time on")->needs(wave)->excludes(replay);
  command->add_option("--wave-to", arguments.wave.to, "Only up to this time")->needs(wave)->excludes(replay);
  add_wave_save_option(*command, arguments.wave.save, wave);
  CLI::Option* log = command->add_option("--log", arguments.log, kLogHelp);
  command->add_flag("--log-whole", arguments.log_whole, kLogWholeHelp)->needs(log)->excludes(replay);
  command->add_option("--result", arguments.result, "Result, measurements and the first difference as JSON");
  add_checks_option(*command, arguments.checks)->excludes(replay);
  add_set_option(*command, arguments.set);
  command->footer(
      "\nExamples:\n  dsdpv1-sim cosim --rtl examples/own_rtl --top board_chip --pins examples/own_rtl/pins.yaml "
      "scenarios/two_slaves.yaml\n"
      "  dsdpv1-sim cosim --rtl my_chip --top chip my.yaml --wave inside.fst --wave-from 1.6ms --log my.log --result "
      "my.json\n"
      "  dsdpv1-sim cosim --rtl my_chip --top chip --replay lockstep.stimulus --wave inside.fst\n"
      "\nExit codes: 0 no difference and the scenario passed, 1 otherwise, 2 wrong input, 3 nothing was judged, 130 "
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

void describe_compare(CLI::App& app, CompareArguments& arguments) {
  CLI::App* command = app.add_subcommand("compare", "Holds a simulator's wave against another's: VCD and FST of any");
  const auto list = [&](const char* name, std::vector<std::string>& to, const char* help) {
    command->add_option(name, to, help)->allow_extra_args(false);
  };
  command->add_option("A", arguments.a, "Wave of what is expected, such as the model's")->required();
  command->add_option("B", arguments.b, "Wave that is held to it")->required();
  command->add_option("--scope", arguments.scope, "Only signals in this scope and below it; left out: all");
  command->add_option("--scope-a", arguments.scope_a, "The same for A alone");
  command->add_option("--scope-b", arguments.scope_b, "The same for B alone");
  command->add_option("--pins", arguments.pins,
                      "The pins of the chip, B's by this map (docs/cosim.md) or, with rtl_ref, as the reference RTL "
                      "calls them; left out: all signals of one name");
  list("--signal", arguments.signals, "A=B: this signal of A and that of B, A=!B when B has the other level");
  command->add_option("--from", arguments.from, "Compare from this time on, such as 100us; left out: what both have");
  command->add_option("--to", arguments.to, "... and up to this one, which both must reach");
  command->add_option("--shift", arguments.shift, "Added to B's times: 20ns, -3cycles");
  command->add_option("--tolerance", arguments.tolerance,
                      "What differs for no longer is no difference; left out: the coarser time scale's unit where the "
                      "two are not the same, else 0");
  command->add_option("--clock", arguments.clock,
                      "SIGNAL, SIGNAL:fall: compare what there is just before its rising (falling) edges");
  command
      ->add_option("--x", arguments.x,
                   "What an unknown bit matches: expected (A's anything, B's only X), any (either side's anything), "
                   "equal (X), never (nothing)")
      ->capture_default_str();
  command->add_option("--z", arguments.z, "What a released bit matches: equal (Z), expected and any as of --x")
      ->capture_default_str();
  list("--mask", arguments.masks,
       "SIGNAL=VALUE or SIGNAL!=VALUE: nothing is compared while it is so; with @SIGNAL after it, that one is not");
  command->add_option("--wave", arguments.wave, "Both sides and where they differ: FILE.vcd or FILE.fst");
  command->add_option("--json", arguments.json, "The result for programs");
  command->add_option("--junit", arguments.junit, "The result in JUnit's XML, a case for each signal");
  add_output_options(*command, arguments.progress, arguments.quiet);
  command->footer(
      "\nExamples:\n"
      "  dsdpv1-sim compare model.fst icarus.vcd --scope-a demo --scope-b bench.dut --pins rtl_ref\n"
      "  dsdpv1-sim compare golden.vcd tonight.vcd --tolerance 10ns --mask 'tb.reset=0' --wave both.fst\n"
      "  dsdpv1-sim compare a.fst b.vcd --clock tb.clk --from 100us --to 3ms --json result.json\n"
      "  dsdpv1-sim compare a.vcd <(zcat b.vcd.gz) --signal bus.line=!tb.line_n\n"
      "docs/compare.md explains them.\n"
      "\nExit codes: 0 equal, 1 different, 2 wrong input, 130 interrupted.\n");
}

void describe_replay(CLI::App& app, ReplayArguments& arguments) {
  CLI::App* command =
      app.add_subcommand("replay", "Plays a capture to the model as one of its slaves, and compares the answers");
  command
      ->add_option("CAPTURE", arguments.capture,
                   "pcapng, pcap, VCD or FST of any simulator, a session of sigrok, CSV of a logic analyser, a log "
                   "of run or serve with all bytes")
      ->required();
  command->add_option("--as", arguments.slave, "Address of the slave whose part the model takes")
      ->required()
      ->check(CLI::Range(0, 126));
  command->add_option("--gsd", arguments.gsd, "The slave's GSD file: ident number and limits as it says");
  command->add_option("--scenario", arguments.scenario,
                      "Take its slave with this address (or the only one), with its user CPU, in place of what the "
                      "capture shows");
  command->add_option(
      "--inputs", arguments.inputs,
      "What the user CPU gives: recorded (inputs and diagnoses as the slave answered them) or scenario; "
      "left out: scenario with --scenario, else recorded");
  command
      ->add_option("--tsdr-tolerance", arguments.tolerance,
                   "TSDR of both at most so many bit times apart; left out: both from min_TSDR to max_TSDR")
      ->check(CLI::Range(0.0, 10'000.0));
  command->add_option("--from", arguments.from,
                      "Compare from this time of the capture on; what is before is played, too");
  command->add_option("--to", arguments.to, "End at this time of the capture");
  command->add_option("--baud", arguments.baud, "Baud rate; left out: the capture's, or found in a recording");
  command->add_option("--signal", arguments.signal, "As of decode");
  command->add_flag("--invert", arguments.inverted, "As of decode");
  command->add_flag("--no-lead-in", arguments.no_lead_in,
                    "Nothing before the capture: the model has to find its baud rate and its parameters there");
  command->add_option("--engine", arguments.engine, "step, skip or rtl (the reference RTL), as of run")
      ->capture_default_str();
  command->add_option("--table", arguments.table, "Each request with both answers, separated by tabs");
  command->add_option("--json", arguments.json, "The result for programs");
  add_wave_options(*command, arguments.wave);
  CLI::Option* log = command->add_option("--log", arguments.log, kLogHelp);
  command->add_flag("--log-whole", arguments.log_whole, kLogWholeHelp)->needs(log);
  command->add_option("--result", arguments.result, "Measurements of the run as JSON, as of run");
  add_checks_option(*command, arguments.checks);
  add_capture_options(*command, arguments.capture_out, arguments.capture_link);
  add_output_options(*command, arguments.progress, arguments.quiet);
  command->footer(
      "\nExamples:\n"
      "  dsdpv1-sim replay plant.pcapng --as 5\n"
      "  dsdpv1-sim replay plant.sr --signal D2 --as 5 --gsd my_device.gsd --table plant.tsv\n"
      "  dsdpv1-sim replay board.csv --as 5 --tsdr-tolerance 1 --log board.log --wave board.fst\n"
      "  dsdpv1-sim replay plant.pcapng --as 5 --scenario my.yaml --from 2s --to 3s --json plant.json\n"
      "docs/replay.md explains them.\n"
      "\nExit codes: 0 equal, 1 different or violated, 2 wrong input, 3 nothing could be compared, 130 interrupted.\n");
}

void describe_calibrate(CLI::App& app, CalibrateArguments& arguments) {
  constexpr double kMostJitter = 1000, kMostPpm = 20'000;  // ns; 2 %
  constexpr int kMostStation = 126;
  CLI::App* command = app.add_subcommand(
      "calibrate", "Holds a capture of a real chip's pins against the rulings and fits the chip's parameters");
  command
      ->add_option(
          "CAPTURE", arguments.file,
          "Logic analyser's session (sigrok), CSV, VCD, FST with any of the chip's pins, known by what is in it")
      ->required();
  command
      ->add_option("--signal", arguments.signals,
                   "PIN=NAME: the pin of table 1 (A0 to A10, D0 to D7, or A and D as vectors) is called NAME, "
                   "PIN=!NAME when it is inverted; left "
                   "out: as the pin")
      ->allow_extra_args(false);
  command->add_option("--map", arguments.map, "The same as a map of pins (docs/cosim.md)");
  command->add_option("--scope", arguments.scope, "Only signals in this scope of a wave: the station of a wave of run");
  command->add_option("--station", arguments.station, "The chip's address; left out: the one that is answered")
      ->check(CLI::Range(0, kMostStation));
  command->add_option("--rate", arguments.rate,
                      "Samples a second, such as 24MHz; left out: what the file says, or its changes show");
  command
      ->add_option("--jitter", arguments.jitter_ns,
                   "How far an edge may be off besides the sampling, skew between channels included, ns")
      ->check(CLI::Range(0.0, kMostJitter))
      ->capture_default_str();
  command->add_option("--ppm", arguments.clock_ppm, "How far the clocks of chip and capture may differ")
      ->check(CLI::Range(0.0, kMostPpm))
      ->capture_default_str();
  command->add_option("--chip", arguments.chip, "The parameters as a chip: block for scenarios");
  command->add_option("--json", arguments.json, "The result for programs");
  command->add_option("--table", arguments.table, "What is printed with --all, into this file");
  command->add_flag("--all", arguments.all, "Also the claims that the capture does not show, and why");
  command->add_flag("--quiet,-q", arguments.quiet, "No table at the end");
  command->footer(
      "\nExamples:\n"
      "  dsdpv1-sim calibrate board.sr --signal PBRXD=D0 --signal PBTXD=D1 --signal PBRTS=D2\n"
      "  dsdpv1-sim calibrate board.csv --map pins.yaml --jitter 10 --chip chip.yaml --json board.json\n"
      "  dsdpv1-sim calibrate model.fst --scope demo --all\n"
      "docs/calibrate.md explains them.\n"
      "\nExit codes: 0 all is confirmed or not shown, 1 something is contradicted, 2 wrong input, 130 interrupted.\n");
}

/// What is all of a command: it is printed, and the command line has succeeded.
[[noreturn]] void print_and_succeed(const std::string& text) {
  std::cout << text << std::flush;
  throw CLI::Success();
}

void describe_manual(CLI::App& app) {
  CLI::App* manual = app.add_subcommand("manual", "Prints the manual page of this program, in roff");
  manual->footer("\nExample:\n  dsdpv1-sim manual | man -l -\n");
  manual->callback([&app] { print_and_succeed(manual_page(app)); });
  CLI::App* command = app.add_subcommand("completion", "Prints what completes this program's command line in a shell");
  const CLI::Option* shell = command->add_option("SHELL", "bash or zsh")->required();
  command->callback([&app, shell] { print_and_succeed(completion(app, shell->as<std::string>())); });
  command->footer(
      "\nExamples:\n  source <(dsdpv1-sim completion bash)\n"
      "  dsdpv1-sim completion zsh > ~/.zfunc/_dsdpv1-sim\n");
}

/// Before the command and after it.
void add_color_option(CLI::App& app, std::string& word) {
  std::vector<CLI::App*> all = app.get_subcommands([](const CLI::App*) { return true; });
  all.push_back(&app);
  word = "auto";
  for (CLI::App* each : all)
    each->add_option("--color", word, "Verdicts in colour: auto (on a terminal, unless NO_COLOR is set), always, never")
        ->capture_default_str();
}

/// After all commands with a purpose of their own.
void describe_what_is_general(CLI::App& app, std::string& color) {
  describe_manual(app);
  add_color_option(app, color);
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

void describe_program(CLI::App& app) {
  app.set_version_flag("--version", "dsdpv1-sim " DSDPV1_VERSION);
  app.require_subcommand(1);
  app.footer(std::string("\nExamples:\n  dsdpv1-sim run scenarios/power_on_12m.yaml --wave out.fst\n  dsdpv1-sim gsd "
                         "scenarios/dsdpv1.gsd\n"
                         "  dsdpv1-sim decode capture.txt\n  dsdpv1-sim run --help\n") +
             kExitCodes);
}

/// What to return at once, after --help and --version.
std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    throw tb::InputError(in_one_line(app, error, argc, argv));
  }
  return std::nullopt;
}

}  // namespace

void check_word(const std::string& option, const std::string& word, const std::vector<std::string>& allowed) {
  if (std::find(allowed.begin(), allowed.end(), word) != allowed.end()) return;
  throw tb::InputError("dsdpv1-sim " + option + " is " + word + tb::did_you_mean(word, allowed) + ", allowed are " +
                       tb::join(allowed));
}

int baud_index(const std::string& option, const std::string& word) {
  std::vector<std::string> allowed;
  allowed.reserve(std::size(bus::kBauds));
  for (const bus::Baud& baud : bus::kBauds) allowed.emplace_back(baud.name);
  check_word(option, word, allowed);
  return *bus::baud_index(word);
}

tb::CaptureRequest capture_request(const std::string& command, const std::string& path, const std::string& link) {
  const std::optional<std::uint16_t> number = bus::capture::link_type(link);
  if (!number)
    throw tb::InputError(command + ": --capture-link is " + link + ", allowed are " + bus::capture::kLinkWords);
  return {path, *number, "dsdpv1-sim " DSDPV1_VERSION};
}

int command_line(int argc, char** argv, PrintableOutput& output) {
  CLI::App app("Cycle-accurate simulation of the DSDPV1 PROFIBUS-DP slave chip with its bus and its user CPU.",
               "dsdpv1-sim");
  describe_program(app);
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
  RegressArguments regress_arguments;
  describe_regress(app, regress_arguments);
  RtlRandomArguments rtl_random_arguments;
  RtlFaultsArguments rtl_faults_arguments;
  describe_rtl_random(app, rtl_random_arguments);
  describe_rtl_faults(app, rtl_faults_arguments);
  CosimArguments cosim_arguments;
  describe_cosim(app, cosim_arguments);
  CompareArguments compare_arguments;
  describe_compare(app, compare_arguments);
  ReplayArguments replay_arguments;
  describe_replay(app, replay_arguments);
  CalibrateArguments calibrate_arguments;
  describe_calibrate(app, calibrate_arguments);
  TracesArguments traces_arguments;
  describe_traces(app, traces_arguments);
  RecoverArguments recover_arguments;
  describe_recover(app, recover_arguments);
  std::string color;
  describe_what_is_general(app, color);
  if (const std::optional<int> status = parse(app, argc, argv)) return *status;
  check_word("--color", color, {"auto", "always", "never"});
  if (wants_colour(color)) output.paint();
  const tb::TableWidth as_wide_as_the_terminal(terminal_columns());
  for (CampaignArguments* each : {&sweep_arguments.campaign, &regress_arguments.campaign})
    each->words.assign(argv + 1, argv + argc);
  if (app.got_subcommand("run")) return run(run_arguments);
  if (app.got_subcommand("serve")) return serve(serve_arguments);
  if (app.got_subcommand("sweep")) return sweep(sweep_arguments);
  if (app.got_subcommand("regress")) return regress(regress_arguments);
  if (app.got_subcommand("rtl-random")) return rtl_random(rtl_random_arguments);
  if (app.got_subcommand("rtl-faults")) return rtl_faults(rtl_faults_arguments);
  if (app.got_subcommand("cosim")) return cosim_own_rtl(cosim_arguments);
  if (app.got_subcommand("compare")) return compare(compare_arguments);
  if (app.got_subcommand("replay")) return replay(replay_arguments);
  if (app.got_subcommand("calibrate")) return calibrate(calibrate_arguments);
  if (app.got_subcommand("traces")) return traces(traces_arguments);
  if (app.got_subcommand("recover")) return recover(recover_arguments);
  if (app.got_subcommand("schema")) return schema(schema_arguments);
  if (app.got_subcommand("gsd")) return gsd(gsd_arguments);
  if (app.got_subcommand("reasons")) return reasons(reasons_arguments);
  return decode(decode_arguments);
}

}  // namespace dsdpv1::app
