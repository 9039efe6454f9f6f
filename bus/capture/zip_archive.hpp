#pragma once
// Members of a ZIP archive, unpacked piece by piece.
#include <functional>
#include <memory>
#include <string>

namespace dsdpv1::bus::capture {

class ZipArchive {
 public:
  using TakeBytes = std::function<void(const char* bytes, std::size_t size)>;

  /// `bytes`: all of the archive, which must outlive this. Throws CaptureError.
  explicit ZipArchive(const std::string& bytes);

  /// False when there is no such member. Throws CaptureError for one that is damaged, when all of it has been given.
  bool read(const std::string& member, const TakeBytes& take);

 private:
  struct Close {
    void operator()(void* file) const;
  };
  std::unique_ptr<void, Close> file_;
};

}  // namespace dsdpv1::bus::capture
