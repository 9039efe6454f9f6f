#pragma once
#include <string>
#include <vector>

#include "io/waves/fst_file.hpp"
#include "io/waves/wave_writer.hpp"

namespace dsdpv1::tb {

/// GTKWave's Fast Signal Trace, written with the fstapi library that comes with Verilator.
class FstWriter : public WaveWriter {
 public:
  FstWriter(const std::string& path, const std::string& date) : file_(path, date) {}

  void open_scope(const std::string& name) override { file_.open_scope(name); }
  void close_scope() override { file_.close_scope(); }
  Signal wire(const std::string& name, int width) override;
  Signal words(const std::string& name) override;
  void alias(const std::string& name, Signal of) override;
  void set(bus::Tick at, Signal signal, int level) override;
  void say(bus::Tick at, Signal signal, std::string_view word) override;
  void save(bus::Tick at) override;
  bool failed() const override { return file_.failed(); }
  void check() const override { file_.check(); }
  void finish(bus::Tick end) override;
  void set(Picoseconds at, Signal signal, std::string_view levels) override;
  void say(Picoseconds at, Signal signal, std::string_view word) override;
  void finish(Picoseconds end) override;

 private:
  void move_to(bus::Tick at);

  FstFile file_;
  std::vector<int> widths_;  // by handle - 1
  bus::Tick now_ = -1;       ///< time of the last change or save
  bus::Tick moved_to_ = -1;  ///< time in the file
};

}  // namespace dsdpv1::tb
