// gsd: a GSD file as a master reads it.
#include <iostream>
#include <sstream>

#include "apps/commands/command.hpp"
#include "bus/gsd/report.hpp"
#include "io/input/read_file.hpp"

namespace dsdpv1::app {
namespace {

class Gsd : public Command {
 public:
  Gsd() : Command("gsd", "Check a PROFIBUS GSD file and print a master's settings from it") {}

  void options(CLI::App& app) override {
    app.add_option("FILE", file_, "GSD file, revision 1 to 5")->required();
    app.add_option("--module,-m", given_.choice.modules,
                   "Module by name or number, once for each slot (default: the file's presets)")
        ->allow_extra_args(false);
    app.add_flag("--json", json_, "As JSON");
    app.footer(
        "\nExamples:\n  dsdpv1-sim gsd scenarios/dsdpv1.gsd\n  dsdpv1-sim gsd my_device.gsd --module \"8 bytes in\" "
        "--module 3 --json\n");
  }

  int carry_out() override {
    if (json_) given_.format = bus::GsdFormat::kJson;
    std::istringstream in(tb::read_file(file_, tb::kGsdFile));
    return bus::gsd_command(in, file_, given_, std::cout, std::cerr);
  }

 private:
  std::string file_;
  bus::GsdCommand given_;
  bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_gsd() { return std::make_unique<Gsd>(); }

}  // namespace dsdpv1::app
