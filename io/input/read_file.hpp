#pragma once
// The one reader of whole input files.
#include <cstddef>
#include <string>

namespace dsdpv1::tb {

/// The kind of a file, for the error's "expected ...", and its largest size in MB. The limit is far beyond every
/// right file, so that a wrong name (/dev/zero, an image of a disk) gives one line and does not fill the memory.
struct FileKind {
  const char* what;
  std::size_t most_mb;
};
constexpr FileKind kScenarioFile{"a scenario in YAML", 4};              // the shipped ones have some 5 KB
constexpr FileKind kGsdFile{"a GSD file", 16};                          // great modular stations have some 2 MB
constexpr FileKind kPinMapFile{"a map of pins in YAML", 1};             // some 20 pins
constexpr FileKind kFaultListFile{"the list of faults of the RTL", 1};  // a line per fault, 255 faults
constexpr FileKind kStimulusFile{"a stimulus file", 16};                // a line per action; cases have some 100 KB
constexpr FileKind kFirmwareFile{// 512 KB of flash with any amount of debug information
                                 "an executable for ARM (32 bit, little endian) such as arm-none-eabi-gcc links", 64};

constexpr FileKind kSavedRunFile{"what run --save-at writes", 128};  // holds the files of the run, firmware too

struct ReadFile {
  std::string text;
  std::string wrong;  ///< empty, or the reason why there is no text: "no such file", "is larger than 4 MB"
};

/// The meaning of errno for a file: "no such file", "is a folder", "cannot be read (Permission denied)".
std::string what_is_wrong(int error);

/// All that is in `path`: a file, a device or a FIFO (`<(...)` of a shell), up to `most_mb` times 2^20 bytes.
ReadFile try_read_file(const std::string& path, std::size_t most_mb);
/// From now on readers of `path` get this text if it does not exist.
void provide_file(const std::string& path, std::string text);
/// The file beside `path`, with the same ending or the same name before it, that was probably meant if `path` does not
/// exist; empty when none is near.
std::string nearest_file(const std::string& path);
/// Like try_read_file, but throws InputError with one line.
std::string read_file(const std::string& path, const FileKind& kind);

}  // namespace dsdpv1::tb
