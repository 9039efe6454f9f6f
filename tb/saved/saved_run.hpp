#pragma once
// `run --save-at`: a run at a tick, saved as the inputs that reproduce it. A bench has separate stacks, for the user
// CPU's driver and for an emulator, which no file can contain. It is deterministic: the same inputs give the same run.
//
// The file is one line, "DSDPV1 saved run VERSION FINGERPRINT", and a CBOR object (RFC 8949) with the members below;
// the fingerprint covers the object's bytes.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bus/time.hpp"
#include "tb/chip/user_cpu/debug_history.hpp"

namespace dsdpv1::tb {

struct SavedFile {
  std::string path;  ///< as opened by the program
  std::string content;
};

struct SavedRun {
  static constexpr int kVersion = 2;

  std::string program;                          ///< the program that saved it: its version, and a digest of its parts
  std::string scenario;                         ///< path, as given
  std::vector<std::string> settings;            ///< "PATH=VALUE", paths of files absolute
  std::string engine, view, checks;             ///< words from the command line
  unsigned fault = 0;                           ///< of the reference RTL
  std::optional<std::uint32_t> seed;            ///< of the reference RTL
  std::vector<SavedFile> files;                 ///< the scenario first, then the files that it names
  std::vector<user_cpu::DebuggerInput> inputs;  ///< of a debugger, up to that tick
  bus::Tick at = 0;
  std::uint64_t digest = 0;  ///< of everything before the tick (Bench)
};

std::string to_bytes(const SavedRun& run);
/// Throws InputError, with `path`, for another kind of file, another version, or a damaged one.
SavedRun parse_saved_run(std::string_view bytes, const std::string& path);

}  // namespace dsdpv1::tb
