#pragma once
// Many judged runs in child processes or on a cluster, then tables and page: of regress, and of verify-rtl.
#include <CLI/CLI.hpp>

#include <string>

#include "apps/options/campaign.hpp"
#include "apps/options/rtl_options.hpp"
#include "lab/regress/folder.hpp"

namespace dsdpv1::app {

struct RegressionArguments {
  std::string command = "dsdpv1-sim regress";  ///< for messages
  double time_limit = 600;                     ///< seconds for a run; 0: none
  std::string junit;                           ///< file; empty: none
  bool json = false;                           ///< the table as JSON
  bool strict = false;                         ///< a run that is only listed counts as one that judged nothing
  CampaignArguments campaign;                  ///< its words are those of the command line, its folder is named
};
/// Time limit, tables and campaign; `usual_folder`: in words, where --out is left out.
void add_regression_options(CLI::App& app, RegressionArguments& arguments, const std::string& usual_folder);

/// --coverage, which needs --rtl.
void add_coverage_flag(CLI::App& app, tb::regress::Description& description);

/// RTL of the user's own with the pins of the kind `chip`; its files and facts are known when it is built.
tb::regress::OwnRtl rtl_of_regression(const OwnRtlArguments& arguments, const std::string& chip);

/// Builds the RTL of its own, if there is one. Carries out the runs without a result in the folder, and writes the
/// report. `failed`: instead those that did not pass; what is known of the others counts. Returns the exit code; throws
/// tb::InputError.
int run_regression(tb::regress::Description description, const RegressionArguments& arguments, bool failed = false);

}  // namespace dsdpv1::app
