// serve: offers a scenario's segment at a pseudo-terminal, a TCP port or a serial port.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "apps/commands/command.hpp"
#include "apps/commands/scenario_run.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/common.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/scenario_files.hpp"
#include "apps/options/wave_options.hpp"
#include "apps/options/words.hpp"
#include "bus/baud.hpp"
#include "bus/printable.hpp"
#include "io/input/input_error.hpp"
#include "tb/bench/bench.hpp"
#include "tb/report/html/report_file.hpp"
#include "tb/report/result_fields.hpp"
#include "tb/report/run_junit.hpp"
#include "tb/report/summary.hpp"
#include "tb/serve/ports.hpp"
#include "tb/serve/run/control_port.hpp"
#include "tb/serve/run/real_time_execution.hpp"
#include "tb/serve/run/user_port.hpp"

namespace dsdpv1::app {
namespace {

/// Longer than any computer stays up, and far from the end of 64 bits.
constexpr tb::Tick kOpenEnd = 5LL * 365 * 24 * 3600 * bus::kTicksPerSecond;

class Serve : public Command {
 public:
  Serve() : Command("serve", "Let a real master talk to a scenario's slaves, in real time") {}

  void options(CLI::App& app) override {
    app.add_option("SCENARIO", scenario_, "Scenario in YAML; it needs no masters, and its end is ignored")->required();
    add_port_options(app);
    add_user_options(app);
    app.add_option("--baud", baud_, "Baud rate (default: that of the scenario)");
    app.add_option("--for", duration_, "End after this time, for example 10s (default: Ctrl-C)");
    add_wave_options(app, wave_);
    add_log_options(app, run_.log, run_.log_whole, "As for run; the name of the growing file is printed at the start",
                    "As for run");
    app.add_option("--result", result_, "As for run, with measurements of real time");
    add_report_option(app, report_);
    app.add_option("--junit", junit_, "As for run");
    add_checks_option(app, checks_);
    add_checks_table_option(app, check_rows_);
    app.add_flag("--strict", run_.strict,
                 "Fail if the host sends before the answer to its request has left (HOST_EARLY)");
    add_set_option(app, set_);
    add_capture_options(app, capture_);
    app.add_option("--gdb", gdb_, "As for run; while the processor is halted the host gets no answer")
        ->type_name("PORT")
        ->check(CLI::Range(0, 65535));
    app.add_option("--control", control_,
                   "Take actions of the script at this TCP port of 127.0.0.1 (0: any free one), a line of JSON each")
        ->type_name("PORT")
        ->check(CLI::Range(0, 65535));
    add_quiet_option(app, quiet_);
    app.footer(std::string("\nExamples:\n"
                           "  dsdpv1-sim serve scenarios/serve_19k2.yaml --pty dp --log serve.log\n"
                           "  dsdpv1-sim serve scenarios/serve_19k2.yaml --tcp 5020\n"
                           "  dsdpv1-sim serve scenarios/serve_19k2.yaml --serial /dev/ttyUSB0 --baud 93.75k\n"
                           "  dsdpv1-sim serve scenarios/xgate_uart.yaml --user-pty host\n"
                           "docs/pyprofibus.md, docs/usb_rs485.md and docs/xgate.md take you through it.\n") +
               kExitCodes);
  }

  int carry_out() override {
    leave_nothing_on_signals();
    scenario_ = scenario_file("dsdpv1-sim serve", scenario_);
    tb::scenario::Scenario scenario =
        tb::scenario::load(scenario_, tb::scenario::parse_settings(set_), tb::scenario::Least::kNone);
    if (!baud_.empty()) scenario.baud = baud_index("dsdpv1-sim serve: --baud", baud_);
    scenario.end = duration_.empty() ? kOpenEnd : time_of("dsdpv1-sim serve: --for", duration_, 1);
    take_run_words(kinds(scenario));
    if (gdb_) attach_gdb(scenario);
    if (has_user())
      attach_user(scenario);
    else if (!user_of_.empty())
      throw tb::InputError("dsdpv1-sim serve: --user-of requires --user-pty or --user-tcp");
    run_.orders = control_.has_value();
    check_files(scenario);
    WantedFile result_file(result_), junit_file(junit_);
    std::optional<tb::html::ReportFile> report_file;
    if (!report_.empty()) report_file.emplace(report_, scenario, run_);

    std::optional<tb::serve::ControlPort> control;
    if (control_) control.emplace(*control_);
    std::optional<tb::serve::UserPort> user;
    if (has_user()) user.emplace(open_user_port(), user_line_);
    auto port = open_port(scenario.baud);
    const std::string name = port->name();
    auto made = std::make_unique<tb::serve::RealTimeExecution>(std::move(port), scenario.baud);
    tb::serve::RealTimeExecution& execution = *made;
    tb::Bench bench(scenario, run_, std::move(made));
    if (!run_.log.empty()) std::cerr << "serve: the log grows as " << bench.log_grows_at() << '\n';
    execution.join();
    execution.say = [&bench](tb::Tick at, const std::string& text) {
      std::cerr << "serve: " << text << '\n';
      bench.log(at, "host", "serve", text);
    };
    if (user) {
      std::cerr << "serve: the user CPU of " << run_.outside->slave << " is the program at " << user->name() << '\n';
      user->say = execution.say;
    }
    execution.link().on_early = [&bench](tb::Tick at, const bus::Bytes& telegram) { bench.host_early(at, telegram); };
    execution.link().on_gone = [&bench] { bench.host_gone(); };
    bench.leave_untimed([&execution](tb::Tick start) { return execution.link().line().began_at(start); });
    if (control) std::cerr << "serve: takes actions at " << control->address() << '\n';
    execution.on_round = [&](tb::Tick now) {
      if (control) control->look([&bench](const std::string& line) { return answer_to(bench, line); });
      if (user) user->look(now);
    };
    catch_signals();
    std::cout << "serving \"" << bus::printable(scenario.name) << "\" at " << bus::baud(scenario.baud).name << " on "
              << name << "; Ctrl-C ends\n"
              << std::flush;

    tb::RunResult result = bench.run([](tb::Tick) { return !interrupted(); });
    if (wave_.save) write_save_files(wave_.file, kinds(scenario));
    if (bench.wave_is_empty()) std::cerr << nothing_recorded(wave_) << '\n';
    result.pacing = execution.pacing();
    result_file.write([&] { return tb::result_json(result); });
    junit_file.write([&] { return tb::junit("dsdpv1-sim serve", tb::run_cases(result)); });
    if (report_file) report_file->write(result, DSDPV1_VERSION);
    if (!quiet_) std::cout << tb::summary(result, check_rows_) << std::flush;
    return exit_code(verdict(result));
  }

 private:
  /// To a line of the control port.
  static std::string answer_to(tb::Bench& bench, const std::string& line) {
    try {
      bench.order(line);
      return "ok";
    } catch (const tb::InputError& error) {
      return bus::printable(error.what());
    }
  }

  void add_port_options(CLI::App& app) {
    CLI::Option* pty = app.add_option("--pty", link_, "Use a pseudo-terminal (default) with this name as a link to it")
                           ->expected(0, 1);
    CLI::Option* tcp = app.add_option("--tcp", tcp_, "Use this TCP port (0: any free one), one byte per character")
                           ->check(CLI::Range(0, 65535));
    CLI::Option* serial = app.add_option("--serial", serial_, "Use this serial port, 8E1, with an RS-485 transceiver");
    pty->excludes(tcp)->excludes(serial);
    tcp->excludes(serial);
    app.add_option("--bind", bind_, "IPv4 address of --tcp")->capture_default_str()->needs(tcp);
    app.add_option("--turn", turn_,
                   "A host that sends nothing for so many seconds while others wait loses the TCP port (0: keeps it)")
        ->check(CLI::Range(0, 86400))
        ->capture_default_str()
        ->needs(tcp);
    app.add_flag("--rts", rts_, "Switch the transceiver by RTS of the serial port (default: it switches automatically)")
        ->needs(serial);
  }

  void add_user_options(CLI::App& app) {
    CLI::Option* pty = app.add_option("--user-pty", user_link_,
                                      "A program of yours is the user CPU, by a UART: at a pseudo-terminal with this "
                                      "name as a link to it (docs/xgate.md)")
                           ->expected(0, 1);
    CLI::Option* tcp = app.add_option("--user-tcp", user_tcp_, "The same at a TCP port of 127.0.0.1 (0: any free one)")
                           ->type_name("PORT")
                           ->check(CLI::Range(0, 65535));
    app.add_option("--user-of", user_of_, "Its slave (default: the only one with a UART for it)");
    pty->excludes(tcp);
    user_pty_ = pty;
  }

  bool has_user() const { return user_pty_->count() != 0 || user_tcp_ >= 0; }

  void attach_user(const tb::scenario::Scenario& scenario) {
    std::vector<std::string> able;
    for (const tb::scenario::Slave& slave : scenario.slaves)
      if (slave.kind->has_outside_line(slave)) able.push_back(slave.name.text);
    const std::string option = user_tcp_ >= 0 ? "--user-tcp" : "--user-pty";
    if (able.empty())
      throw tb::InputError("dsdpv1-sim serve: " + option + " needs a slave with a UART for its user CPU, " +
                           scenario.file + " has none");
    const bool named = std::find(able.begin(), able.end(), user_of_) != able.end();
    if (!named && (able.size() > 1 || !user_of_.empty()))
      throw tb::InputError(
          fmt::format("dsdpv1-sim serve: --user-of is {}, expected a slave with a UART for its user CPU: {}",
                      user_of_.empty() ? "missing" : bus::printable(user_of_), fmt::join(able, ", ")));
    run_.outside = tb::OutsideUser{named ? user_of_ : able.front(), &user_line_};
  }

  std::unique_ptr<tb::serve::HostConnection> open_user_port() const {
    if (user_tcp_ >= 0) return tb::serve::open_tcp("127.0.0.1", user_tcp_, std::chrono::seconds(0));
    return tb::serve::open_pty(user_link_, 0);
  }

  void take_run_words(const tb::ChipKinds& kinds) {
    run_.wave = wave_options("dsdpv1-sim serve", wave_, kinds);
    run_.capture = capture_request("dsdpv1-sim serve", capture_);
    run_.checks = checks_mode("dsdpv1-sim serve", checks_);
    run_.open_ended = run_.host = true;
  }

  void attach_gdb(const tb::scenario::Scenario& scenario) {
    check_has_board("dsdpv1-sim serve", scenario);
    const auto say = [](const std::string& line) { std::cerr << line << '\n'; };
    run_.gdb = tb::GdbRequest{gdb_, say, interrupted, std::make_shared<user_cpu::DebugHistory>(), false};
  }

  void check_files(const tb::scenario::Scenario& scenario) const {
    std::vector<NamedFile> outputs = wave_files("dsdpv1-sim serve", wave_.file, wave_.save);
    outputs.insert(outputs.end(), {{"--log", run_.log},
                                   {"--result", result_},
                                   {"--report", report_},
                                   {"--junit", junit_},
                                   {"--capture", capture_.file}});
    check_outputs("dsdpv1-sim serve", scenario_inputs(scenario_, scenario.files), outputs);
  }

  std::unique_ptr<tb::serve::HostConnection> open_port(int baud) const {
    const int bits_per_second = static_cast<int>(bus::kTicksPerSecond / bus::baud(baud).bit);
    if (!serial_.empty()) return tb::serve::open_serial({serial_, bits_per_second, rts_});
    if (tcp_ >= 0) return tb::serve::open_tcp(bind_, tcp_, std::chrono::seconds(turn_));
    return tb::serve::open_pty(link_, bits_per_second);
  }

  std::string scenario_;
  std::string link_;  ///< of the pseudo-terminal; empty: none
  int tcp_ = -1;      ///< port; 0: any free one; -1: no TCP
  std::string bind_ = "127.0.0.1";
  int turn_ = 10;  ///< s; 0: a host keeps the TCP port
  std::string serial_;
  bool rts_ = false;
  std::string baud_;      ///< empty: that of the scenario
  std::string duration_;  ///< empty: until interrupted
  WaveArguments wave_;
  tb::RunOptions run_;
  std::string result_, report_, junit_;  ///< files, empty: not wanted
  tb::CheckRows check_rows_ = tb::CheckRows::kViolated;
  std::string checks_;  ///< empty: as the scenario says
  std::vector<std::string> set_;
  std::optional<int> gdb_, control_;
  CLI::Option* user_pty_ = nullptr;
  std::string user_link_;  ///< of its pseudo-terminal; empty: none
  int user_tcp_ = -1;      ///< port; 0: any free one; -1: no TCP
  std::string user_of_;    ///< a slave; empty: the only one that can have it
  user_cpu::OutsideLine user_line_;
  CaptureArguments capture_;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_serve() { return std::make_unique<Serve>(); }

}  // namespace dsdpv1::app
