#pragma once
// --wave and the options that go with it, of run and serve.
#include <string>
#include <vector>

#include "tb/bench/wave_recorder.hpp"
#include "tb/chip/chip_kind.hpp"

namespace CLI {
class App;
}

namespace app {

struct WaveArguments {
  std::string file;                  ///< empty: no wave
  std::vector<std::string> signals;  ///< patterns
  std::string from, to;              ///< times; empty: start and end of the run
  std::vector<std::string> on;       ///< codes
  std::string around = "100us";
  bool wires_only = false, clock = false, inside = false;
};

void add_wave_options(CLI::App& command, WaveArguments& arguments);

/// Throws tb::InputError, which begins with `command`, "dsdpv1-sim run".
tb::WaveOptions wave_options(const std::string& command, const WaveArguments& arguments, const tb::ChipKind& kind);

/// To be said at the end of a run whose wave shows nothing.
std::string nothing_recorded(const WaveArguments& arguments);

}  // namespace app
