#pragma once
// regress: scenarios by engines, views, seeds and settings, each with a verdict.
#include <string>
#include <vector>

#include "apps/options/campaign.hpp"

namespace dsdpv1::app {

struct RegressArguments {
  std::vector<std::string> scenarios;       ///< files and folders; none: scenarios
  std::vector<std::string> engines, views;  ///< none: skip, pins
  std::string seeds;                        ///< a range; empty: the usual one
  std::vector<std::string> set;             ///< PATH=VALUES
  std::string checks, wave, keep, shard;    ///< empty: as run does, none, failed, all of it
  std::string junit;                        ///< file; empty: none
  double time_limit = 600;                  ///< seconds for a run; 0: none
  bool report = false;                      ///< each run writes run --report
  bool failed = false;                      ///< what has not passed the last time
  bool json = false;                        ///< the table as JSON
  CampaignArguments campaign;               ///< its folder is regression, when none is given
};

int regress(const RegressArguments& arguments);

}  // namespace dsdpv1::app
