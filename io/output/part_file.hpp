#pragma once
// The temporary file of an output: beside its place, so that renaming is atomic, under a name that is unique to this
// run.
#include <memory>
#include <string>

#include "io/output/output_place.hpp"

namespace dsdpv1::tb {

/// A name that a signal's handler removes, see remove_parts.
class NameToRemove {
 public:
  explicit NameToRemove(std::string name);
  ~NameToRemove();
  NameToRemove(const NameToRemove&) = delete;
  NameToRemove& operator=(const NameToRemove&) = delete;
  const std::string& text() const { return name_; }

 private:
  std::string name_;
  int slot_ = -1;
};

/// Removes all temporary files of this process; for handlers of signals (async-signal-safe).
void remove_parts() noexcept;

class PartFile {
 public:
  static constexpr const char* kEnding = ".part";
  /// Room for the ending that FST's second file adds to the temporary name.
  static constexpr std::size_t kRoom = 5;

  /// Creates `NAME.PID.part`, or opens the device or FIFO itself; throws InputError.
  explicit PartFile(const std::string& path);
  /// Removes a file that was not placed.
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// The open file, once; the caller closes it.
  int take_descriptor();
  /// Gives the complete file its name; throws InputError.
  void place();

  const std::string& path() const { return place_.wanted; }
  /// The path of the growing file.
  const std::string& part() const { return part_->text(); }
  /// A device, a FIFO or a descriptor of this process, without a temporary file.
  bool direct() const { return place_.direct; }

 private:
  OutputPlace place_;
  int descriptor_ = -1;
  bool placed_ = false;
  std::unique_ptr<NameToRemove> part_;
};

}  // namespace dsdpv1::tb
