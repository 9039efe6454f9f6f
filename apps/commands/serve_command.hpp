#pragma once
// serve: the simulated segment goes on in the real world.
#include <string>
#include <vector>

#include "apps/options/wave_options.hpp"

namespace dsdpv1::app {

struct ServeArguments {
  std::string scenario;
  std::string link;  ///< of the pseudo-terminal; empty: none
  int tcp = -1;      ///< port; 0: any free one; -1: no TCP
  std::string bind = "127.0.0.1";
  int turn = 10;  ///< s; 0: a host keeps the TCP port
  std::string serial;
  bool rts = false;
  std::string baud;      ///< empty: that of the scenario
  std::string duration;  ///< empty: until interrupted
  WaveArguments wave;
  std::string log, result, report, junit;
  std::string checks;            ///< as of RunArguments
  std::vector<std::string> set;  ///< likewise
  std::string capture, capture_link = "profibus";
  bool log_whole = false, quiet = false;
};

int serve(const ServeArguments& arguments);

}  // namespace dsdpv1::app
