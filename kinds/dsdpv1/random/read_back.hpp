#pragma once
#include <memory>

#include "cosim/random/random_cases.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"

namespace dsdpv1::cosim {

/// RandomCases::read_back, at the port that the straps choose: at the parallel one in a hold of its own, at the others
/// by read telegrams, which need none (SP14).
std::unique_ptr<ReadBack> make_read_back(const tb::Dsdpv1Settings& chip);

}  // namespace dsdpv1::cosim
