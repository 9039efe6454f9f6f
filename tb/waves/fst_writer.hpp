#pragma once
#include <string>
#include <vector>

#include "tb/waves/wave_writer.hpp"

namespace tb {

/// GTKWave's Fast Signal Trace, written with the fstapi library that comes with Verilator.
class FstWriter : public WaveWriter {
 public:
  explicit FstWriter(std::string path);
  ~FstWriter() override;
  FstWriter(const FstWriter&) = delete;
  FstWriter& operator=(const FstWriter&) = delete;

  void open_scope(const std::string& name) override;
  void close_scope() override;
  Signal wire(const std::string& name, int width) override;
  Signal words(const std::string& name) override;
  void set(bus::Tick at, Signal signal, int level) override;
  void say(bus::Tick at, Signal signal, std::string_view word) override;
  void finish(bus::Tick end) override;

 private:
  void move_to(bus::Tick at);

  std::string path_, part_;
  void* context_ = nullptr;
  std::vector<int> widths_;  // by handle - 1
  bus::Tick now_ = -1;
};

}  // namespace tb
