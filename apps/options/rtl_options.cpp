#include "apps/options/rtl_options.hpp"

#include "apps/data_folder.hpp"
#include "apps/options/words.hpp"
#include "io/input/input_error.hpp"

namespace dsdpv1::app {

void add_chip_options(CLI::App& app, RtlChip& chip) {
  app.add_option("--chip", chip.chip, "The chip of the reference RTL: dsdpv1, dsdpv1_r, dsdpv1_rsu")
      ->capture_default_str();
  app.add_option("--mode", chip.mode, "Of the dsdpv1_rsu, for random cases: the host's port, parallel, spi or uart")
      ->capture_default_str();
}

Part RtlChip::part() const {
  std::vector<std::string> names;
  for (const PartRow& row : kParts) names.emplace_back(row.name);
  check_word("dsdpv1-sim --chip", chip, names);
  return *part_called(chip);
}

HostMode RtlChip::host() const {
  const Part of = part();
  const auto host =
      value_of<HostMode>("dsdpv1-sim --mode", mode,
                         {{"parallel", HostMode::kParallel}, {"spi", HostMode::kSpi}, {"uart", HostMode::kUart}});
  if (!has_serial_ports(of) && host != HostMode::kParallel)
    throw tb::InputError("--mode " + mode +
                         ": only the dsdpv1_rsu has that port, allowed is --chip dsdpv1_rsu with it");
  return host;
}

CLI::Option* add_fault_option(CLI::App& app, unsigned& fault) {
  return app.add_option("--fault", fault, "With this single fault of rtl_ref/dsdpv1/faults.txt in the reference RTL")
      ->check(CLI::Range(0, 255));
}

void add_own_rtl_options(CLI::App& app, OwnRtlArguments& arguments, bool required) {
  CLI::Option* rtl =
      app.add_option("--rtl", arguments.rtl,
                     required ? "Folder of the RTL" : "Folder of RTL of your own, in place of the reference RTL");
  CLI::Option* top = app.add_option("--top", arguments.top, "Its top module")->needs(rtl);
  CLI::Option* pins =
      app.add_option("--pins", arguments.pins, "Names, polarities and tolerances of its pins, see docs/cosim.md");
  CLI::Option* build =
      app.add_option("--build", arguments.build, "Folder for what is built of it")->capture_default_str();
  if (required) {
    rtl->required();
    top->required();
    return;
  }
  rtl->needs(top);
  pins->needs(rtl);
  build->needs(rtl);
}

OwnRtl build_own_rtl(const OwnRtlArguments& arguments, const std::string& command, const tb::ChipKind& kind,
                     bool traced) {
  OwnRtl own{
      arguments.pins.empty() ? cosim::default_pin_map(kind.pins()) : cosim::load_pin_map(arguments.pins, kind.pins()),
      {}};
  own.make = cosim::build_user_rtl({command, arguments.rtl, arguments.top, arguments.build, data_folder(), traced},
                                   own.map, kind);
  return own;
}

}  // namespace dsdpv1::app
