#include "apps/commands/capture_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "bus/capture/byte_reader.hpp"
#include "bus/capture/pcap_reader.hpp"
#include "bus/capture/signal_decoder.hpp"
#include "bus/capture/sigrok_reader.hpp"
#include "bus/capture/text_reader.hpp"
#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "io/waves/wave_reader.hpp"

namespace dsdpv1::app {
namespace {

namespace capture = bus::capture;

constexpr std::size_t kLongestArchive = 64U << 20U;

/// Times of a wave as ticks of 1/12 ns, from the absolute count.
class WaveClock {
 public:
  /// Times count 10^exponent seconds, -15 to 2.
  explicit WaveClock(int exponent) {
    constexpr int kNs = -9;
    for (int i = kNs; i < exponent; ++i) ns_ *= 10;
    for (int i = exponent; i < kNs; ++i) per_ns_ *= 10;
  }
  bus::Tick at(std::uint64_t time) const {
    constexpr std::uint64_t kTicks = bus::kTicksPerNs, kMost = std::numeric_limits<bus::Tick>::max() / 2 / kTicks;
    const std::uint64_t whole = time / per_ns_, part = time % per_ns_;
    if (whole > kMost / ns_) throw capture::CaptureError("lasts more than ten years, expected a recording of the line");
    return static_cast<bus::Tick>(whole * ns_ * kTicks + (part * kTicks + per_ns_ / 2) / per_ns_);
  }

 private:
  std::uint64_t ns_ = 1, per_ns_ = 1;
};

/// A bit of a signal of the wave.
struct Wire {
  std::uint32_t signal = 0;
  std::size_t place = 0;  ///< in its value, the leftmost bit is 0
};

/// As declared, or counted down to 0.
int index_of(const tb::WaveVariable& variable, const tb::WaveSignal& signal, std::uint32_t place) {
  const int at = static_cast<int>(place);
  if (!variable.range) return static_cast<int>(signal.width) - 1 - at;
  const auto& [left, right] = *variable.range;
  return left >= right ? left - at : left + at;
}

/// The signals to choose from: those of one bit and, with `vectors`, the bits of others.
struct Wires {
  std::vector<std::string> names;
  std::vector<Wire> wires;

  void add(const std::string& name, Wire wire) {
    names.push_back(name);
    wires.push_back(wire);
  }
};

Wires wires_of(const tb::WaveDeclarations& declared, bool vectors) {
  constexpr std::uint32_t kWidest = 64;
  Wires wires;
  for (const tb::WaveVariable& variable : declared.variables) {
    const tb::WaveSignal& signal = declared.signals[variable.signal];
    if (signal.kind != tb::WaveKind::kBits || signal.width > (vectors ? kWidest : 1)) continue;
    const std::string& scope = declared.scopes[variable.scope];
    const std::string name = scope.empty() ? variable.name : scope + "." + variable.name;
    const bool one = signal.width == 1;
    for (std::uint32_t bit = 0; bit < signal.width; ++bit)
      wires.add(one && !(vectors && variable.range)
                    ? name
                    : name + "[" + std::to_string(index_of(variable, signal, bit)) + "]",
                {variable.signal, bit});
  }
  return wires;
}

/// Tells a wave's chosen wires.
class WaveLevels {
 public:
  WaveLevels(const std::string& path, capture::LevelTaker& taker, bool vectors)
      : wave_(tb::read_wave(path)),
        taker_(taker),
        clock_(wave_->declarations().exponent),
        wires_(wires_of(wave_->declarations(), vectors)) {
    const std::size_t count = wave_->declarations().signals.size();
    by_signal_.resize(count);
    std::vector<bool> selected(count);
    std::size_t which = 0;
    for (const std::size_t chosen : taker_.choose(wires_.names)) {
      const Wire& wire = wires_.wires[chosen];
      selected[wire.signal] = true;
      by_signal_[wire.signal].push_back({wire.place, which++});
    }
    wave_->select(selected);
  }

  void tell() {
    for (tb::WaveEvent event; wave_->next(event);)
      if (event.kind == tb::WaveEvent::Kind::kChange) change(event);
    taker_.finish(clock_.at(wave_->end()));
  }
  double unit() const {
    auto unit = static_cast<double>(bus::kTicksPerSecond);
    for (int i = wave_->declarations().exponent; i < 0; ++i) unit /= 10;
    return unit;
  }

 private:
  struct Chosen {
    std::size_t place, which;
  };
  void change(const tb::WaveEvent& event) {
    for (const Chosen& chosen : by_signal_[event.signal]) {
      const char bit = chosen.place < event.value.size() ? event.value[chosen.place] : 'x';
      if (bit == '0' || bit == '1') taker_.level(clock_.at(event.time), chosen.which, bit == '1');
    }
  }

  std::unique_ptr<tb::WaveReader> wave_;
  capture::LevelTaker& taker_;
  WaveClock clock_;
  Wires wires_;
  std::vector<std::vector<Chosen>> by_signal_;
};

void check_is_file(const std::string& path) {
  if (!std::filesystem::is_regular_file(path))
    throw capture::CaptureError("is a wave by a pipe or standard input, expected the name of a file");
}

bool begins_as_wave(std::string_view beginning) {
  constexpr std::size_t kFstHeader = 9;  // the block's type, and its length
  constexpr std::uint64_t kFstHeaderLength = 329;
  const std::size_t first = beginning.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && beginning[first] == '$') return true;
  if (beginning.size() < kFstHeader) return false;
  const bool compressed = beginning[0] == '\xFE' || beginning.compare(0, 2, "\x1F\x8B") == 0;  // FST; a gz of a VCD
  return compressed || (beginning[0] == 0 && capture::number_in(beginning.substr(1, 8), true) == kFstHeaderLength);
}

/// Gives `taker` the signals that it wants, the wires of a vector as "A[3]"; with x and z a level stays. Returns the
/// wave's unit of time in ticks. `path` as below.
double read_wave_levels(const std::string& path, capture::LevelTaker& taker) {
  check_is_file(path);
  WaveLevels levels(path, taker, true);
  levels.tell();
  return levels.unit();
}

/// The telegrams of one signal of a single bit. `path` is a file: a pipe has given its beginning away. Throws
/// tb::InputError, and CaptureError as other readers.
capture::LogicSource read_wave_line(const std::string& path, const capture::LogicSettings& settings,
                                    const capture::TakeTelegram& take) {
  check_is_file(path);
  capture::SignalDecoder decoder(settings, take);
  WaveLevels(path, decoder, false).tell();
  return decoder.source();
}

std::ifstream open_file(const std::string& path) {
  if (std::filesystem::path(path).extension() == ".ptd" || std::filesystem::path(path).extension() == ".PTD")
    throw tb::InputError(path, 0,
                         "is a message file of ProfiTrace, which is not read, expected its messages exported as text");
  const bool folder = std::filesystem::is_directory(path);
  std::ifstream file(path, std::ios::binary);
  if (folder || !file)
    throw tb::InputError(path, 0,
                         tb::what_is_wrong(folder ? EISDIR : errno) +
                             ", expected a file of telegrams: hexadecimal text, a log, a capture, a recording");
  return file;
}

CaptureForm form_of(std::string_view beginning) {
  if (capture::begins_as_pcapng(beginning)) return CaptureForm::kPcapng;
  if (capture::begins_as_pcap(beginning)) return CaptureForm::kPcap;
  if (capture::begins_as_zip(beginning)) return CaptureForm::kSigrok;
  if (capture::begins_as_csv(beginning)) return CaptureForm::kCsv;
  return begins_as_wave(beginning) ? CaptureForm::kWave : CaptureForm::kText;
}

std::string read_archive(std::istream& in) {
  std::string bytes;
  std::array<char, 16'384> piece{};
  while (in.read(piece.data(), piece.size()) || in.gcount() > 0) {
    bytes.append(piece.data(), static_cast<std::size_t>(in.gcount()));
    if (bytes.size() > kLongestArchive)
      throw capture::CaptureError(
          fmt::format("is larger than {} MB, expected a session of sigrok", kLongestArchive >> 20U));
  }
  return bytes;
}

}  // namespace

CaptureFile::CaptureFile(const std::string& path)
    : standard_input_(path.empty() || path == "-"),
      path_(path),
      name_(standard_input_ ? "standard input" : path),
      file_(standard_input_ ? std::ifstream() : open_file(path)),
      input_(standard_input_ ? std::cin : file_),
      form_(form_of(input_.beginning())) {}

std::optional<capture::LogicSource> CaptureFile::read(const capture::LogicSettings& settings,
                                                      const capture::TakeTelegram& take) {
  try {
    switch (form_) {
      case CaptureForm::kPcapng: capture::read_pcapng(stream(), take); break;
      case CaptureForm::kPcap: capture::read_pcap(stream(), take); break;
      case CaptureForm::kSigrok: return capture::read_sigrok(read_archive(stream()), settings, take);
      case CaptureForm::kCsv: return capture::read_csv(stream(), settings, take);
      case CaptureForm::kWave: return read_wave_line(path_, settings, take);
      case CaptureForm::kText: capture::read_text(stream(), settings.baud, take); break;
    }
  } catch (const capture::CaptureError& error) {
    throw tb::InputError(name_, error.line(), error.what());
  }
  return std::nullopt;
}

Sampling CaptureFile::read_levels(capture::LevelTaker& taker) {
  try {
    switch (form_) {
      case CaptureForm::kSigrok: return {capture::read_sigrok_levels(read_archive(stream()), taker)};
      case CaptureForm::kCsv: return {capture::read_csv_levels(stream(), taker), static_cast<double>(bus::kTicksPerNs)};
      case CaptureForm::kWave: return {{}, read_wave_levels(path_, taker)};
      default: break;
    }
  } catch (const capture::CaptureError& error) {
    throw tb::InputError(name_, error.line(), error.what());
  }
  throw tb::InputError(name_, 0,
                       "has no levels of pins, expected VCD, FST, a session of sigrok, CSV of a logic analyser");
}

}  // namespace dsdpv1::app
