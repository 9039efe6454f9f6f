// schema: what scenarios and results may hold, for editors, programs and docs/.
#include "apps/commands/command.hpp"
#include "apps/options/outputs.hpp"
#include "cosim/random/stimulus_result.hpp"
#include "tb/report/result_fields.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::app {
namespace {

class Schema : public Command {
 public:
  Schema() : Command("schema", "Print the JSON Schema of a scenario, or of a result") {}

  void options(CLI::App& app) override {
    CLI::Option* result = app.add_flag("--result", result_, "Print the schema of run's result files instead");
    app.add_flag("--rtl-random", rtl_random_, "Print the schema of rtl-random's result files instead")
        ->excludes(result);
    app.add_flag("--markdown", markdown_,
                 "Print docs/scenarios.md, docs/result.md, or the table of docs/cosim.md instead");
    app.add_option("--output,-o", output_, "Write into this file");
    app.footer(
        "\nExamples:\n  dsdpv1-sim schema > scenario.schema.json\n  dsdpv1-sim schema --result > result.schema.json\n"
        "  and in the first line of a scenario, for editors with the YAML language server:\n"
        "  # yaml-language-server: $schema=scenario.schema.json\n");
  }

  int carry_out() override { return print_or_write("dsdpv1-sim schema", text(), output_); }

 private:
  std::string text() const {
    if (result_) return markdown_ ? tb::result_markdown() : tb::result_schema();
    if (rtl_random_) return markdown_ ? cosim::stimulus_result_table() : cosim::stimulus_result_schema();
    return markdown_ ? tb::scenario::markdown(*tb::chip_kinds().front()) : tb::scenario::json_schema();
  }

  bool markdown_ = false, result_ = false, rtl_random_ = false;
  std::string output_;
};

}  // namespace

std::unique_ptr<Command> make_schema() { return std::make_unique<Schema>(); }

}  // namespace dsdpv1::app
