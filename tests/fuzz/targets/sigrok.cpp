// A session of sigrok. After a first byte 0 comes the archive itself; else its metadata up to a byte 0 and its samples,
// which are packed into a valid archive, so that inputs pass the checksums.
#include "bus/capture/sigrok_reader.hpp"

#include <zlib.h>

#include "bus/baud.hpp"
#include "tests/fuzz/captured.hpp"

namespace dsdpv1 {
namespace {

/// A ZIP archive of stored members.
class Archive {
 public:
  void add(const std::string& name, const std::string& bytes) {
    const std::string described = description(name, bytes);
    directory_ += "PK\x01\x02" + word(20, 2) + described + word(0, 2) + word(0, 2) + word(0, 2) + word(0, 4) +
                  word(archive_.size(), 4) + name;
    archive_ += "PK\x03\x04" + described + name + bytes;
    ++count_;
  }
  std::string bytes() const {
    return archive_ + directory_ + "PK\x05\x06" + word(0, 4) + word(count_, 2) + word(count_, 2) +
           word(directory_.size(), 4) + word(archive_.size(), 4) + word(0, 2);
  }

 private:
  static std::string word(std::size_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFF);
    return text;
  }
  /// From the version that is needed to the length of the extra field.
  static std::string description(const std::string& name, const std::string& bytes) {
    const auto crc = ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size()));
    return word(20, 2) + word(0, 2) + word(0, 2) + word(0, 4) + word(crc, 4) + word(bytes.size(), 4) +
           word(bytes.size(), 4) + word(name.size(), 2) + word(0, 2);
  }

  std::string archive_, directory_;
  std::size_t count_ = 0;
};

std::string archive_of(fuzz::Input input) {
  if (input.byte() == 0) return input.rest();
  const std::string rest = input.rest();
  const std::size_t end = std::min(rest.find('\0'), rest.size());
  Archive archive;
  archive.add("version", "2");
  archive.add("metadata", rest.substr(0, end));
  archive.add("logic-1-1", end < rest.size() ? rest.substr(end + 1) : "");
  return archive.bytes();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string archive = archive_of({data, size});
  fuzz::read_capture([&] { bus::capture::read_sigrok(archive, {}, fuzz::take); });
  return 0;
}

}  // namespace dsdpv1
