// A GSD file, and the data that a master derives from it.
#include "bus/gsd/gsd.hpp"

#include <sstream>

#include "bus/gsd/report.hpp"
#include "bus/gsd/setup.hpp"
#include "tests/fuzz/input.hpp"

namespace dsdpv1 {
namespace {

/// The first two modules, and the first parameter of the station with another value.
bus::GsdChoice choice(const bus::Gsd& gsd) {
  bus::GsdChoice choice;
  for (std::size_t i = 0; i < gsd.modules.size() && i < 2; ++i) choice.modules.push_back(gsd.modules[i].name);
  if (!gsd.prm.refs.empty())
    choice.overrides.push_back({std::nullopt, std::to_string(gsd.prm.refs.front().parameter), "1"});
  return choice;
}

void use(const bus::Gsd& gsd, const bus::GsdChoice& choice, const std::vector<bus::GsdDiagnostic>& remarks,
         bus::GsdFormat format) {
  const bus::GsdSetup setup = bus::set_up(gsd, choice);
  std::ostringstream out;
  bus::print_gsd_report(gsd, setup, remarks, out, format);
  fuzz::promise(!out.str().empty(), "there is a report");
  bus::SlaveParameters parameters;
  bus::enable_dpv1(gsd, parameters);
  if (!setup.ok()) return;
  fuzz::promise(setup.chk_cfg.size() <= 244, "Chk_Cfg fits a telegram");
  fuzz::promise(setup.user_prm.size() <= 237, "Set_Prm fits a telegram");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  const bus::GsdResult result = bus::parse_gsd(in, "a.gsd");
  fuzz::promise(result.diagnostics.size() <= 201, "at most 200 remarks and the word that there are more");
  for (const bus::GsdDiagnostic& each : result.diagnostics) fuzz::promise_named(bus::to_string(each), "a.gsd");
  if (!result.gsd) {
    fuzz::promise(!result.diagnostics.empty(), "a file that cannot be used has an error");
    return 0;
  }
  use(*result.gsd, {}, result.diagnostics, bus::GsdFormat::kText);
  use(*result.gsd, choice(*result.gsd), result.diagnostics, bus::GsdFormat::kJson);
  return 0;
}

}  // namespace dsdpv1
