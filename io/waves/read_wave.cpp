#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "io/waves/vcd_reader.hpp"
#include "io/waves/wave_reader.hpp"
#ifdef DSDPV1_WITH_FST
#include "io/waves/fst_reader.hpp"
#endif

namespace dsdpv1::tb {
namespace {

constexpr const char* kAllowed = ", expected a wave, VCD or FST";

/// Decides by the first byte: 0, the header's tag, or 254 for a file that is compressed as a whole. A FIFO is not read,
/// because it gives its bytes only once.
bool is_fst(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) throw InputError(path, 0, what_is_wrong(errno) + kAllowed);
  if (S_ISDIR(status.st_mode)) throw InputError(path, 0, std::string("is a folder") + kAllowed);
  if (!S_ISREG(status.st_mode)) return false;
  if (status.st_size == 0) throw InputError(path, 0, std::string("is empty") + kAllowed);
  std::ifstream in(path, std::ios::binary);
  const int first = in.get();
  return first == 0 || first == 254;
}

}  // namespace

std::unique_ptr<WaveReader> read_wave(const std::string& path) {
  if (!is_fst(path)) return std::make_unique<VcdReader>(path);
#ifdef DSDPV1_WITH_FST
  return std::make_unique<FstReader>(path);
#else
  throw InputError(path, 0, "is FST, which this program was built without, expected a VCD");
#endif
}

}  // namespace dsdpv1::tb
