#pragma once
// A file of telegrams in whatever form: text, pcapng, pcap, a sigrok session, a logic analyser's CSV, VCD, FST.
#include <array>
#include <cstdint>
#include <fstream>
#include <istream>
#include <optional>
#include <streambuf>
#include <string>
#include <string_view>

#include "bus/capture/csv_reader.hpp"

namespace dsdpv1::app {

/// A stream that still delivers its beginning after a look at it; also a pipe, which cannot go back.
class RewoundInput {
 public:
  /// Reads the beginning of `in`, which must outlive it.
  explicit RewoundInput(std::istream& in) : buffer_(in), stream_(&buffer_) {}

  /// Up to kBeginning bytes.
  std::string_view beginning() const { return buffer_.beginning(); }
  /// All of the input, with its beginning.
  std::istream& stream() { return stream_; }

  static constexpr std::size_t kBeginning = 4096;

 private:
  class Buffer : public std::streambuf {
   public:
    explicit Buffer(std::istream& in) : in_(in) { fill(kBeginning); }
    std::string_view beginning() const { return {bytes_.data(), size_}; }

   protected:
    int_type underflow() override {
      if (gptr() == egptr()) fill(bytes_.size());
      if (in_.bad()) throw std::ios_base::failure("cannot be read");  // the stream of this buffer is bad then
      return gptr() == egptr() ? traits_type::eof() : traits_type::to_int_type(*gptr());
    }

   private:
    void fill(std::size_t most) {
      in_.read(bytes_.data(), static_cast<std::streamsize>(most));
      size_ = static_cast<std::size_t>(in_.gcount());
      setg(bytes_.data(), bytes_.data(), bytes_.data() + size_);
    }

    std::istream& in_;
    std::array<char, 16'384> bytes_{};
    std::size_t size_ = 0;
  };

  Buffer buffer_;
  std::istream stream_;
};

enum class CaptureForm : std::uint8_t { kText, kPcapng, kPcap, kSigrok, kCsv, kWave };

/// How exact a recording's times are, as far as it says so itself.
struct Sampling {
  std::optional<std::uint64_t> rate = {};  ///< samples a second
  double unit = 0;                         ///< without a rate: ticks to which times were rounded
};

/// A capture, whose format is detected by its first bytes.
class CaptureFile {
 public:
  /// `path`: empty or "-" is standard input. Throws tb::InputError.
  explicit CaptureFile(const std::string& path);

  CaptureForm form() const { return form_; }
  /// True if the file has packets, each a telegram with its time.
  bool packets() const { return form_ == CaptureForm::kPcapng || form_ == CaptureForm::kPcap; }
  /// Empty: standard input.
  std::string path() const { return standard_input_ ? "" : path_; }
  /// For messages.
  const std::string& name() const { return name_; }
  std::istream& stream() { return input_.stream(); }

  /// Gives `take` each telegram; what it returns is the signal of a recording, nothing for packets and text. Throws
  /// tb::InputError.
  std::optional<bus::capture::LogicSource> read(const bus::capture::LogicSettings& settings,
                                                const bus::capture::TakeTelegram& take);
  /// Gives `taker` the levels of a recording: a wave, a session of sigrok, a table. Throws tb::InputError, also for
  /// another form.
  Sampling read_levels(bus::capture::LevelTaker& taker);

 private:
  bool standard_input_;
  std::string path_, name_;
  std::ifstream file_;
  RewoundInput input_;
  CaptureForm form_;
};

}  // namespace dsdpv1::app
