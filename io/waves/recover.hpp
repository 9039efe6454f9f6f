#pragma once
// Rebuilds a complete wave from the partial file of a killed run (NAME.PID.part).
#include <cstdint>
#include <string>

namespace dsdpv1::tb {

/// Beginning of the version text in this program's waves.
inline constexpr const char* kWaveAuthor = "dsdpv1-sim ";

enum class WaveFormat { kVcd, kFst };

/// Decides by the file's content; throws InputError when it is not a wave of this program.
WaveFormat wave_format(const std::string& path);

/// Writes the readable part of `part` to `output`; returns the end of the complete part in ps. Throws InputError.
std::uint64_t recover_vcd(const std::string& part, const std::string& output);
std::uint64_t recover_fst(const std::string& part, const std::string& output);

/// True when a newly written file is a complete FST file, from its first block to its last.
bool fst_is_complete(const std::string& path);

}  // namespace dsdpv1::tb
