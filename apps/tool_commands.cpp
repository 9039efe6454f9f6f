// schema, gsd, decode: commands without a simulation.
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "apps/command_line.hpp"
#include "apps/interrupt.hpp"
#include "apps/outputs.hpp"
#include "bus/gsd/report.hpp"
#include "bus/telegram/explain.hpp"
#include "tb/input/input_error.hpp"
#include "tb/input/read_file.hpp"
#include "tb/output/output_file.hpp"
#include "tb/scenario/scenario.hpp"

namespace app {

int schema(const SchemaArguments& arguments) {
  const tb::ChipKind& kind = *tb::chip_kinds().front();
  const std::string text = arguments.markdown ? tb::scenario::markdown(kind) : tb::scenario::json_schema(kind);
  if (arguments.output.empty()) {
    std::cout << text;
    return kPassed;
  }
  leave_nothing_on_signals();
  check_outputs("dsdpv1-sim schema", {}, {{"--output", arguments.output}});
  tb::OutputFile file(arguments.output);
  file.write(text);
  file.commit();
  return kPassed;
}

int gsd(const GsdArguments& arguments) {
  bus::GsdCommand command;
  command.choice.modules = arguments.modules;
  command.format = arguments.json ? bus::GsdFormat::kJson : bus::GsdFormat::kText;
  std::istringstream in(tb::read_file(arguments.file, tb::kGsdFile));
  return bus::gsd_command(in, arguments.file, command, std::cout, std::cerr);
}

int decode(const DecodeArguments& arguments) {
  const bool standard_input = arguments.file.empty() || arguments.file == "-";
  std::ifstream file;
  if (!standard_input) {
    const bool folder = std::filesystem::is_directory(arguments.file);
    file.open(arguments.file);
    if (folder || !file)
      throw tb::InputError(
          arguments.file, 0,
          tb::what_is_wrong(folder ? EISDIR : errno) + ", allowed is a text file of hexadecimal bytes");
  }
  std::string error;
  const int status = bus::decode_text(standard_input ? std::cin : file,
                                      standard_input ? "standard input" : arguments.file, std::cout, error);
  if (!error.empty()) throw tb::InputError(error);
  return status;
}

}  // namespace app
