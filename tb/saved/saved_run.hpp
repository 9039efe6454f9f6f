#pragma once
// `run --save-at`: a run at a tick, as what makes it again. A bench has stacks of its own, that of the user CPU's
// driver and that of an emulator, which no file can take along. It is deterministic: the same inputs have the same run.
//
// The file is one line, "DSDPV1 saved run VERSION FINGERPRINT", and a CBOR object (RFC 8949) with the members below;
// the fingerprint is that of the object's bytes.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bus/time.hpp"
#include "tb/chip/user_cpu/debug_history.hpp"

namespace dsdpv1::tb {

struct SavedFile {
  std::string path;  ///< as the program opened it
  std::string content;
};

struct SavedRun {
  static constexpr int kVersion = 2;

  std::string program;                          ///< that has saved it: its version, and what it is made of
  std::string scenario;                         ///< path, as it was given
  std::vector<std::string> settings;            ///< "PATH=VALUE", paths of files absolute
  std::string engine, view, checks;             ///< words of the command line
  unsigned fault = 0;                           ///< of the reference RTL
  std::optional<std::uint32_t> seed;            ///< of the reference RTL
  std::vector<SavedFile> files;                 ///< the scenario first, then those that it names
  std::vector<user_cpu::DebuggerInput> inputs;  ///< of a debugger, up to there
  bus::Tick at = 0;
  std::uint64_t digest = 0;  ///< of all that was before it (Bench)
};

std::string to_bytes(const SavedRun& run);
/// Throws InputError, which names `path`, for what is no such file, one of another version, or a damaged one.
SavedRun parse_saved_run(std::string_view bytes, const std::string& path);

}  // namespace dsdpv1::tb
