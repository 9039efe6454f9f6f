#include "apps/options/own_rtl.hpp"

#include <CLI/CLI.hpp>

#include "apps/data_folder.hpp"

namespace dsdpv1::app {

void add_own_rtl_options(CLI::App& command, OwnRtlArguments& arguments, bool required) {
  CLI::Option* rtl =
      command.add_option("--rtl", arguments.rtl,
                         required ? "Folder of the RTL" : "Folder of RTL of your own, in place of the reference RTL");
  CLI::Option* top = command.add_option("--top", arguments.top, "Its top module")->needs(rtl);
  CLI::Option* pins =
      command.add_option("--pins", arguments.pins, "Names, polarities and tolerances of its pins, see docs/cosim.md");
  CLI::Option* build =
      command.add_option("--build", arguments.build, "Folder for what is built of it")->capture_default_str();
  if (required) {
    rtl->required();
    top->required();
    return;
  }
  rtl->needs(top);
  pins->needs(rtl);
  build->needs(rtl);
}

OwnRtl build_own_rtl(const OwnRtlArguments& arguments, const std::string& command, bool traced) {
  OwnRtl own{arguments.pins.empty() ? cosim::default_pin_map() : cosim::load_pin_map(arguments.pins), {}};
  own.make =
      cosim::build_user_rtl({command, arguments.rtl, arguments.top, arguments.build, data_folder(), traced}, own.map);
  return own;
}

}  // namespace dsdpv1::app
