#pragma once
// Value Change Dump, IEEE 1364-2005 clause 18, with simulators' extensions: strings, reals as words, VHDL's nine
// values.
#include "io/waves/vcd_codes.hpp"
#include "io/waves/vcd_text.hpp"
#include "io/waves/wave_reader.hpp"

namespace dsdpv1::tb {

class VcdReader : public WaveReader {
 public:
  /// Reads the declarations; throws InputError.
  explicit VcdReader(const std::string& path);

  const WaveDeclarations& declarations() const override { return declarations_; }
  void select(const std::vector<bool>& signals) override { selected_ = signals; }
  bool next(WaveEvent& event) override;
  std::uint64_t begin() const override { return begin_.value_or(0); }
  std::uint64_t end() const override { return now_; }
  double share() const override { return text_.share(); }
  /// The bytes of the text before the last time read, and the time before that one; nullopt: there was none.
  std::optional<std::pair<std::uint64_t, std::uint64_t>> before_end() const { return before_end_; }

 private:
  void move_to(std::string_view digits);
  /// True when the command is an event.
  bool command(std::string_view word, WaveEvent& event);
  bool scalar(std::string_view word, WaveEvent& event);
  bool vector(std::string_view word, WaveEvent& event);
  bool word_value(std::string_view word, WaveEvent& event);
  bool trigger(char level, std::uint32_t signal, WaveEvent& event) const;
  std::uint32_t signal(std::string_view code) const;
  std::string_view extended(std::string_view bits, std::uint32_t width);
  bool tell(WaveEvent& event, std::uint32_t signal, std::string_view value) const;
  [[noreturn]] void refuse(std::string_view word) const;

  VcdText text_;
  WaveDeclarations declarations_;
  VcdCodes codes_;
  std::vector<bool> selected_;
  std::string value_;   ///< of the present event, in the file's text
  std::string levels_;  ///< ... of bits, as reported
  std::optional<std::uint64_t> begin_;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> before_end_;
  std::uint64_t now_ = 0;
};

}  // namespace dsdpv1::tb
