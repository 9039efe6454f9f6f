// Configuration identifiers: Chk_Cfg requests and Get_Cfg answers (general and special identifier format of EN 50170).
#include <fmt/format.h>

#include "bus/telegram/explain_data.hpp"

namespace dsdpv1::bus::detail {

namespace {

constexpr std::uint8_t kWholeConsistency = 0x80, kWords = 0x40, kSpecialOut = 0x80, kSpecialIn = 0x40;

/// Iterates over the identifiers and adds up the lengths.
class CfgReader {
 public:
  explicit CfgReader(const Bytes& data) : data_(data) {}

  DataWords read() {
    while (at_ < data_.size()) read_identifier();
    words_.summary = fmt::format("{} {}, output {} bytes, input {} bytes", modules_,
                                 modules_ == 1 ? "module" : "modules", output_, input_);
    if (incomplete_) words_.summary += ", the last one incomplete";
    return std::move(words_);
  }

 private:
  void read_identifier() {
    const std::uint8_t id = data_[at_++];
    ++modules_;
    if ((id & 0x30U) == 0)
      read_special(id);
    else
      read_general(id);
  }

  void read_general(std::uint8_t id) {
    const bool in = (id & 0x10U) != 0, out = (id & 0x20U) != 0;
    const int bytes = add(id, (id & 0x0F) + 1, in, out);
    const char* direction = in && out ? "input and output" : in ? "input" : "output";
    say(fmt::format("module {}: {} {}", modules_, direction, length_words(id, bytes)));
  }

  void read_special(std::uint8_t id) {
    const bool out = (id & kSpecialOut) != 0, in = (id & kSpecialIn) != 0;
    const int specific = id & 0x0F;
    const char* kind = out && in ? "output and input" : out ? "output" : in ? "input" : "empty slot";
    say(fmt::format("module {}: special format, {}, {}", modules_, kind, specific_words(specific)));
    if (out) read_length("output", false);
    if (in) read_length("input", true);
    if (specific != 15) read_specific(specific);
  }

  static std::string specific_words(int count) {
    if (count == 15) return "no manufacturer data, their comparison is switched off";
    return count == 0 ? "no manufacturer data" : fmt::format("{} bytes of manufacturer data", count);
  }

  void read_length(const char* direction, bool input) {
    if (at_ >= data_.size()) {
      incomplete_ = true;
      return;
    }
    const std::uint8_t length = data_[at_++];
    const int bytes = add(length, (length & 0x3F) + 1, input, !input);
    say(fmt::format("  length of {}: {}", direction, length_words(length, bytes)));
  }

  void read_specific(int count) {
    for (int i = 0; i < count; ++i) {
      if (at_ >= data_.size()) {
        incomplete_ = true;
        return;
      }
      ++at_;
      say(fmt::format("  manufacturer data {}", i));
    }
  }

  int add(std::uint8_t format, int units, bool in, bool out) {
    const int bytes = (format & kWords) != 0 ? 2 * units : units;
    if (in) input_ += bytes;
    if (out) output_ += bytes;
    return bytes;
  }

  static std::string length_words(std::uint8_t format, int bytes) {
    const bool word = (format & kWords) != 0;
    const int units = word ? bytes / 2 : bytes;
    const bool whole = (format & kWholeConsistency) != 0;
    return fmt::format("{} {}{}, consistency over {}", units, word ? "word" : "byte", units == 1 ? "" : "s",
                       whole  ? "the whole module"
                       : word ? "a word"
                              : "a byte");
  }

  void say(std::string text) { words_.bytes.push_back(std::move(text)); }

  const Bytes& data_;
  std::size_t at_ = 0;
  int modules_ = 0, input_ = 0, output_ = 0;
  bool incomplete_ = false;
  DataWords words_;
};

}  // namespace

DataWords cfg_words(const Bytes& data) { return CfgReader(data).read(); }

}  // namespace dsdpv1::bus::detail
