#pragma once
// --wave and the options that go with it, of run, serve and replay.
#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "apps/options/outputs.hpp"
#include "tb/bench/wave_recorder.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::app {

struct WaveArguments {
  std::string file;                  ///< empty: no wave
  std::vector<std::string> signals;  ///< patterns
  std::string from, to;              ///< times; empty: start and end of the run
  std::vector<std::string> on;       ///< codes
  std::string around = "100us";
  bool wires_only = false, clock = false, inside = false, save = false, date = false;
};

void add_wave_options(CLI::App& command, WaveArguments& arguments);
/// --wave-save alone; `wave`: the option --wave of the command.
CLI::Option* add_wave_save_option(CLI::App& command, bool& save, CLI::Option* wave);

/// The wave and the files that --wave-save writes beside it. Throws tb::InputError, which begins with `command`: they
/// are made of the wave, which can be read again only if it is a regular file.
std::vector<NamedFile> wave_files(const std::string& command, const std::string& wave, bool save);
/// Writes those files, once the wave is complete; throws tb::InputError.
void write_save_files(const std::string& wave, const tb::ChipKinds& kinds);

/// Throws tb::InputError, which begins with `command`, "dsdpv1-sim run".
tb::WaveOptions wave_options(const std::string& command, const WaveArguments& arguments, const tb::ChipKinds& kinds);

/// The time of an option that records `around` before and after an event with this code. Throws tb::InputError.
bus::Tick check_window(const std::string& command, const char* option, const std::string& code,
                       const std::string& around, const tb::ChipKinds& kinds);

/// To be said at the end of a run whose wave shows nothing.
std::string nothing_recorded(const WaveArguments& arguments);

}  // namespace dsdpv1::app
