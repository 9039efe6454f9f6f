#pragma once
// Several waves of one run as one file, such as the model's and that of a simulator.
#include <string>
#include <vector>

namespace dsdpv1::tb {

/// A wave of this program, or one of another that counts picoseconds.
struct WavePart {
  std::string file;
  std::string left_out;  ///< this scope at the beginning of its names is not there in the joined wave: "TOP"
  std::string scope;     ///< ... and this one is in its place: "demo.rtl"; empty: none
};

/// Writes `to` (.vcd, .fst). The first part says when the wave begins and ends; what another was before is its value at
/// the beginning. Throws InputError: a part that cannot be read or counts something else than picoseconds, `to` that
/// cannot be written.
void join_waves(const std::vector<WavePart>& parts, const std::string& to);

}  // namespace dsdpv1::tb
