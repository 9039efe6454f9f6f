#pragma once
// Rebuilds a complete wave from the partial file of a killed run (NAME.PID.part), or that of another simulator.
#include <cstdint>
#include <string>

namespace dsdpv1::tb {

/// Beginning of the version text in this program's waves.
inline constexpr const char* kWaveAuthor = "dsdpv1-sim ";

enum class WaveFormat { kVcd, kFst };

/// Decides by the file's content; throws InputError when it is neither.
WaveFormat wave_format(const std::string& path);

/// The end of the complete part, in units of 10^exponent seconds.
struct Recovered {
  std::uint64_t time = 0;
  int exponent = -12;
};

/// Writes the readable part of `part` to `output`. Throws InputError.
Recovered recover_vcd(const std::string& part, const std::string& output);
Recovered recover_fst(const std::string& part, const std::string& output);

/// True when a newly written file is a complete FST file, from its first block to its last.
bool fst_is_complete(const std::string& path);

}  // namespace dsdpv1::tb
