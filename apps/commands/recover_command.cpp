// recover: a complete wave from what a killed run has left.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iostream>

#include "apps/commands/command.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/outputs.hpp"
#include "io/input/input_error.hpp"
#include "io/waves/recover.hpp"
#include "io/waves/wave_writer.hpp"

namespace dsdpv1::app {
namespace {

/// "wave.fst" for "wave.fst.4711.part".
std::string name_without_part(const std::string& part) {
  const std::size_t ending = part.rfind(".part"), number = part.find_last_not_of("-0123456789", ending - 1);
  const bool ours = ending != std::string::npos && ending + 5 == part.size() && number != std::string::npos &&
                    number + 1 < ending && part[number] == '.' && number != 0;
  if (!ours) throw tb::InputError("dsdpv1-sim recover: " + part + " is not named NAME.PID.part, so --output is needed");
  std::string name = part.substr(0, number);
  if (std::filesystem::exists(name))
    throw tb::InputError("dsdpv1-sim recover: " + name + " is there already, so --output is needed");
  return name;
}

void check_ending(tb::WaveFormat format, const std::string& part, const std::string& output) {
  const std::string ending = format == tb::WaveFormat::kFst ? ".fst" : ".vcd";
  tb::check_wave_name(output);
  if (output.substr(output.size() - ending.size()) != ending)
    throw tb::InputError(output, 0, "has another ending than the wave in " + part + ", expected " + ending);
}

tb::Recovered recover_wave(tb::WaveFormat format, const std::string& part, const std::string& output) {
#ifdef DSDPV1_WITH_FST
  if (format == tb::WaveFormat::kFst) return tb::recover_fst(part, output);
#endif
  if (format == tb::WaveFormat::kFst) throw tb::InputError(part, 0, "is FST, which this program was built without");
  return tb::recover_vcd(part, output);
}

class Recover : public Command {
 public:
  Recover() : Command("recover", "Rebuild a complete wave from the file of a killed run or simulator") {}

  void options(CLI::App& app) override {
    app.add_option(
           "FILE", part_,
           "The wave's temporary file, NAME.PID.part, or another simulator's wave; FST needs FILE.hier beside it")
        ->required();
    app.add_option("--output,-o", output_, "The wave (default: NAME, if it does not exist)");
    app.footer(
        "\nIt says until when the wave is complete. The files that it reads stay.\n"
        "\nExamples:\n  dsdpv1-sim recover out/demo.fst.4711.part\n"
        "  dsdpv1-sim recover demo.vcd.4711.part --output killed.vcd\n"
        "  dsdpv1-sim recover icarus.fst --output good.fst\n"
        "\nExit codes: 0 recovered, 2 wrong input or nothing to recover, 130 interrupted.\n");
  }

  int carry_out() override {
    leave_nothing_on_signals();
    const tb::WaveFormat format = tb::wave_format(part_);
    const std::string output = output_.empty() ? name_without_part(part_) : output_;
    check_ending(format, part_, output);
    check_outputs("dsdpv1-sim recover", {{"what is recovered", part_}, {"what is recovered", part_ + ".hier"}},
                  {{"--output", output}});
    const tb::Recovered until = recover_wave(format, part_, output);
    std::cout << fmt::format("{}: complete until {:.3f} ns\n", output,
                             static_cast<long double>(until.time) * std::pow(10.0L, until.exponent + 9));
    return kPassed;
  }

 private:
  std::string part_, output_;
};

}  // namespace

std::unique_ptr<Command> make_recover() { return std::make_unique<Recover>(); }

}  // namespace dsdpv1::app
