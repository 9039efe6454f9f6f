#pragma once
// dsdpv1-sim and dsdpv1-board: the same commands. What one has and the other has not, because of licences that do not
// go together (docs/licences.md), is said by each in a file of its own.
#include <functional>
#include <memory>

#include "tb/bench/execution.hpp"

namespace dsdpv1::app {

/// The main function of both: from the command line to the exit code.
int program(int argc, char** argv);

/// --view tlm: calls `body` with chips as TLM modules inside of a SystemC simulation. Each program defines it; one
/// without SystemC throws InputError.
int in_tlm_view(const std::function<int(std::unique_ptr<tb::Execution>)>& body);

}  // namespace dsdpv1::app
