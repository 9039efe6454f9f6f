#include "apps/commands/calibrate_command.hpp"

#include <iostream>

#include "apps/command_line.hpp"
#include "apps/commands/capture_file.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/outputs.hpp"
#include "bus/capture/sample_clock.hpp"
#include "cosim/pin_map.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "lab/calibrate/calibration.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::app {
namespace {

/// Of --signal, and of a map of pins.
std::vector<std::string> pin_names() {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < calibrate::kWireCount; ++i)
    names.push_back(calibrate::name(static_cast<calibrate::Wire>(i)));
  names.emplace_back("A");
  names.emplace_back("D");
  return names;
}

void take_signal(const std::string& text, calibrate::Names& names) {
  const std::size_t equals = text.find('=');
  const bool inverted = equals != std::string::npos && equals + 1 < text.size() && text[equals + 1] == '!';
  const std::string pin = text.substr(0, equals),
                    signal = equals == std::string::npos ? "" : text.substr(equals + (inverted ? 2 : 1));
  if (signal.empty())
    throw tb::InputError("dsdpv1-sim calibrate: --signal is " + text +
                         ", allowed is PIN=NAME, or PIN=!NAME for one that is inverted");
  check_word("calibrate: --signal, the pin", pin, pin_names());
  if (!names.given.emplace(pin, calibrate::Names::Given{signal, inverted}).second)
    throw tb::InputError("dsdpv1-sim calibrate: --signal has " + pin + " twice, allowed is once");
}

/// A map of pins says of what differs from the names of the reference RTL how it is called.
void take_map(const std::string& path, calibrate::Names& names) {
  if (path.empty()) return;
  const cosim::PinMap map = cosim::load_pin_map(path), usual = cosim::default_pin_map();
  for (const auto& [pin, port] : map.pins) {
    const cosim::Port& other = usual.pins.at(pin);
    if (pin == "D_OUT" || pin == "D_OE" || (port.name == other.name && port.inverted == other.inverted)) continue;
    names.given.emplace(pin == "D_IN" ? "D" : pin, calibrate::Names::Given{port.name, port.inverted});
  }
}

calibrate::Names names_of(const CalibrateArguments& arguments) {
  calibrate::Names names;
  names.scope = arguments.scope;
  for (const std::string& text : arguments.signals) take_signal(text, names);
  take_map(arguments.map, names);
  return names;
}

calibrate::Sampling sampling_of(const CalibrateArguments& arguments, const Sampling& file) {
  calibrate::Sampling sampling;
  sampling.unit = file.unit;
  sampling.jitter_ns = arguments.jitter_ns;
  sampling.clock_ppm = arguments.clock_ppm;
  if (file.rate) sampling.rate = static_cast<double>(*file.rate);
  if (arguments.rate.empty()) return sampling;
  const auto rate = bus::capture::sample_rate(arguments.rate);
  if (!rate)
    throw tb::InputError("dsdpv1-sim calibrate: --rate is " + arguments.rate +
                         ", allowed is a number with Hz, kHz, MHz or GHz, like 24MHz");
  sampling.rate = static_cast<double>(*rate);
  return sampling;
}

}  // namespace

int calibrate(const CalibrateArguments& arguments) {
  leave_nothing_on_signals();
  check_outputs("dsdpv1-sim calibrate", {{"the capture", arguments.file}, {"--map", arguments.map}},
                {{"--chip", arguments.chip}, {"--json", arguments.json}, {"--table", arguments.table}});
  calibrate::RecordTaker taker(names_of(arguments));
  sampling_of(arguments, {});  // what is wrong with it is said before the capture is read
  CaptureFile file(arguments.file);
  const Sampling sampling = file.read_levels(taker);
  const calibrate::Result result =
      calibrate::calibrate(file.name(), taker.record(), sampling_of(arguments, sampling), arguments.station);
  write_wanted(arguments.chip, calibrate::chip_block(result));
  write_wanted(arguments.json, calibrate::json(result));
  {
    const tb::TableWidth as_wide_as_they_need(tb::TableWidth::kUnlimited);
    write_wanted(arguments.table, calibrate::text(result, true));
  }
  if (!arguments.quiet) std::cout << calibrate::text(result, arguments.all);
  return result.agrees() ? kPassed : kFailed;
}

}  // namespace dsdpv1::app
