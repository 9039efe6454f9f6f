#pragma once
#include <zlib.h>

#include <string>

namespace dsdpv1 {

/// As gzip does it.
inline std::string packed(const std::string& text) {
  z_stream stream{};
  ::deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::string gz(text.size() + 1000, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(gz.data());
  stream.avail_out = static_cast<uInt>(gz.size());
  ::deflate(&stream, Z_FINISH);
  gz.resize(stream.total_out);
  ::deflateEnd(&stream);
  return gz;
}

}  // namespace dsdpv1
