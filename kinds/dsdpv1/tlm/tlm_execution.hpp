#pragma once
// Runs the chips as TLM modules inside a SystemC simulation.
#include <functional>
#include <memory>

#include "tb/bench/execution.hpp"

namespace dsdpv1::tb {

/// Only inside of sc_main, once a process.
std::unique_ptr<Execution> make_tlm_execution();

/// Calls `body` from an sc_main of its own and returns what it returned. Exceptions of `body` come through. For
/// programs with a main of their own.
int inside_systemc(const std::function<int()>& body);

}  // namespace dsdpv1::tb
