#include "bus/capture/sigrok_reader.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <memory>
#include <sstream>
#include <utility>

#include "bus/capture/sample_clock.hpp"
#include "bus/capture/signal_decoder.hpp"

namespace bus::capture {
namespace {

constexpr std::size_t kLongestMetadata = 65'536, kMostUnit = 16, kMostProbes = 8 * kMostUnit;

struct CloseArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct CloseFile {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using Archive = std::unique_ptr<zip_t, CloseArchive>;
using File = std::unique_ptr<zip_file_t, CloseFile>;

Archive open_archive(const std::string& bytes) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  Archive archive(source != nullptr ? zip_open_from_source(source, ZIP_RDONLY, &error) : nullptr);
  const std::string what = zip_error_strerror(&error);
  if (!archive && source != nullptr) zip_source_free(source);
  zip_error_fini(&error);
  if (!archive) throw CaptureError(fmt::format("is no whole ZIP archive ({}), allowed is a session of sigrok", what));
  return archive;
}

/// The next piece of a member into `to`; 0 at its end.
std::size_t read_piece(zip_file_t* file, char* to, std::size_t size) {
  const zip_int64_t count = zip_fread(file, to, size);
  if (count < 0) throw CaptureError("a member of the archive is damaged, allowed is a session of sigrok");
  return static_cast<std::size_t>(count);
}

std::string metadata_of(zip_t* archive) {
  const File file(zip_fopen(archive, "metadata", 0));
  if (!file) throw CaptureError("has no metadata, allowed is a session of sigrok");
  std::string text(kLongestMetadata, '\0');
  text.resize(read_piece(file.get(), text.data(), text.size()));
  return text;
}

/// "key=value" of the first device.
std::map<std::string, std::string> device_of(const std::string& metadata) {
  std::map<std::string, std::string> device;
  std::istringstream lines(metadata);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!line.empty() && line[0] == '[') inside = line.compare(0, 7, "[device") == 0 && device.empty();
    const std::size_t equals = line.find('=');
    if (inside && equals != std::string::npos) device[line.substr(0, equals)] = line.substr(equals + 1);
  }
  return device;
}

struct Session {
  std::string member;  ///< of the samples; in pieces it is followed by -1, -2, ...
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
        "its metadata has no logic samples (capturefile, samplerate, unitsize 1 to 16), allowed is a session of "
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

/// Tells the levels of some bits of the samples, which may begin in one piece and end in the next.
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

/// False when there is no such member.
bool add_member(zip_t* archive, const std::string& name, Samples& samples) {
  const File file(zip_fopen(archive, name.c_str(), 0));
  if (!file) return false;
  std::array<char, 16'384> piece{};
  while (const std::size_t size = read_piece(file.get(), piece.data(), piece.size())) samples.add(piece.data(), size);
  return true;
}

}  // namespace

std::uint64_t read_sigrok_levels(const std::string& archive, LevelTaker& taker) {
  const Archive opened = open_archive(archive);
  const Session session = session_of(device_of(metadata_of(opened.get())));
  std::vector<std::size_t> bits;
  for (const std::size_t chosen : taker.choose(session.names)) bits.push_back(session.bits[chosen]);
  Samples samples(session, bits, taker);
  if (!add_member(opened.get(), session.member, samples))
    for (int part = 1; add_member(opened.get(), fmt::format("{}-{}", session.member, part), samples); ++part) {
    }
  if (!samples.any()) throw CaptureError("has no samples, allowed is a session of sigrok");
  taker.finish(samples.end());
  return session.rate;
}

LogicSource read_sigrok(const std::string& archive, const LogicSettings& settings, const TakeTelegram& take) {
  SignalDecoder decoder(settings, take);
  read_sigrok_levels(archive, decoder);
  return decoder.source();
}

}  // namespace bus::capture
