#pragma once
// Runs the chips as TLM modules inside a SystemC simulation.
#include <functional>
#include <memory>

#include "tb/bench/execution.hpp"

namespace dsdpv1::tb {

/// Only inside sc_main, once per process.
std::unique_ptr<Execution> make_tlm_execution();

/// Calls `body` from its own sc_main and returns its result. Exceptions of `body` pass through. For programs that have
/// their own main.
int inside_systemc(const std::function<int()>& body);

}  // namespace dsdpv1::tb
