#pragma once
// recover: a complete wave from what a killed run has left.
#include <string>

namespace dsdpv1::app {

struct RecoverArguments {
  std::string part;
  std::string output;  ///< empty: the name that the run would have given
};

int recover(const RecoverArguments& arguments);

}  // namespace dsdpv1::app
