// rtl-faults: every single fault in the RTL must be found.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <utility>

#include "apps/commands/command.hpp"
#include "apps/data_folder.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/common.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/rtl_options.hpp"
#include "cosim/random/faults.hpp"

namespace dsdpv1::app {
namespace {

std::vector<NamedFile> with_files_of(const std::string& folder, std::vector<NamedFile> inputs) {
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    inputs.push_back({"a file of --directed", entry.path()});
  return inputs;
}

std::string given_or_own(const std::string& path, const std::string& own) {
  return path.empty() ? data_folder() + own : path;
}

constexpr const char* kCommand = "dsdpv1-sim rtl-faults";

class RtlFaults : public Command {
 public:
  RtlFaults()
      : Command("rtl-faults", "Test the lockstep: it must find every single fault in the reference RTL or your own") {}

  void options(CLI::App& app) override {
    add_chip_options(app, chip_);
    app.add_option(
        "--list", list_,
        "The list of faults (default: rtl_ref/dsdpv1/faults.txt or dsdpv1_rsu/faults.txt of this source tree)");
    app.add_option("--directed", directed_,
                   "Folder of stimulus files to play first (default: tests/cosim/stimuli/dsdpv1 or dsdpv1_rsu of this "
                   "source tree)");
    app.add_option("--cycles", cycles_, "Most random cycles for each fault")->capture_default_str();
    app.add_option("--seed", seed_, "Seed of the random cases")->capture_default_str();
    app.add_option("--jobs", jobs_, "Threads (default: one per processor)")->check(CLI::Range(1, 256));
    add_own_rtl_options(app, own_, false);
    app.get_option("--rtl")->needs("--list");
    add_no_dpram_option(app, no_dpram_)->excludes("--rtl");
    app.add_option("--set", set_, "chip.KEY=VALUE, once for each: a parameter of the model, as for rtl-random")
        ->allow_extra_args(false);
    app.add_option("--tsv", tsv_, "Write the table also as tab-separated text into this file");
    app.footer(
        "\nExamples:\n  dsdpv1-sim rtl-faults --tsv kills.tsv\n  dsdpv1-sim rtl-faults --chip dsdpv1_rsu --mode spi\n  "
        "dsdpv1-sim rtl-faults --rtl my_chip --top chip --pins pins.yaml --list my_faults.txt --cycles 5000000\n"
        "\nExit codes: 0 all found, 1 some not, 2 wrong input, 130 interrupted.\n");
  }

  int carry_out() override {
    leave_nothing_on_signals();
    const tb::ChipKind& kind = chip_.kind();
    const cosim::Vocabulary& files = kind.random()->words();
    const std::string list = given_or_own(list_, "/" + files.faults);
    const std::string folder = given_or_own(directed_, "/" + files.stimuli);
    const std::vector<cosim::Fault> faults = cosim::read_faults(list);
    const std::vector<cosim::NamedStimulus> directed = cosim::read_stimuli(folder, kind);
    std::vector<NamedFile> inputs = own_inputs(own_);
    inputs.push_back({"--list", list});
    check_outputs(kCommand, with_files_of(folder, std::move(inputs)), {{"--tsv", tsv_}});
    WantedFile tsv(tsv_);
    cosim::CampaignOptions options{seed_, cycles_ / 10, at_a_time(jobs_), play_options(chip_, own_, set_, no_dpram_)};
    check(faults, options.play);
    const cosim::MakeFaulty make = [this](const cosim::Fault& fault, const cosim::PlayOptions& play) {
      return make_faulty(fault, play);
    };
    const cosim::Kill none =
        cosim::hunt({0, "none", "", "the build for the faults, with none active"}, directed, options, make);
    options.cycles = cycles_;
    std::cout << cosim::heading();
    if (none.found) {
      std::cout << cosim::line_of(none) << "model and RTL differ without a fault; find that out first\n";
      return kFailed;
    }
    const std::vector<cosim::Kill> kills = cosim::hunt_all(
        faults, directed, options, make,
        [](const cosim::Kill& kill) { std::cout << cosim::line_of(kill) << std::flush; });
    tsv.write([&] { return cosim::to_tsv(kills); });
    const auto found = std::count_if(kills.begin(), kills.end(), [](const cosim::Kill& kill) { return kill.found; });
    std::cout << fmt::format("{} of {} faults found\n", found, faults.size());
    return found == static_cast<std::ptrdiff_t>(faults.size()) ? kPassed : kFailed;
  }

 private:
  cosim::MakeTop make_faulty(const cosim::Fault& fault, const cosim::PlayOptions& play) const {
    if (own_.rtl.empty()) return cosim::reference_top(play, fault.number, 1);
    const OwnRtl own = build_own_rtl(own_, kCommand, *play.kind, *play.chip, false, fault.number);
    return [make = own.make] { return make(std::nullopt); };
  }
  /// Wrong settings, and faults that the user's own RTL cannot be told, before the hunt.
  void check(const std::vector<cosim::Fault>& faults, cosim::PlayOptions play) const {
    const std::vector<std::string> set = play.set;
    for (const cosim::Fault& each : faults) {
      play.set = set;
      cosim::set_parameters(play, each.set);
      make_faulty(each, play);
    }
  }

  RtlChip chip_;
  OwnRtlArguments own_;           ///< without a folder: the reference RTL
  std::vector<std::string> set_;  ///< parameters of the model
  std::string list_, directed_;   ///< empty: those of the program's own sources, wherever it is called
  std::string tsv_;               ///< the kill table for other programs; empty: none
  std::uint64_t cycles_ = 30'000'000, seed_ = 1;
  unsigned jobs_ = 0;      ///< threads; 0: as many as there are processors
  bool no_dpram_ = false;  ///< as RTL of the user's own is judged
};

}  // namespace

std::unique_ptr<Command> make_rtl_faults() { return std::make_unique<RtlFaults>(); }

}  // namespace dsdpv1::app
