#include "apps/wave_line.hpp"

#include <filesystem>
#include <limits>
#include <vector>

#include "bus/capture/byte_reader.hpp"
#include "bus/capture/logic_decoder.hpp"
#include "tb/waves/wave_reader.hpp"

namespace app {
namespace {

namespace capture = bus::capture;

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
    if (whole > kMost / ns_)
      throw capture::CaptureError("lasts more than ten years, allowed is a recording of the line");
    return static_cast<bus::Tick>(whole * ns_ * kTicks + (part * kTicks + per_ns_ / 2) / per_ns_);
  }

 private:
  std::uint64_t ns_ = 1, per_ns_ = 1;
};

/// The signals of one bit with their names.
struct Wires {
  std::vector<std::string> names;
  std::vector<std::uint32_t> signals;
};

Wires wires_of(const tb::WaveDeclarations& declared) {
  Wires wires;
  for (const tb::WaveVariable& variable : declared.variables) {
    const tb::WaveSignal& signal = declared.signals[variable.signal];
    if (signal.kind != tb::WaveKind::kBits || signal.width != 1) continue;
    const std::string& scope = declared.scopes[variable.scope];
    wires.names.push_back(scope.empty() ? variable.name : scope + "." + variable.name);
    wires.signals.push_back(variable.signal);
  }
  return wires;
}

}  // namespace

bool begins_as_wave(std::string_view beginning) {
  constexpr std::size_t kFstHeader = 9;  // the block's type, and its length
  constexpr std::uint64_t kFstHeaderLength = 329;
  const std::size_t first = beginning.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && beginning[first] == '$') return true;
  if (beginning.size() < kFstHeader) return false;
  const bool compressed = beginning[0] == '\xFE';
  return compressed || (beginning[0] == 0 && capture::number_in(beginning.substr(1, 8), true) == kFstHeaderLength);
}

capture::LogicSource read_wave_line(const std::string& path, const capture::LogicSettings& settings,
                                    const capture::TakeTelegram& take) {
  if (!std::filesystem::is_regular_file(path))
    throw capture::CaptureError("is a wave by a pipe or standard input, allowed for a wave is the name of a file");
  const auto wave = tb::read_wave(path);
  const Wires wires = wires_of(wave->declarations());
  const std::size_t chosen = capture::choose_signal(wires.names, settings.signal);
  std::vector<bool> selected(wave->declarations().signals.size());
  selected[wires.signals[chosen]] = true;
  wave->select(selected);
  const WaveClock clock(wave->declarations().exponent);
  capture::LogicDecoder decoder(settings, take);
  for (tb::WaveEvent event; wave->next(event);)
    if (event.kind == tb::WaveEvent::Kind::kChange && (event.value == "0" || event.value == "1"))
      decoder.level(clock.at(event.time), event.value == "1");  // with x and z the level stays
  decoder.finish(clock.at(wave->end()));
  return {wires.names[chosen], *decoder.baud()};
}

}  // namespace app
