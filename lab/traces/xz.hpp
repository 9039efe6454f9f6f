#pragma once
// The .xz format, by liblzma.
#include <cstddef>
#include <string>
#include <string_view>

namespace dsdpv1::tb::traces {

std::string compress(std::string_view content);

struct Decompressed {
  std::string content;
  std::string wrong;  ///< empty, or the reason why there is no content: "is no .xz file"
};
/// At most `most` bytes.
Decompressed decompress(std::string_view file, std::size_t most);

}  // namespace dsdpv1::tb::traces
