#pragma once
// The output of --help: no wider than the terminal, with names, value and text of each option.
#include <CLI/CLI.hpp>

#include <string>

namespace dsdpv1::app {

class Help : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_footer(const CLI::App* app) const override;
};

}  // namespace dsdpv1::app
