#pragma once
// sweep: a scenario over the product of some of its keys' values.
#include <string>
#include <vector>

#include "apps/options/campaign.hpp"

namespace dsdpv1::app {

struct SweepArguments {
  std::string scenario;
  std::vector<std::string> parameters;  ///< PATH=VALUES
  std::vector<std::string> set;         ///< PATH=VALUE, at every point
  std::string checks;                   ///< of run; empty: what is usual there
  bool strict = false;                  ///< the exit code follows the points
  std::string map;                      ///< the check whose margin the pictures show; empty: the worst
  CampaignArguments campaign;           ///< its folder is sweep_ and the scenario's name, when none is given
};

int sweep(const SweepArguments& arguments);

}  // namespace dsdpv1::app
