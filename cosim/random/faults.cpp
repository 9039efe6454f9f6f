#include "cosim/random/faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <numeric>
#include <sstream>
#include <utility>

#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"

namespace dsdpv1::cosim {
namespace {

namespace fs = std::filesystem;

/// Plays until the fault shows.
class Hunt {
 public:
  Hunt(const Fault& fault, const CampaignOptions& options, const MakeFaulty& make)
      : kill_{fault, false, "", 0, 0, ""}, options_(options) {
    set_parameters(options_.play, fault.set);
    make_ = make(fault, options_.play);
  }

  bool directed(const NamedStimulus& stimulus) {
    const PlayResult result = play(stimulus.stimulus, make_, options_.play);
    return note(stimulus.name, result.counts, result.difference);
  }
  void random() {
    CampaignOptions options = options_;
    options.jobs = 1;
    const CampaignResult result = run_campaign(options, make_);
    note(fmt::format("random case {}", result.cases), result.counts, result.difference);
  }
  Kill end() {
    kill_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    return std::move(kill_);
  }

 private:
  bool note(const std::string& name, const MatchCounts& counts, const std::optional<Difference>& difference) {
    kill_.cycles += counts.cycles;
    if (!difference) return false;
    kill_.found = true;
    kill_.stimulus = name;
    kill_.what = difference->what;
    return true;
  }

  Kill kill_;
  CampaignOptions options_;
  MakeTop make_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Total waiting time of all lanes.
Tick waits(const Stimulus& stimulus) {
  return std::accumulate(
      stimulus.begin(), stimulus.end(), Tick{0}, [](Tick sum, const Action& action) { return sum + action.delay; });
}

}  // namespace

std::vector<Fault> read_faults(const std::string& path) {
  std::istringstream file(tb::read_file(path, tb::kFaultListFile));
  std::vector<Fault> faults;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    Fault fault;
    std::string played;
    if (!(words >> fault.number >> fault.block >> played) || !std::getline(words >> std::ws, fault.text))
      throw tb::InputError(path, number, "is no fault, expected: number, block, stimulus, what is wrong");
    std::istringstream parts(played);
    std::getline(parts, fault.stimulus, ',');
    for (std::string each; std::getline(parts, each, ',');) fault.set.push_back(each);
    faults.push_back(std::move(fault));
  }
  return faults;
}

std::vector<NamedStimulus> read_stimuli(const std::string& folder, const tb::ChipKind& kind) {
  std::vector<NamedStimulus> stimuli;
  if (!fs::is_directory(folder)) throw tb::InputError(folder, 0, "is no folder, expected one with stimulus files");
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".stimulus") continue;
    const std::string text = tb::read_file(entry.path().string(), tb::kStimulusFile);
    stimuli.push_back({entry.path().stem().string(), parse_stimulus(text, entry.path().string(), kind)});
  }
  std::sort(stimuli.begin(), stimuli.end(), [](const auto& a, const auto& b) {
    return std::pair(waits(a.stimulus), a.name) < std::pair(waits(b.stimulus), b.name);
  });
  return stimuli;
}

Kill hunt(const Fault& fault, const std::vector<NamedStimulus>& directed, const CampaignOptions& options,
          const MakeFaulty& make) {
  Hunt hunt(fault, options, make);
  for (const bool named : {true, false})
    for (const NamedStimulus& each : directed)
      if ((each.name == fault.stimulus) == named && hunt.directed(each)) return hunt.end();
  hunt.random();
  return hunt.end();
}

std::vector<Kill> hunt_all(const std::vector<Fault>& faults, const std::vector<NamedStimulus>& directed,
                           const CampaignOptions& options, const MakeFaulty& make,
                           const std::function<void(const Kill&)>& found) {
  std::mutex mutex;
  std::vector<std::optional<Kill>> kills(faults.size());
  std::size_t begun = 0, told = 0;
  in_parallel(options.jobs, [&] {
    std::size_t number = 0;
    {
      const std::scoped_lock lock(mutex);
      if (begun == faults.size()) return false;
      number = begun++;
    }
    Kill kill = hunt(faults[number], directed, options, make);
    const std::scoped_lock lock(mutex);
    kills[number] = std::move(kill);
    for (; told < kills.size() && kills[told]; ++told) found(*kills[told]);
    return true;
  });
  std::vector<Kill> result;
  result.reserve(kills.size());
  for (std::optional<Kill>& each : kills) result.push_back(std::move(*each));
  return result;
}

std::string heading() {
  return fmt::format("{:>3}  {:<5}  {:<16} {:<64} {:>9} {:>8}  {}\n", "no", "", "block", "fault", "cycles", "seconds",
                     "found by");
}

std::string line_of(const Kill& kill) {
  return fmt::format("{:>3}  {:<5}  {:<16} {:<64} {:>9} {:>8.2f}  {}\n", kill.fault.number,
                     kill.found ? "found" : "ALIVE", kill.fault.block, kill.fault.text, kill.cycles, kill.seconds,
                     kill.found ? fmt::format("{}: {}", kill.stimulus, kill.what) : "");
}

std::string to_tsv(const std::vector<Kill>& kills) {
  std::string text = "number\tblock\tfault\tfound\tcycles\tseconds\tstimulus\tdifference\n";
  for (const Kill& kill : kills)
    text += fmt::format("{}\t{}\t{}\t{}\t{}\t{:.3f}\t{}\t{}\n", kill.fault.number, kill.fault.block, kill.fault.text,
                        kill.found ? "yes" : "no", kill.cycles, kill.seconds, kill.stimulus, kill.what);
  return text;
}

}  // namespace dsdpv1::cosim
