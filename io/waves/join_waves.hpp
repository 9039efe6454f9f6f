#pragma once
// Several waves of one run as one file, such as the model's and that of a simulator.
#include <string>
#include <vector>

namespace dsdpv1::tb {

/// A wave of this program, or one of another that counts picoseconds.
struct WavePart {
  std::string file;
  std::string left_out;  ///< this scope at the beginning of its names is dropped in the joined wave: "TOP"
  std::string scope;     ///< ... and replaced by this one: "demo.rtl"; empty: none
};

/// Writes `to` (.vcd, .fst). The first part sets the begin and end of the wave; another part's earlier value is its
/// value at the beginning. Throws InputError for a part that cannot be read or does not count picoseconds, and when
/// `to` cannot be written.
void join_waves(const std::vector<WavePart>& parts, const std::string& to);

}  // namespace dsdpv1::tb
