#pragma once
// The part of a VCD file before its first change (IEEE 1364-2005, 18.2).
#include "io/waves/vcd_codes.hpp"
#include "io/waves/vcd_text.hpp"
#include "io/waves/wave_name.hpp"
#include "io/waves/wave_reader.hpp"

namespace dsdpv1::tb {

/// Reads them up to and including $enddefinitions; throws InputError.
class VcdDeclarations {
 public:
  VcdDeclarations(VcdText& text, WaveDeclarations& to, VcdCodes& codes)
      : text_(text), to_(to), codes_(codes), scopes_(to) {}
  void read();

 private:
  /// The next word; the end of the file is an error.
  std::string word();
  /// The words up to $end, one blank between two.
  std::string rest();
  void skip();
  void timescale();
  void scope();
  void variable();
  std::uint32_t signal(const std::string& code, const WaveSignal& declared);
  void keep(std::size_t bytes);

  VcdText& text_;
  WaveDeclarations& to_;
  VcdCodes& codes_;
  WaveScopes scopes_;
  std::size_t names_ = 0;
};

}  // namespace dsdpv1::tb
