// schema, gsd: commands without a simulation.
#include <iostream>
#include <sstream>

#include "apps/command_line.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/outputs.hpp"
#include "bus/gsd/report.hpp"
#include "cosim/random/stimulus_result.hpp"
#include "io/input/read_file.hpp"
#include "io/output/write_file.hpp"
#include "tb/report/result_fields.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::app {

namespace {

std::string schema_text(const SchemaArguments& arguments) {
  if (arguments.result) return arguments.markdown ? tb::result_markdown() : tb::result_schema();
  if (arguments.rtl_random)
    return arguments.markdown ? cosim::stimulus_result_table() : cosim::stimulus_result_schema();
  return arguments.markdown ? tb::scenario::markdown(*tb::chip_kinds().front()) : tb::scenario::json_schema();
}

}  // namespace

int schema(const SchemaArguments& arguments) {
  const std::string text = schema_text(arguments);
  if (arguments.output.empty()) {
    std::cout << text;
    return kPassed;
  }
  leave_nothing_on_signals();
  check_outputs("dsdpv1-sim schema", {}, {{"--output", arguments.output}});
  tb::write_file(arguments.output, text);
  return kPassed;
}

int gsd(const GsdArguments& arguments) {
  bus::GsdCommand command;
  command.choice.modules = arguments.modules;
  command.format = arguments.json ? bus::GsdFormat::kJson : bus::GsdFormat::kText;
  std::istringstream in(tb::read_file(arguments.file, tb::kGsdFile));
  return bus::gsd_command(in, arguments.file, command, std::cout, std::cerr);
}

}  // namespace dsdpv1::app
