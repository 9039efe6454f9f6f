#include "cosim/joined_wave.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <utility>

#include "io/waves/join_waves.hpp"
#include "io/waves/wave_writer.hpp"

namespace dsdpv1::cosim {
namespace {

/// Writes a wave that contains only the difference.
void write_difference(const std::string& path, const Difference& difference) {
  const std::unique_ptr<tb::WaveWriter> writer = tb::open_wave(path);
  writer->open_scope("lockstep");
  const tb::WaveWriter::Signal signal = writer->words("difference");
  writer->close_scope();
  writer->say(0, signal, "-");
  writer->say(difference.at, signal, difference.what);
  writer->finish(difference.at);
}

}  // namespace

JoinedWave::JoinedWave(std::string path, std::string folder)
    : path_(std::move(path)), folder_(std::move(folder)), model_(part("model")) {}

JoinedWave::~JoinedWave() {
  for (const std::unique_ptr<tb::NameToRemove>& each : parts_) ::unlink(each->text().c_str());
}

/// FST keeps blanks in words, and its files are small.
std::string JoinedWave::part(const std::string& name) {
  parts_.push_back(std::make_unique<tb::NameToRemove>(fmt::format("{}/{}-{}.fst", folder_, ::getpid(), name)));
  return parts_.back()->text();
}

RtlTrace JoinedWave::trace(const std::string& chip, Tick from, Tick to) {
  traces_.push_back({chip, part(fmt::format("rtl-{}", traces_.size()))});
  return {traces_.back().file, from, to};
}

void JoinedWave::finish(const std::optional<Difference>& difference) {
  std::vector<tb::WavePart> parts = {{model_, "", ""}};
  if (difference) {
    parts.push_back({part("difference"), "", ""});
    write_difference(parts.back().file, *difference);
  }
  for (const Trace& each : traces_) parts.push_back({each.file, kTraceScope, each.chip + ".rtl"});
  tb::join_waves(parts, path_);
}

}  // namespace dsdpv1::cosim
