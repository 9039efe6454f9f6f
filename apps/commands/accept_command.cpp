// accept: firmware judged without a scenario, by the stimuli of lab/accept.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <optional>

#include "apps/commands/command.hpp"
#include "apps/data_folder.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/common.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/words.hpp"
#include "bus/printable.hpp"
#include "io/input/input_error.hpp"
#include "io/input/units.hpp"
#include "lab/accept/facts.hpp"
#include "lab/accept/outcome.hpp"
#include "lab/accept/plan.hpp"
#include "tb/bench/bench.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/report/html/report_file.hpp"
#include "tb/report/progress.hpp"
#include "tb/report/result_fields.hpp"
#include "tb/report/summary.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::app {
namespace {

constexpr const char* kAcceptHelp =
    "\nOne run from the first initialisation on. A master brings the slave up, changes its outputs in each exchange, "
    "and "
    "applies the stimuli one after the other. The checks judge the firmware (docs/checks.md); the table shows what was "
    "met how often. Phases of interrupts are met by chance: another --seed meets others.\n"
    "An ELF file for a Cortex-M3 runs on the ARM board, a program of this computer as a process (docs/tutorials/"
    "c_driver_on_host.md), both by the chip's pins. --engine rtl and --view tlm of run are not served.\n"
    "\nExamples:\n"
    "  dsdpv1-sim accept my.elf\n"
    "  dsdpv1-sim accept my.elf --gsd my.gsd --module '2 bytes in' --module '2 bytes out' --address 7\n"
    "  dsdpv1-sim accept my.elf --mode spi --seed 5 --report my.html\n"
    "  dsdpv1-sim accept ./my_device --set user_cpu.arguments=[spi] --mode spi\n"
    "  dsdpv1-sim accept my.elf --only interrupts --only 'newer block'\n"
    "  dsdpv1-sim accept my.elf --scenario my.yaml && dsdpv1-sim run my.yaml --gdb 3333\n"
    "\nExit codes: 0 accepted, 1 not accepted, 2 wrong input, 130 interrupted.\n";

class Accept : public Command {
 public:
  Accept() : Command("accept", "Judge firmware by many stimuli, without a scenario") {}

  void options(CLI::App& app) override {
    app.add_option("PROGRAM", order_.program, "The firmware, an ELF file: for the ARM board, or for this computer");
    app.add_flag("--native", native_, "The bench's own user CPU instead of firmware");
    app.add_option("--gsd", order_.gsd, "GSD file of the device (default: that of the examples)");
    app.add_option("--module", order_.modules,
                   "A module that is plugged in, once for each in the order of the slots (default with the examples' "
                   "GSD: 2 bytes in, 2 bytes out)")
        ->allow_extra_args(false);
    app.add_option("--address", order_.address, "Station address that the firmware sets")
        ->check(CLI::Range(0, 125))
        ->capture_default_str();
    app.add_option("--chip", order_.chip,
                   "Kind of chip: dsdpv1, dsdpv1_r, dsdpv1_rsu (default: dsdpv1_rsu with --mode)")
        ->type_name("KIND");
    app.add_option("--mode", order_.mode, "Host port of a DSDPV1-RSU: parallel, spi, uart");
    app.add_option("--baud", order_.baud, "Baud rate of the masters, as in scenarios")->capture_default_str();
    app.add_option("--seed", order_.seed, "Of outputs and times")
        ->check(CLI::Range(1, 0x7FFFFFFE))
        ->capture_default_str();
    app.add_option("--within", within_,
                   "The firmware serves what comes within this time; the pauses of the stimuli follow from it")
        ->type_name("TIME")
        ->capture_default_str();
    app.add_option("--object", object_, "An object that masters may read")
        ->type_name("SLOT,INDEX,LENGTH")
        ->capture_default_str();
    app.add_option("--only", order_.only, "Only this stimulus, once for each")
        ->type_name("STIMULUS")
        ->allow_extra_args(false);
    app.add_flag("--list", list_, "List the stimuli instead");
    app.add_option("--engine", engine_, "skip, or step: every cycle evaluated")->capture_default_str();
    add_set_option(app, set_);
    app.add_option("--scenario", scenario_, "Write the run as a scenario, for run");
    app.add_option("--log", log_, kLogHelp);
    app.add_option("--result", result_, "Write result and measurements as JSON");
    add_report_option(app, report_);
    add_checks_table_option(app, rows_);
    add_output_options(app, progress_, quiet_);
    app.footer(kAcceptHelp);
  }

  int carry_out() override {
    if (list_) return print_list();
    leave_nothing_on_signals();
    complete();
    const tb::accept::Plan plan = tb::accept::make_plan(order_, scenario_.empty() ? "accept" : scenario_);
    check_outputs("dsdpv1-sim accept", {{"the firmware", order_.program}, {"the GSD file", order_.gsd}},
                  {{"--scenario", scenario_}, {"--log", log_}, {"--result", result_}, {"--report", report_}});
    write_wanted(scenario_, plan.text);
    return judge(plan);
  }

 private:
  static int print_list() {
    for (const tb::accept::Stimulus& each : tb::accept::stimuli())
      std::cout << tb::named_line(each.name, each.about, 20);
    return kPassed;
  }

  /// The stimuli are about a memory that chip and user share.
  static std::vector<std::string> chips() {
    std::vector<std::string> names;
    for (const tb::ChipKind* kind : tb::chip_kinds())
      if (!kind->busy_times().empty()) names.emplace_back(kind->name());
    return names;
  }

  /// Fills in what depends on other options; throws tb::InputError.
  void complete() {
    if (order_.program.empty() != native_)
      throw tb::InputError(native_ ? "dsdpv1-sim accept: --native has no PROGRAM, expected one of them"
                                   : "dsdpv1-sim accept: PROGRAM is missing (dsdpv1-sim accept PROGRAM)");
    check_word("dsdpv1-sim accept: --engine", engine_, {"step", "skip"});
    if (order_.chip.empty()) order_.chip = order_.mode.empty() ? "dsdpv1" : "dsdpv1_rsu";
    check_word("dsdpv1-sim accept: --chip", order_.chip, chips());
    if (order_.gsd.empty()) {
      order_.gsd = std::filesystem::path(data_folder()) / "scenarios" / "dsdpv1.gsd";
      if (order_.modules.empty()) order_.modules = {"2 bytes in", "2 bytes out"};
    }
    order_.settings = tb::scenario::parse_settings(set_);
    order_.within = time_within();
    const int read =
        std::sscanf(object_.c_str(), "%3d,%3d,%3d", &order_.object.slot, &order_.object.index, &order_.object.length);
    const auto is_byte = [](int value) { return value >= 0 && value <= 255; };
    if (read != 3 || !is_byte(order_.object.slot) || !is_byte(order_.object.index) || order_.object.length < 1 ||
        order_.object.length > 240)
      throw tb::InputError("dsdpv1-sim accept: --object is " + object_ +
                           ", expected SLOT,INDEX,LENGTH such as 1,1,4 with a length of 1 to 240");
  }

  /// BLOCK_SERVED and VERDICT_GIVEN allow 100 ms.
  bus::Tick time_within() const {
    const std::optional<bus::Tick> time = tb::parse_time(within_);
    if (!time || *time < bus::kTicksPerMs || *time > 100 * bus::kTicksPerMs)
      throw tb::InputError("dsdpv1-sim accept: --within is " + within_ + ", expected 1ms to 100ms");
    return *time;
  }

  tb::RunOptions run_options() const {
    tb::RunOptions options;
    options.engine = engine_ == "step" ? tb::Engine::kStep : tb::Engine::kSkip;
    options.engine_name = engine_;
    options.log = log_;
    options.open_ended = true;
    if (quiet_) return options;
    options.on_text = [](const std::string& station, const std::string& line) {
      std::cout << station << "| " << bus::printable(line) << '\n' << std::flush;
    };
    return options;
  }

  int judge(const tb::accept::Plan& plan) {
    tb::RunOptions options = run_options();
    WantedFile result_file(result_);
    std::optional<tb::html::ReportFile> report;
    if (!report_.empty()) report.emplace(report_, plan.scenario, options);
    tb::accept::Facts facts(plan.scenario, plan.address);
    tb::Bench bench(plan.scenario, options, tb::make_pin_execution());
    bench.add_observer(facts);
    tb::RunResult result = run(plan, facts, bench);
    tb::accept::judge(result, plan, facts);
    result_file.write([&] { return tb::result_json(result); });
    if (report) report->write(result, DSDPV1_VERSION);
    if (!quiet_) say(plan, facts, result);
    return exit_code(verdict(result));
  }

  tb::RunResult run(const tb::accept::Plan& plan, const tb::accept::Facts& facts, tb::Bench& bench) const {
    tb::Progress progress(plan.end, shows_progress(progress_));
    catch_signals();
    const auto goes_on = [&](tb::Tick now) {
      if (facts.begun()) progress.show(now - *facts.begun());
      const bool over = facts.begun() ? now > *facts.begun() + plan.end : now > tb::accept::kLongestStart;
      return !interrupted() && !over;
    };
    tb::RunResult result = bench.run(goes_on);
    progress.clear();
    result.interrupted = interrupted();
    return result;
  }

  void say(const tb::accept::Plan& plan, const tb::accept::Facts& facts, const tb::RunResult& result) const {
    std::cout << tb::accept::table(plan, facts) << '\n' << tb::summary(result, rows_) << std::flush;
    if (facts.address() && *facts.address() != plan.address)
      std::cout << tb::line_of(
          fmt::format("the firmware gives the chip the address {0}, its master asks {1}: --address {0}",
                      *facts.address(), plan.address));
  }

  tb::accept::Order order_ = [] {
    tb::accept::Order order;
    order.chip.clear();
    return order;
  }();
  std::string object_ = "1,1,4", within_ = "10ms", engine_ = "skip", scenario_, log_, result_, report_;
  std::vector<std::string> set_;
  std::optional<bool> progress_;
  tb::CheckRows rows_ = tb::CheckRows::kViolated;
  bool native_ = false, list_ = false, quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_accept() { return std::make_unique<Accept>(); }

}  // namespace dsdpv1::app
