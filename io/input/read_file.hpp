#pragma once
// The one reader of whole input files.
#include <cstddef>
#include <string>

namespace dsdpv1::tb {

/// What a file is, as "allowed is ..." goes on, and how much of it is read at most: far beyond every right one, so that
/// a wrong name (/dev/zero, an image of a disk) ends in one line and not in a full memory.
struct FileKind {
  const char* what;
  std::size_t most_mb;
};
constexpr FileKind kScenarioFile{"a scenario in YAML", 4};              // the shipped ones have some 5 KB
constexpr FileKind kGsdFile{"a GSD file", 16};                          // great modular stations have some 2 MB
constexpr FileKind kPinMapFile{"a map of pins in YAML", 1};             // some 20 pins
constexpr FileKind kFaultListFile{"the list of faults of the RTL", 1};  // a line a fault, 255 faults
constexpr FileKind kStimulusFile{"a stimulus file", 16};                // a line an action; cases have some 100 KB
constexpr FileKind kFirmwareFile{// 512 KB of flash with any amount of debug information
                                 "an executable for ARM (32 bit, little endian) such as arm-none-eabi-gcc links", 64};

constexpr FileKind kSavedRunFile{"what run --save-at writes", 128};  // holds the files of the run, firmware too

struct ReadFile {
  std::string text;
  std::string wrong;  ///< empty, or why there is no text: "no such file", "is larger than 4 MB"
};

/// What errno says of a file: "no such file", "is a folder", "cannot be read (Permission denied)".
std::string what_is_wrong(int error);

/// All that is in `path`: a file, a device or a FIFO (`<(...)` of a shell), up to `most_mb` times 2^20 bytes.
ReadFile try_read_file(const std::string& path, std::size_t most_mb);
/// From now on who reads `path`, where there is no such file, gets this text.
void provide_file(const std::string& path, std::string text);
/// The file beside `path`, of the same ending, that was probably meant where `path` is not there; empty when none is
/// near.
std::string nearest_file(const std::string& path);
/// As try_read_file; throws InputError with one line when there is anything wrong.
std::string read_file(const std::string& path, const FileKind& kind);

}  // namespace dsdpv1::tb
