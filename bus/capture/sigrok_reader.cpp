#include "bus/capture/sigrok_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>
#include <utility>

#include "bus/capture/sample_clock.hpp"
#include "bus/capture/signal_decoder.hpp"
#include "bus/capture/zip_archive.hpp"

namespace dsdpv1::bus::capture {
namespace {

constexpr std::size_t kLongestMetadata = 65'536, kMostUnit = 16, kMostProbes = 8 * kMostUnit;

std::string metadata_of(ZipArchive& archive) {
  std::string text;
  const auto take = [&text](const char* bytes, std::size_t size) {
    text.append(bytes, std::min(size, kLongestMetadata - text.size()));
  };
  if (!archive.read("metadata", take)) throw CaptureError("has no metadata, expected a session of sigrok");
  return text;
}

std::string without_blanks_around(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// "key=value" for the first device; old sessions have blanks around the sign.
std::map<std::string, std::string> device_of(const std::string& metadata) {
  std::map<std::string, std::string> device;
  std::istringstream lines(metadata);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!line.empty() && line[0] == '[') inside = line.compare(0, 7, "[device") == 0 && device.empty();
    const std::size_t equals = line.find('=');
    if (inside && equals != std::string::npos)
      device[without_blanks_around(line.substr(0, equals))] = without_blanks_around(line.substr(equals + 1));
  }
  return device;
}

struct Session {
  std::string member;  ///< file of the samples; if split, followed by -1, -2, ...
  std::uint64_t rate = 1;
  SampleClock clock{1};
  std::size_t unit = 1;  ///< bytes of a sample
  std::vector<std::string> names;
  std::vector<std::size_t> bits;  ///< of a sample, by name
};

Session session_of(const std::map<std::string, std::string>& device) {
  const auto value = [&device](const std::string& key) {
    const auto found = device.find(key);
    return found == device.end() ? std::string() : found->second;
  };
  Session session;
  session.member = value("capturefile");
  const auto rate = sample_rate(value("samplerate"));
  session.unit = static_cast<std::size_t>(std::strtoul(value("unitsize").c_str(), nullptr, 10));
  if (session.member.empty() || !rate || session.unit < 1 || session.unit > kMostUnit)
    throw CaptureError(
        "its metadata has no logic samples (capturefile, samplerate, unitsize 1 to 16), expected a session of "
        "sigrok");
  session.rate = *rate;
  session.clock = SampleClock(*rate);
  for (std::size_t probe = 1; probe <= std::min(kMostProbes, 8 * session.unit); ++probe) {
    const std::string name = value(fmt::format("probe{}", probe));
    if (name.empty()) continue;
    session.names.push_back(name);
    session.bits.push_back(probe - 1);
  }
  return session;
}

/// Extracts the levels of some bits of the samples, which may begin in one piece and end in the next.
class Samples {
 public:
  Samples(const Session& session, std::vector<std::size_t> bits, LevelTaker& taker)
      : session_(session), bits_(std::move(bits)), taker_(taker), now_(session.unit), before_(session.unit) {}

  void add(const char* bytes, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      now_[at_] = bytes[i];
      if (++at_ < session_.unit) continue;
      at_ = 0;
      if (count_ == 0 || now_ != before_) tell();
      ++count_;
    }
  }
  Tick end() const { return session_.clock.at(count_); }
  bool any() const { return count_ > 0; }

 private:
  static bool level(const std::vector<char>& sample, std::size_t bit) {
    return (static_cast<unsigned char>(sample[bit / 8]) >> bit % 8U & 1U) != 0;
  }
  void tell() {
    const Tick at = session_.clock.at(count_);
    for (std::size_t which = 0; which < bits_.size(); ++which)
      if (count_ == 0 || level(now_, bits_[which]) != level(before_, bits_[which]))
        taker_.level(at, which, level(now_, bits_[which]));
    before_ = now_;
  }

  const Session& session_;
  std::vector<std::size_t> bits_;
  LevelTaker& taker_;
  std::vector<char> now_, before_;
  std::size_t at_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace

std::uint64_t read_sigrok_levels(const std::string& archive, LevelTaker& taker) {
  ZipArchive opened(archive);
  const Session session = session_of(device_of(metadata_of(opened)));
  std::vector<std::size_t> bits;
  for (const std::size_t chosen : taker.choose(session.names)) bits.push_back(session.bits[chosen]);
  Samples samples(session, bits, taker);
  const auto add = [&samples](const char* bytes, std::size_t size) { samples.add(bytes, size); };
  if (!opened.read(session.member, add))
    for (int part = 1; opened.read(fmt::format("{}-{}", session.member, part), add); ++part) {
    }
  if (!samples.any()) throw CaptureError("has no samples, expected a session of sigrok");
  taker.finish(samples.end());
  return session.rate;
}

LogicSource read_sigrok(const std::string& archive, const LogicSettings& settings, const TakeTelegram& take) {
  SignalDecoder decoder(settings, take);
  read_sigrok_levels(archive, decoder);
  return decoder.source();
}

}  // namespace dsdpv1::bus::capture
