#include "apps/options/wave_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>

#include "apps/options/words.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "io/output/output_place.hpp"
#include "io/waves/save_files.hpp"
#include "tb/scenario/event_codes.hpp"

namespace dsdpv1::app {
namespace {

/// "2026-11-24 13:15:08 UTC".
std::string now() {
  const std::time_t time = std::time(nullptr);
  std::array<char, 64> text{};
  std::tm utc{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S UTC", gmtime_r(&time, &utc));
  return text.data();
}

void check_code(const std::string& command, const char* option, const std::string& code, const tb::ChipKinds& kinds) {
  std::vector<std::string> allowed = {tb::kAnyViolation};
  for (const tb::ChipKind* kind : kinds) {
    const std::vector<std::string>& codes = tb::scenario::all_codes(*kind);
    allowed.insert(allowed.end(), codes.begin(), codes.end());
  }
  if (std::find(allowed.begin(), allowed.end(), code) != allowed.end()) return;
  throw tb::InputError(fmt::format("{}: {} is {}{}, expected {} and the codes of dsdpv1-sim reasons", command, option,
                                   code, tb::did_you_mean(code, allowed), tb::kAnyViolation));
}

}  // namespace

void add_wave_options(CLI::App& command, WaveArguments& arguments) {
  CLI::Option* wave = command.add_option("--wave", arguments.file,
                                         "Write waves of all pins, the line, states and events: FILE.vcd or FILE.fst");
  command
      .add_option("--wave-signals", arguments.signals,
                  "Write only matching signals: patterns of \"station.signal\" with * and ?, once for each")
      ->allow_extra_args(false)
      ->needs(wave);
  CLI::Option* from = command.add_option("--wave-from", arguments.from, "Only from this time on")->needs(wave);
  CLI::Option* to = command.add_option("--wave-to", arguments.to, "Only up to this time")->needs(wave);
  CLI::Option* on =
      command
          .add_option("--wave-on", arguments.on,
                      "Write only around each event with this code of the log, or each violation; once for each")
          ->allow_extra_args(false)
          ->needs(wave)
          ->excludes(from)
          ->excludes(to);
  command.add_option("--wave-around", arguments.around, "Length of the part before and after it")
      ->capture_default_str()
      ->needs(on);
  CLI::Option* wires =
      command
          .add_flag("--wave-wires", arguments.wires_only,
                    "Write no words, and each wire of a bus as a separate signal: for sigrok and PulseView")
          ->needs(wave);
  command.add_flag("--wave-clk", arguments.clock, "Write also CLK, which changes 96 times a microsecond")->needs(wave);
  command
      .add_flag("--wave-inside", arguments.inside,
                "Write also inner signals of the chips: owner of the DPRAM, item and byte that is moved, flags, CRC "
                "verdicts, baud and watchdog states; every cycle is then evaluated")
      ->needs(wave);
  add_wave_save_option(command, arguments.save, wave)->excludes(wires);
  command
      .add_flag("--wave-date", arguments.date,
                "Write date and time of day; without it the same run writes the same bytes")
      ->needs(wave);
}

CLI::Option* add_wave_save_option(CLI::App& command, bool& save, CLI::Option* wave) {
  return command
      .add_flag("--wave-save", save,
                "Write also NAME.gtkw for GTKWave and NAME.sucl for Surfer: the wave's signals in groups and in order")
      ->needs(wave);
}

std::vector<NamedFile> wave_files(const std::string& command, const std::string& wave, bool save) {
  std::vector<NamedFile> files = {{"--wave", wave}};
  if (!save) return files;
  if (tb::find_place(wave).direct)
    throw tb::InputError(command + ": --wave-save reads the wave, --wave needs a regular file, not " + wave);
  const tb::SaveFiles beside = tb::save_files_of(wave);
  files.push_back({"the save file for GTKWave", beside.gtkwave});
  files.push_back({"the command file for Surfer", beside.surfer});
  return files;
}

/// Kinds that share a group share its pins: the largest has all of them.
void write_save_files(const std::string& wave, const tb::ChipKinds& kinds) {
  std::vector<tb::SignalGroup> groups;
  for (const tb::ChipKind* kind : kinds) {
    for (const tb::PinGroup& each : kind->pin_groups()) {
      const tb::SignalGroup group = {each.title, {each.pins.begin(), each.pins.end()}};
      const auto same = std::find_if(groups.begin(), groups.end(),
                                     [&group](const tb::SignalGroup& other) { return other.title == group.title; });
      if (same == groups.end())
        groups.push_back(group);
      else if (same->signals.size() < group.signals.size())
        *same = group;
    }
  }
  tb::write_save_files(wave, groups);
}

tb::WaveOptions wave_options(const std::string& command, const WaveArguments& arguments, const tb::ChipKinds& kinds) {
  if (!arguments.file.empty()) tb::check_wave_name(arguments.file);
  tb::WaveOptions options;
  options.path = arguments.file;
  options.on = arguments.on;
  options.inside = arguments.inside;
  if (arguments.date) options.date = now();
  options.selection.signals = arguments.signals;
  options.selection.wires_only = arguments.wires_only;
  options.selection.clock = arguments.clock;
  options.selection.around = time_of(command + ": --wave-around", arguments.around);
  if (!arguments.from.empty()) options.selection.from = time_of(command + ": --wave-from", arguments.from);
  if (!arguments.to.empty()) options.selection.to = time_of(command + ": --wave-to", arguments.to);
  if (options.selection.to < options.selection.from)
    throw tb::InputError(fmt::format("{}: --wave-to is {}, expected a time not before --wave-from, {}", command,
                                     arguments.to, arguments.from));
  for (const std::string& code : arguments.on) check_code(command, "--wave-on", code, kinds);
  return options;
}

bus::Tick check_window(const std::string& command, const char* option, const std::string& code,
                       const std::string& around, const tb::ChipKinds& kinds) {
  check_code(command, option, code, kinds);
  return time_of(command + ": " + option, around);
}

std::string nothing_recorded(const WaveArguments& arguments) {
  const std::string why = arguments.on.empty() ? fmt::format("the run was over before {}", arguments.from)
                                               : fmt::format("nothing of {} happened", tb::join(arguments.on));
  return fmt::format("dsdpv1-sim: {} shows nothing: {}", arguments.file, why);
}

}  // namespace dsdpv1::app
