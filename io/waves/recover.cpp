#include "io/waves/recover.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "io/input/input_error.hpp"
#include "io/output/output_file.hpp"
#include "io/waves/vcd_reader.hpp"
#include "io/waves/wave_bytes.hpp"

namespace dsdpv1::tb {
namespace {

constexpr std::size_t kFstHeader = 330;                           // bytes of an FST's first block
constexpr std::string_view kFstTag{"\0\0\0\0\0\0\0\x01\x49", 9};  // ... and how it begins: its kind and length

std::string beginning(const std::string& path, std::size_t length) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw InputError(path, 0, "is no file, expected the wave that a killed run has left");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path, 0, "cannot be opened, expected the wave that a killed run has left");
  std::string text(length, '\0');
  in.read(text.data(), static_cast<std::streamsize>(length));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

/// The part of a VCD before its last time, the changes of which may be incomplete. A time that was cut is earlier than
/// the real one, and the wave is the same until then.
struct Whole {
  std::uint64_t bytes = 0;
  std::string end;  ///< the line that ends it, if it goes on without a change
  Recovered until;
};

Whole whole_part(const std::string& part) {
  VcdReader reader(part);
  try {
    for (WaveEvent event; reader.next(event);) {
    }
  } catch (const InputError&) {  // the end of what is good
  }
  if (!reader.before_end()) throw InputError(part, 0, "holds no changes yet, so there is nothing to recover");
  const auto [bytes, time] = *reader.before_end();
  const std::uint64_t end = reader.end() - 1;
  return {bytes, end != time ? "#" + std::to_string(end) + "\n" : "", {end, reader.declarations().exponent}};
}

void copy(const std::string& from, std::uint64_t bytes, OutputFile& to) {
  WaveBytes in(from);
  for (std::array<char, 1U << 16U> block{}; bytes != 0 && !to.failed();) {
    const std::size_t got = in.read(block.data(), std::min<std::uint64_t>(block.size(), bytes));
    if (got == 0) throw InputError(from, 0, "cannot be read to its end");
    to.write({block.data(), got});
    bytes -= got;
  }
}

}  // namespace

WaveFormat wave_format(const std::string& path) {
  const std::string text = beginning(path, kFstHeader);
  if (text.size() == kFstHeader && text.compare(0, kFstTag.size(), kFstTag) == 0) return WaveFormat::kFst;
  const bool gz = text.compare(0, 2, "\x1f\x8b") == 0;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (gz || (first != std::string::npos && text[first] == '$')) return WaveFormat::kVcd;
  const std::string foreign = foreign_form(text.data(), text.size());
  throw InputError(path, 0,
                   foreign.empty() ? "is no wave, expected the VCD or FST that a killed run has left" : foreign);
}

Recovered recover_vcd(const std::string& part, const std::string& output) {
  const Whole whole = whole_part(part);
  OutputFile file(output);
  copy(part, whole.bytes, file);
  file.write(whole.end);
  file.commit();
  return whole.until;
}

}  // namespace dsdpv1::tb
