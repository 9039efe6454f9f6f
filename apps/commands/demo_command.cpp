// demo: power-on to data exchange, from the data that come with the program; its files go into a folder.
#include <filesystem>
#include <iostream>

#include "apps/commands/command.hpp"
#include "apps/commands/scenario_run.hpp"
#include "apps/options/scenario_files.hpp"
#include "io/input/input_error.hpp"

namespace dsdpv1::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScenario = "power_on_12m";
#ifdef DSDPV1_WITH_FST
constexpr const char* kWaveEnding = ".fst";
#else
constexpr const char* kWaveEnding = ".vcd";
#endif

/// Throws tb::InputError where it is not there and cannot be made.
void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error)
    throw tb::InputError("dsdpv1-sim demo: the folder " + path + " cannot be made (" + error.message() +
                         "), expected one that can: --out FOLDER");
}

class Demo : public Command {
 public:
  Demo()
      : Command("demo",
                "Power-on of the DSDPV1 to data exchange at 12 Mbit/s, by a shipped scenario: a table, a wave, a log") {
  }

  void options(CLI::App& app) override {
    app.add_option("--out", out_, "Folder for wave, log and result, which replace those of an earlier demo")
        ->capture_default_str();
    app.footer(std::string("\nExamples:\n  dsdpv1-sim demo\n  dsdpv1-sim demo --out /tmp/demo\n") + kExitCodes);
  }

  int carry_out() override {
    RunArguments given;
    given.scenario = (fs::path(scenario_folder()) / kScenario).string() + ".yaml";
    if (!fs::exists(given.scenario))
      throw tb::InputError(given.scenario, 0, "no such file, demo needs the scenarios shipped with the DSDPV1's model");
    given.wave.file = file(kWaveEnding);
    given.log = file(".log");
    given.result = file(".json");
    make_folder(out_);
    const int status = run(given);
    if (status != kInterrupted) std::cout << files(given) << std::flush;
    return status;
  }

 private:
  std::string file(const char* ending) const { return (fs::path(out_) / kScenario).string() + ending; }
  static std::string files(const RunArguments& given) {
    return "Files: " + fs::absolute(given.wave.file).string() + ", .log, .json\n";
  }

  std::string out_ = "out";
};

}  // namespace

std::unique_ptr<Command> make_demo() { return std::make_unique<Demo>(); }

}  // namespace dsdpv1::app
