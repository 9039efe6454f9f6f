#include "lab/traces/xz.hpp"

#include <lzma.h>

#include <algorithm>
#include <stdexcept>

namespace dsdpv1::tb::traces {
namespace {

constexpr std::uint32_t kPreset = 6;
constexpr std::uint64_t kMostMemory = 128U << 20U;  // of the decoder; preset 9 needs 65 MB

const std::uint8_t* bytes_of(std::string_view text) { return reinterpret_cast<const std::uint8_t*>(text.data()); }
std::uint8_t* bytes_of(std::string& text) { return reinterpret_cast<std::uint8_t*>(text.data()); }

std::string words(lzma_ret result) {
  switch (result) {
    case LZMA_FORMAT_ERROR: return "is no .xz file";
    case LZMA_BUF_ERROR: return "is truncated";
    case LZMA_MEMLIMIT_ERROR:
    case LZMA_MEM_ERROR: return "needs too much memory";
    case LZMA_OPTIONS_ERROR: return "is an .xz file of another kind";
    default: return "is damaged";
  }
}

/// liblzma's stream, freed in any case.
class Stream {
 public:
  Stream() = default;
  ~Stream() { lzma_end(&stream_); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  lzma_stream* operator->() { return &stream_; }
  lzma_stream* get() { return &stream_; }

 private:
  lzma_stream stream_ = LZMA_STREAM_INIT;
};

}  // namespace

std::string compress(std::string_view content) {
  std::string file(lzma_stream_buffer_bound(content.size()), '\0');
  std::size_t size = 0;
  const lzma_ret result = lzma_easy_buffer_encode(kPreset, LZMA_CHECK_CRC64, nullptr, bytes_of(content), content.size(),
                                                  bytes_of(file), &size, file.size());
  if (result != LZMA_OK) throw std::runtime_error("liblzma cannot compress a trace");
  file.resize(size);
  return file;
}

Decompressed decompress(std::string_view file, std::size_t most) {
  constexpr std::size_t kPiece = 1U << 20U;
  Stream stream;
  if (lzma_stream_decoder(stream.get(), kMostMemory, 0) != LZMA_OK) return {"", words(LZMA_MEM_ERROR)};
  stream->next_in = bytes_of(file);
  stream->avail_in = file.size();
  Decompressed result;
  lzma_ret state = LZMA_OK;
  while (state == LZMA_OK && stream->total_out <= most) {
    result.content.resize(std::min<std::size_t>(stream->total_out + kPiece, most + 1));
    stream->next_out = bytes_of(result.content) + stream->total_out;
    stream->avail_out = result.content.size() - stream->total_out;
    state = lzma_code(stream.get(), LZMA_FINISH);
  }
  if (stream->total_out > most) return {"", "holds more than is allowed"};
  if (state != LZMA_STREAM_END) return {"", words(state)};
  if (stream->avail_in != 0) return {"", "has something after its end"};
  result.content.resize(stream->total_out);
  return result;
}

}  // namespace dsdpv1::tb::traces
