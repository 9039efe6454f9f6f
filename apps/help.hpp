#pragma once
// What --help prints: no wider than the terminal, of each option its names, what its value is, and its text.
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
