#include "io/waves/wave_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#ifdef DSDPV1_WITH_FST
#include <zlib.h>
#endif

namespace dsdpv1::tb {
namespace {

constexpr std::size_t kPiece = std::size_t{64} << 10U;
constexpr std::string_view kGz = "\x1f\x8b";

struct ForeignForm {
  std::string_view beginning;
  const char* what;
};

constexpr ForeignForm kForeignForms[] = {
    {"GHDLwave", "is GHW of GHDL, expected VCD or FST, as ghdl -r TOP --fst=FILE writes it"},
    {"\x13\x80", "is LXT2, expected VCD or FST: lxt2vcd of GTKWave makes a VCD of it"},
    {"\x01\x38", "is LXT, expected VCD or FST"},
    {"VZ", "is VZT, expected VCD or FST: vzt2vcd of GTKWave makes a VCD of it"},
    {"PK\x03\x04",
     "is an archive, perhaps a session of sigrok, expected VCD or FST: sigrok-cli -i FILE -O vcd makes a "
     "VCD of a session"},
};

}  // namespace

#ifdef DSDPV1_WITH_FST
struct WaveBytes::Unpacker {
  Unpacker() { ::inflateInit2(&stream, 15 + 16); }  // the largest window, with gz's header
  ~Unpacker() { ::inflateEnd(&stream); }
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;
  z_stream stream{};
  bool between = false;  ///< a gz may consist of several, one after the other
};
#else
struct WaveBytes::Unpacker {};
#endif

WaveBytes::WaveBytes(const std::string& path) : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (!file_) throw InputError(path_, 0, what_is_wrong(errno) + ", expected a wave, VCD or FST");
  struct stat status {};
  if (::fstat(file_.get(), &status) == 0) size_ = static_cast<std::uint64_t>(status.st_size);
  input_.resize(kPiece);
  std::size_t have = 0;
  for (std::size_t got = 1; have < kGz.size() && got != 0; have += got)
    got = take(input_.data() + have, input_.size() - have);
  input_.resize(have);
  if (input_.compare(0, kGz.size(), kGz) != 0) return;
#ifdef DSDPV1_WITH_FST
  unpacker_ = std::make_unique<Unpacker>();
  unpacker_->stream.next_in = reinterpret_cast<Bytef*>(input_.data());
  unpacker_->stream.avail_in = static_cast<uInt>(input_.size());
#else
  throw InputError(path_, 0, "is a gz, which this program was built without, expected a VCD");
#endif
}

WaveBytes::~WaveBytes() = default;
WaveBytes::WaveBytes(WaveBytes&&) noexcept = default;

std::size_t WaveBytes::take(char* to, std::size_t size) {
  for (;;) {
    const ssize_t got = ::read(file_.get(), to, size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw InputError(path_, 0, what_is_wrong(errno) + ", expected a wave, VCD or FST");
    taken_ += static_cast<std::uint64_t>(got);
    return static_cast<std::size_t>(got);
  }
}

std::size_t WaveBytes::read(char* to, std::size_t size) {
  if (unpacker_) return unpack(to, size);
  if (at_ == input_.size()) return take(to, size);
  const std::size_t count = std::min(size, input_.size() - at_);
  std::memcpy(to, input_.data() + at_, count);
  at_ += count;
  return count;
}

#ifdef DSDPV1_WITH_FST
std::size_t WaveBytes::unpack(char* to, std::size_t size) {
  z_stream& stream = unpacker_->stream;
  stream.next_out = reinterpret_cast<Bytef*>(to);
  stream.avail_out = static_cast<uInt>(size);
  while (stream.avail_out == size) {
    if (stream.avail_in == 0 && !refill()) {
      if (unpacker_->between) return 0;
      throw InputError(path_, 0, "is a gz that was cut, expected a complete one");
    }
    const int result = ::inflate(&stream, Z_NO_FLUSH);
    if (unpacker_->between && result == Z_DATA_ERROR) return 0;  // padding after the last one, which gzip ignores too
    if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR)
      throw InputError(path_, 0, "is a gz that is damaged, expected a complete one");
    unpacker_->between = result == Z_STREAM_END;
    if (unpacker_->between) ::inflateReset(&stream);
  }
  return size - stream.avail_out;
}

bool WaveBytes::refill() {
  input_.resize(kPiece);
  input_.resize(take(input_.data(), input_.size()));
  unpacker_->stream.next_in = reinterpret_cast<Bytef*>(input_.data());
  unpacker_->stream.avail_in = static_cast<uInt>(input_.size());
  return !input_.empty();
}
#else
std::size_t WaveBytes::unpack(char* /*to*/, std::size_t /*size*/) { return 0; }
bool WaveBytes::refill() { return false; }
#endif

std::string foreign_form(const char* bytes, std::size_t size) {
  const std::string_view beginning(bytes, size);
  for (const ForeignForm& form : kForeignForms)
    if (beginning.compare(0, form.beginning.size(), form.beginning) == 0) return form.what;
  return "";
}

}  // namespace dsdpv1::tb
