#pragma once
// What a killed run has left of its wave (NAME.PID.part) becomes a complete wave.
#include <cstdint>
#include <string>

namespace dsdpv1::tb {

/// With what this program's waves begin the text about their version.
inline constexpr const char* kWaveAuthor = "dsdpv1-sim ";

enum class WaveFormat { kVcd, kFst };

/// By the file's content; throws InputError when it is no wave of this program.
WaveFormat wave_format(const std::string& path);

/// Writes all that is readable of `part` to `output`; returns until when it is complete, in ps. Throws InputError.
std::uint64_t recover_vcd(const std::string& part, const std::string& output);
std::uint64_t recover_fst(const std::string& part, const std::string& output);

/// Whether a file that was just written is an FST file from its first block to its last.
bool fst_is_complete(const std::string& path);

}  // namespace dsdpv1::tb
