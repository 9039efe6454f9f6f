#pragma once
// The real place of an output: symbolic links are followed, devices and FIFOs are recognised.
#include <sys/stat.h>

#include <optional>
#include <string>

namespace dsdpv1::tb {

struct OutputPlace {
  std::string wanted;                        ///< the user's name
  std::string target;                        ///< after following all links
  int descriptor = -1;                       ///< of this process, when /dev/stdout, /dev/fd/N or the like is wanted
  bool direct = false;                       ///< a device, a FIFO or a descriptor: written to as it is, never replaced
  std::optional<struct stat> replaced = {};  ///< the file that is there already
};

/// Throws InputError when nothing can be written there: a folder, a file without permission, a name that is too long.
OutputPlace find_place(const std::string& path);

/// A text that is the same for two names of one file, existing or not. None for devices, FIFOs, files that cannot be
/// examined, and descriptors (/dev/stdout): several options may name them.
std::optional<std::string> output_identity(const std::string& path);
/// The same for an existing file, by any name (/dev/stdin).
std::optional<std::string> input_identity(const std::string& path);
/// The same for an open descriptor.
std::optional<std::string> file_identity(int descriptor);

/// The folder of a path, "." when it names none; and the rest.
std::string folder_of(const std::string& path);
std::string name_of(const std::string& path);

/// "PATH: cannot be written: reason" for an errno.
[[noreturn]] void refuse_output(const std::string& path, int error);

}  // namespace dsdpv1::tb
