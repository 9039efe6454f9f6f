#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/output/output_file.hpp"
#include "io/waves/wave_writer.hpp"

namespace dsdpv1::tb {

/// Value Change Dump, IEEE 1364-2005 clause 18. Words use the `string` extension that GTKWave and Surfer read.
class VcdWriter : public WaveWriter {
 public:
  VcdWriter(const std::string& path, const std::string& date);

  void open_scope(const std::string& name) override;
  void close_scope() override;
  Signal wire(const std::string& name, int width) override;
  Signal words(const std::string& name) override;
  void alias(const std::string& name, Signal of) override;
  void set(bus::Tick at, Signal signal, int level) override;
  void say(bus::Tick at, Signal signal, std::string_view word) override;
  void save(bus::Tick /*at*/) override { file_.flush(); }
  bool failed() const override { return file_.failed(); }
  void check() const override { file_.check(); }
  void finish(bus::Tick end) override;
  void set(Picoseconds at, Signal signal, std::string_view levels) override;
  void say(Picoseconds at, Signal signal, std::string_view word) override;
  void finish(Picoseconds end) override;

 private:
  Signal add(const std::string& name, int width);
  void declare(const std::string& name, Signal signal);
  void move_to(Picoseconds at);
  Picoseconds in_order(bus::Tick at);

  OutputFile file_;
  static constexpr int kWords = 0;  ///< instead of a width
  std::vector<int> widths_;
  std::vector<std::string> names_;  ///< in the file
  bus::Tick now_ = 0;
  std::optional<std::uint64_t> time_;  ///< the last in the file; nullopt: still declaring
};

}  // namespace dsdpv1::tb
