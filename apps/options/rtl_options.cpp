#include "apps/options/rtl_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "apps/data_folder.hpp"
#include "apps/options/words.hpp"
#include "cosim/lockstep_execution.hpp"
#include "io/input/input_error.hpp"

namespace dsdpv1::app {
namespace {

/// The kinds of chips that rtl-random can test.
std::vector<const tb::ChipKind*> random_kinds() {
  std::vector<const tb::ChipKind*> kinds = tb::chip_kinds();
  kinds.erase(std::remove_if(kinds.begin(), kinds.end(), [](const auto* each) { return each->random() == nullptr; }),
              kinds.end());
  return kinds;
}

}  // namespace

CLI::Option* add_chip_option(CLI::App& app, RtlChip& chip) {
  return app.add_option("--chip", chip.chip, "The chip: dsdpv1, dsdpv1_r, dsdpv1_rsu")
      ->type_name("WORD")
      ->capture_default_str();
}

void add_chip_options(CLI::App& app, RtlChip& chip, bool with_mode) {
  add_chip_option(app, chip);
  if (!with_mode) return;
  app.add_option("--mode", chip.mode, "The dsdpv1_rsu's host port in random cases: parallel, spi or uart")
      ->capture_default_str();
}

const tb::ChipKind& RtlChip::kind() const {
  std::vector<std::string> names;
  for (const tb::ChipKind* each : random_kinds()) names.emplace_back(each->name());
  check_word("dsdpv1-sim --chip", chip, names);
  return *tb::find_chip_kind(chip);
}

const cosim::HostPort& RtlChip::port() const {
  for (const cosim::HostPort& port : kind().random()->words().ports)
    if (mode == port.word) return port;
  std::vector<std::string> words;
  for (const tb::ChipKind* each : random_kinds())
    for (const cosim::HostPort& port : each->random()->words().ports) {
      if (mode == port.word)
        throw tb::InputError(
            fmt::format("--mode {0}: only the {1} has that port, expected --chip {1} with it", mode, each->name()));
      if (std::find(words.begin(), words.end(), port.word) == words.end()) words.emplace_back(port.word);
    }
  check_word("dsdpv1-sim --mode", mode, words);
  return kind().random()->words().ports.front();
}

CLI::Option* add_fault_option(CLI::App& app, unsigned& fault) {
  return app
      .add_option("--fault", fault,
                  "Enable this single fault: of rtl_ref/dsdpv1/faults.txt, or of your RTL, whose map then has fault:")
      ->check(CLI::Range(0, 255));
}

bool has_tolerance(const cosim::PinMap& map) {
  return std::any_of(
      map.tolerances.begin(), map.tolerances.end(), [](auto each) { return each != 0; });
}

CLI::Option* add_no_dpram_option(CLI::App& app, bool& no_dpram) {
  return app.add_flag("--no-dpram", no_dpram,
                      "As with --rtl: the DPRAM is not compared, and a second user reads what the chip has written");
}

void add_own_rtl_options(CLI::App& app, OwnRtlArguments& arguments, bool required) {
  CLI::Option* rtl = app.add_option(
      "--rtl", arguments.rtl, required ? "Folder of the RTL" : "Folder of your RTL, which replaces the reference RTL");
  CLI::Option* top = app.add_option("--top", arguments.top, "Its top module")->needs(rtl);
  CLI::Option* pins =
      app.add_option("--pins", arguments.pins, "Names, polarities and tolerances of its pins, see docs/cosim.md");
  CLI::Option* build = app.add_option("--build", arguments.build, "Folder for its build")->capture_default_str();
  if (required) {
    rtl->required();
    top->required();
    return;
  }
  rtl->needs(top);
  pins->needs(rtl);
  build->needs(rtl);
}

void add_coverage_option(CLI::App& app, OwnRtlArguments& arguments) {
  app.add_option("--coverage", arguments.coverage,
                 "Count which lines, branches and toggles of your RTL are reached; write lcov's tracefile")
      ->needs("--rtl");
}

void CoverageFile::add(const std::function<std::string()>& counts) {
  if (counts) tb::coverage::add(reached_, tb::coverage::of_verilator(counts(), "coverage"));
}

void CoverageFile::write() {
  file_.write([this] { return tb::coverage::lcov(reached_); });
}

cosim::PinMap load_map(const std::string& path, const tb::ChipKind& kind) {
  std::vector<std::string> parameters;
  if (kind.rtl() != nullptr)
    for (const cosim::RtlParameter& each : kind.rtl()->parameters(*kind.make_chip_settings()))
      parameters.emplace_back(each.key);
  return cosim::load_pin_map(path, kind.pins(), parameters);
}

cosim::PinMap own_map(const OwnRtlArguments& arguments, const tb::ChipKind& kind) {
  cosim::require_rtl(kind);
  return arguments.pins.empty() ? cosim::default_pin_map(kind.pins()) : load_map(arguments.pins, kind);
}

std::vector<NamedFile> own_inputs(const OwnRtlArguments& arguments) {
  static const std::set<std::string> kEndings = {".sv", ".v", ".svh", ".vh", ".f"};
  std::vector<NamedFile> inputs = {{"--pins", arguments.pins}};
  std::error_code not_there;  // the build says so
  const auto all = std::filesystem::directory_options::skip_permission_denied;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(arguments.rtl, all, not_there))
    if (kEndings.count(entry.path().extension()) != 0) inputs.push_back({"a file of --rtl", entry.path()});
  return inputs;
}

bool takes(const cosim::PinMap& map, const std::vector<std::string>& set) {
  const std::string chip = "chip.";
  return std::all_of(set.begin(), set.end(), [&](const std::string& each) {
    return each.rfind(chip, 0) == 0 && map.chip.count(each.substr(chip.size(), each.find('=') - chip.size())) != 0;
  });
}

/// Throws tb::InputError for a key of --set that --mode sets.
void check_without_mode(const tb::ChipKind& kind, const std::vector<std::string>& set) {
  for (const cosim::HostPort& port : kind.random()->words().ports)
    for (const std::string& sets : port.set)
      for (const std::string& each : set)
        if (each.compare(0, each.find('='), sets, 0, sets.find('=')) == 0)
          throw tb::InputError(fmt::format("--set {}: this is the host port, expected --mode for it", each));
}

cosim::PlayOptions play_options(const RtlChip& chip, const OwnRtlArguments& own, const std::vector<std::string>& set,
                                bool no_dpram) {
  const tb::ChipKind& kind = chip.kind();
  check_without_mode(kind, set);
  const cosim::PinMap map = own_map(own, kind);
  const bool is_own = !own.rtl.empty(), quick = !is_own || takes(map, kind.random()->words().quick);
  cosim::PlayOptions options = quick ? cosim::quick_options(kind) : cosim::usual_options(kind);
  cosim::set_parameters(options, set);
  cosim::set_parameters(options, chip.port().set);
  options.lockstep.tolerances = map.tolerances;
  options.lockstep.compare_dpram = !is_own && !no_dpram;
  options.reads_back = is_own || no_dpram;  // what the chip writes thus appears at pins
  return options;
}

OwnRtl build_own_rtl(const OwnRtlArguments& arguments, const std::string& command, const tb::ChipKind& kind,
                     const tb::OwnSettings& chip, bool traced, unsigned fault) {
  OwnRtl own{own_map(arguments, kind), {}, {}};
  cosim::BuiltUserRtl built = cosim::build_user_rtl({command, arguments.rtl, arguments.top, arguments.build,
                                                     data_folder(), traced, fault, !arguments.coverage.empty()},
                                                    own.map, kind, chip);
  own.make = std::move(built.make);
  own.counts = std::move(built.counts);
  return own;
}

}  // namespace dsdpv1::app
