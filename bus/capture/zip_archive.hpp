#pragma once
// Members of a ZIP archive, unpacked piece by piece.
#include <functional>
#include <memory>
#include <string>

namespace dsdpv1::bus::capture {

class ZipArchive {
 public:
  using TakeBytes = std::function<void(const char* bytes, std::size_t size)>;

  /// `bytes`: the whole archive, which must outlive this. Throws CaptureError.
  explicit ZipArchive(const std::string& bytes);

  /// Returns false if there is no such member. Throws CaptureError for a damaged one, after all of it was passed on.
  bool read(const std::string& member, const TakeBytes& take);

 private:
  struct Close {
    void operator()(void* file) const;
  };
  std::unique_ptr<void, Close> file_;
};

}  // namespace dsdpv1::bus::capture
