#pragma once
// A wave with both sides, one below the other, and for each signal a second one that is 1 while they differ.
#include <memory>

#include "io/waves/wave_writer.hpp"
#include "lab/compare/pairs.hpp"

namespace dsdpv1::tb::compare {

class BothWave {
 public:
  /// Scopes a, b and differs, in each the signals by A's names; `differs.any` marks all. Throws InputError.
  BothWave(const std::string& path, const std::vector<Pair>& pairs);
  void set(const Scale& scale, Time time, std::uint32_t pair, std::string_view a, std::string_view b, bool differs);
  /// Gives the file its name.
  void finish(const Scale& scale, Time end);

 private:
  struct Signals {
    WaveWriter::Signal a = 0, b = 0, differs = 0;
    bool text = false, known = false, different = false;
    std::string a_value, b_value;
  };
  void write(Picoseconds at, WaveWriter::Signal signal, bool text, std::string_view value);

  std::unique_ptr<WaveWriter> writer_;
  std::vector<Signals> signals_;
  WaveWriter::Signal any_ = 0;
  std::size_t different_ = 0;
  bool begun_ = false;
};

}  // namespace dsdpv1::tb::compare
