// calibrate: what a capture of a real chip's pins says of the rulings and their parameters.
#include <iostream>

#include "apps/commands/capture_file.hpp"
#include "apps/commands/command.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/common.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/rtl_options.hpp"
#include "apps/options/words.hpp"
#include "bus/capture/sample_clock.hpp"
#include "cosim/pin_map.hpp"
#include "io/input/input_error.hpp"
#include "lab/calibrate/calibration.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::app {
namespace {

/// The chip that captures are of.
const tb::ChipKind& kind() { return *tb::chip_kinds().front(); }

/// Names for --signal and for a map of pins.
std::vector<std::string> pin_names() {
  std::vector<std::string> names, buses;
  for (const calibrate::WireInfo& wire : kind().claims()->wires()) {
    names.push_back(wire.name);
    if (!wire.bus.empty() && wire.bit == 0) buses.push_back(wire.bus);
  }
  names.insert(names.end(), buses.begin(), buses.end());
  return names;
}

void take_signal(const std::string& text, calibrate::Names& names) {
  const std::size_t equals = text.find('=');
  const bool inverted = equals != std::string::npos && equals + 1 < text.size() && text[equals + 1] == '!';
  const std::string pin = text.substr(0, equals),
                    signal = equals == std::string::npos ? "" : text.substr(equals + (inverted ? 2 : 1));
  if (signal.empty())
    throw tb::InputError("dsdpv1-sim calibrate: --signal is " + text +
                         ", expected PIN=NAME, or PIN=!NAME for one that is inverted");
  check_word("dsdpv1-sim calibrate: --signal, the pin", pin, pin_names());
  if (!names.given.emplace(pin, calibrate::Names::Given{signal, inverted}).second)
    throw tb::InputError("dsdpv1-sim calibrate: --signal has " + pin + " twice, expected once");
}

/// A map of pins says of what differs from the names of the reference RTL how it is called.
void take_map(const std::string& path, calibrate::Names& names) {
  if (path.empty()) return;
  const cosim::PinMap map = load_map(path, kind()), usual = cosim::default_pin_map(kind().pins());
  for (const auto& [pin, port] : map.pins) {
    const cosim::Port& other = usual.pins.at(pin);
    if (pin == "D_OUT" || pin == "D_OE" || (port.name == other.name && port.inverted == other.inverted)) continue;
    names.given.emplace(pin == "D_IN" ? "D" : pin, calibrate::Names::Given{port.name, port.inverted});
  }
}

class Calibrate : public Command {
 public:
  Calibrate() : Command("calibrate", "Check a capture of a real chip by the rulings and measure its parameters") {}

  void options(CLI::App& app) override {
    constexpr double kMostJitter = 1000, kMostPpm = 20'000;  // ns; 2 %
    constexpr int kMostStation = 126;
    app.add_option(
           "CAPTURE", file_,
           "Logic analyser's session (sigrok), CSV, VCD or FST with any of the chip's pins; the format is detected")
        ->required();
    app.add_option("--signal", signals_,
                   "PIN=NAME: the pin of table 1 (A0 to A10, D0 to D7, or A and D as vectors) is called NAME; "
                   "PIN=!NAME: it is inverted (default: the pin's name)")
        ->allow_extra_args(false);
    app.add_option("--map", map_, "The same as a map of pins (docs/cosim.md)");
    app.add_option("--scope", names_.scope,
                   "Use only signals in this scope of a wave, such as the station in a wave of run");
    app.add_option("--station", station_, "The chip's address (default: the one that is answered)")
        ->check(CLI::Range(0, kMostStation));
    app.add_option("--rate", rate_, "Samples a second, such as 24MHz (default: from the file, or from its changes)");
    app.add_option("--jitter", sampling_.jitter_ns,
                   "Largest error of an edge besides the sampling, including skew between channels, in ns")
        ->check(CLI::Range(0.0, kMostJitter))
        ->capture_default_str();
    app.add_option("--ppm", sampling_.clock_ppm, "Largest difference between the clocks of chip and capture")
        ->check(CLI::Range(0.0, kMostPpm))
        ->capture_default_str();
    app.add_option("--chip", chip_, "Write the parameters as a chip: block for scenarios");
    app.add_option("--json", json_, "The result for programs");
    app.add_option("--table", table_, "Write the output of --all into this file");
    app.add_flag("--all", all_, "Print also the claims that the capture does not show, with reasons");
    add_quiet_option(app, quiet_);
    app.footer(
        "\nExamples:\n"
        "  dsdpv1-sim calibrate board.sr --signal PBRXD=D0 --signal PBTXD=D1 --signal PBRTS=D2\n"
        "  dsdpv1-sim calibrate board.csv --map pins.yaml --jitter 10 --chip chip.yaml --json board.json\n"
        "  dsdpv1-sim calibrate model.fst --scope demo --all\n"
        "docs/calibrate.md explains them.\n"
        "\nExit codes: 0 all is confirmed or not shown, 1 something is contradicted, 2 wrong input, 130 "
        "interrupted.\n");
  }

  int carry_out() override {
    leave_nothing_on_signals();
    check_outputs("dsdpv1-sim calibrate", {{"the capture", file_}, {"--map", map_}},
                  {{"--chip", chip_}, {"--json", json_}, {"--table", table_}});
    for (const std::string& text : signals_) take_signal(text, names_);
    take_map(map_, names_);
    const std::optional<double> rate = given_rate();
    calibrate::RecordTaker taker(kind().claims()->wires(), names_);
    CaptureFile file(file_);
    take_sampling(file.read_levels(taker));
    if (rate) sampling_.rate = rate;
    const calibrate::Result result = calibrate::calibrate(file.name(), taker.record(), sampling_, station_, kind());
    write_wanted(chip_, calibrate::chip_block(result));
    write_wanted(json_, calibrate::json(result));
    {
      const tb::TableWidth as_wide_as_they_need(tb::TableWidth::kUnlimited);
      write_wanted(table_, calibrate::text(result, true));
    }
    if (!quiet_) std::cout << calibrate::text(result, all_);
    return result.agrees() ? kPassed : kFailed;
  }

 private:
  std::optional<double> given_rate() const {
    if (rate_.empty()) return std::nullopt;
    const auto rate = bus::capture::sample_rate(rate_);
    if (rate) return static_cast<double>(*rate);
    throw tb::InputError("dsdpv1-sim calibrate: --rate is " + rate_ +
                         ", expected a number with Hz, kHz, MHz or GHz, like 24MHz");
  }

  void take_sampling(const Sampling& file) {
    sampling_.unit = file.unit;
    if (file.rate) sampling_.rate = static_cast<double>(*file.rate);
  }

  std::string file_, map_;
  std::vector<std::string> signals_;  ///< PIN=NAME, PIN=!NAME
  calibrate::Names names_;            ///< its scope; the others by signals_ and map_
  std::string rate_;                  ///< "24 MHz"; empty: the file's, else found
  calibrate::Sampling sampling_;
  std::optional<int> station_;
  std::string chip_, json_, table_;
  bool all_ = false, quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_calibrate() { return std::make_unique<Calibrate>(); }

}  // namespace dsdpv1::app
