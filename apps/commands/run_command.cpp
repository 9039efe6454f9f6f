#include "apps/commands/command.hpp"
#include "apps/commands/scenario_run.hpp"

namespace dsdpv1::app {
namespace {

constexpr const char* kRunExamples =
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

class Run : public Command {
 public:
  Run() : Command("run", "Run a scenario and report whether it passed") {}

  void options(CLI::App& app) override {
    add_what_to_run(app);
    add_wave_options(app, given_.wave);
    add_log_options(app, given_.log, given_.log_whole);
    app.add_option("--result", given_.result, "Write result and measurements as JSON");
    add_report_option(app, given_.report);
    app.add_option(
        "--junit", given_.junit,
        "Write the verdict for CI as JUnit's XML: a case for the run, its violations, each check and expectation");
    add_capture_options(app, given_.capture);
    of_whole_run_.push_back(add_checks_option(app, given_.checks));
    add_checks_table_option(app, given_.check_rows);
    add_comparison_options(app);
    of_whole_run_.push_back(add_set_option(app, given_.set));
    add_ways_back(app);
    add_output_options(app, given_.progress, given_.quiet);
    app.footer(std::string(kRunExamples) + kExitCodes);
  }

  int carry_out() override { return run(given_); }

 private:
  void add_what_to_run(CLI::App& app) {
    CLI::Option* scenario = app.add_option("SCENARIO", given_.scenario, "Scenario in YAML, see docs/scenarios.md");
    CLI::Option* engine = app.add_option("--engine", given_.engine,
                                         "Execution of the chips: step (every cycle), skip (from event to event), rtl "
                                         "(the reference RTL), lockstep (model and RTL side by side, compared)")
                              ->capture_default_str();
    CLI::Option* view = app.add_option("--view", given_.view,
                                       "Access of the user CPUs to them: pins, tlm (SystemC; not with an ARM board)")
                            ->capture_default_str();
    of_whole_run_ = {scenario, engine, view};
  }

  /// The options for comparisons of a run, and for its RTL.
  void add_comparison_options(CLI::App& app) {
    app.add_option("--trace", given_.trace, "Write every change of every output pin, for comparisons");
    app.add_option("--difference", given_.difference,
                   "Write a wave of both sides when --engine lockstep finds a difference")
        ->capture_default_str();
    CLI::Option* golden = app.add_option("--golden", given_.golden,
                                         "Folder of golden traces (traces): every change of every pin is compared, the "
                                         "first difference ends the run (docs/traces.md)");
    CLI::Option* fault =
        app.add_option(
               "--fault", given_.fault,
               "Enable this single fault of rtl_ref/dsdpv1/faults.txt, or dsdpv1_rsu/faults.txt, in the reference RTL")
            ->check(CLI::Range(0, 255));
    CLI::Option* seed =
        app.add_option("--seed", given_.seed,
                       "With --engine rtl or lockstep: seed of RTL's initial values that are not reset (default: 1)");
    of_whole_run_.insert(of_whole_run_.end(), {golden, fault, seed});
  }

  /// To a time of the run, or to one before it.
  void add_ways_back(CLI::App& app) {
    app.add_option("--save-at", given_.save_at,
                   "Save the run at this time, for --restore; once for each time (docs/save_restore.md)")
        ->type_name("TIME FILE")
        ->allow_extra_args(false);
    CLI::Option* rewind =
        app.add_option("--rewind-on", given_.rewind_on,
                       "Write the wave only from TIME before the first event with this CODE of the log, or violation, "
                       "to TIME after it, by re-running from a snapshot (docs/save_restore.md)")
            ->type_name("CODE TIME")
            ->needs(app.get_option("--wave"));
    for (const char* each : {"--wave-on", "--wave-from", "--wave-to", "--wave-inside"})
      rewind->excludes(app.get_option(each));
    CLI::Option* restore =
        app.add_option("--restore", given_.restore,
                       "Resume a saved run instead of a scenario; log, wave, trace and capture begin there");
    for (CLI::Option* each : of_whole_run_) restore->excludes(each);
    rewind->excludes(restore);
    app.add_option(
           "--gdb", given_.gdb,
           "TCP port (0: any free one) where gdb-multiarch attaches to the first ARM board; the run waits for it")
        ->excludes(rewind)
        ->check(CLI::Range(0, 65535));
  }

  RunArguments given_;
  std::vector<CLI::Option*> of_whole_run_;  ///< what a saved run already has
};

}  // namespace

std::unique_ptr<Command> make_run() { return std::make_unique<Run>(); }

}  // namespace dsdpv1::app
