#pragma once
#include <string>
#include <vector>

namespace dsdpv1::tb {

/// The word of `known` that `wrong` was probably meant to be (smallest edit distance), empty when none is near.
std::string nearest(const std::string& wrong, const std::vector<std::string>& known);

/// " (did you mean X?)" or nothing.
std::string did_you_mean(const std::string& wrong, const std::vector<std::string>& known);

/// "a, b, c"
std::string join(const std::vector<std::string>& words);

}  // namespace dsdpv1::tb
