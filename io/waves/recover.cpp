#include "io/waves/recover.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "io/input/input_error.hpp"
#include "io/output/output_file.hpp"

namespace dsdpv1::tb {
namespace {

constexpr std::size_t kFstVersion = 74;  // place of the author in an FST file

std::string beginning(const std::string& path, std::size_t length) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw InputError(path, 0, "is no file, expected a wave's FILE.part that a run has left");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path, 0, "cannot be opened, expected a wave's FILE.part that a run has left");
  std::string text(length, '\0');
  in.read(text.data(), static_cast<std::streamsize>(length));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

/// The part of a VCD file with complete times, and the last of them.
struct Whole {
  std::uintmax_t bytes = 0;
  std::uint64_t time = 0;
};

/// The changes after the last time may be incomplete, so they are dropped; the line of that time ends the wave.
Whole whole_times(const std::string& part) {
  Whole whole;
  std::uintmax_t at = 0;
  std::ifstream in(part, std::ios::binary);
  for (std::string line; std::getline(in, line) && !in.eof();) {
    at += line.size() + 1;
    if (line.empty() || line.front() != '#') continue;
    whole = {at, std::strtoull(line.c_str() + 1, nullptr, 10)};
  }
  return whole;
}

void copy(const std::string& from, std::uintmax_t bytes, OutputFile& to) {
  std::ifstream in(from, std::ios::binary);
  for (std::array<char, 1U << 16U> block{}; bytes != 0 && !to.failed();) {
    in.read(block.data(), static_cast<std::streamsize>(std::min<std::uintmax_t>(block.size(), bytes)));
    if (in.gcount() == 0) throw InputError(from, 0, "cannot be read to its end");
    to.write({block.data(), static_cast<std::size_t>(in.gcount())});
    bytes -= static_cast<std::uintmax_t>(in.gcount());
  }
}

}  // namespace

WaveFormat wave_format(const std::string& path) {
  const std::string author = kWaveAuthor;
  const std::string text = beginning(path, kFstVersion + author.size());
  if (text.rfind("$version " + author, 0) == 0) return WaveFormat::kVcd;
  if (text.size() > kFstVersion && text.front() == '\0' && text.substr(kFstVersion) == author) return WaveFormat::kFst;
  throw InputError(path, 0, "is no wave of dsdpv1-sim, expected a wave's FILE.part that a run has left");
}

std::uint64_t recover_vcd(const std::string& part, const std::string& output) {
  const Whole whole = whole_times(part);
  if (whole.bytes == 0) throw InputError(part, 0, "holds no changes yet, so there is nothing to recover");
  OutputFile file(output);
  copy(part, whole.bytes, file);
  file.commit();
  return whole.time;
}

}  // namespace dsdpv1::tb
