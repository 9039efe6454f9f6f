#pragma once
#include <memory>

#include "cosim/random/random_cases.hpp"
#include "model/dsdpv1/part.hpp"

namespace dsdpv1::cosim {

/// ChipKind::random() of the part.
std::unique_ptr<const RandomCases> make_random_cases(Part part);

}  // namespace dsdpv1::cosim
