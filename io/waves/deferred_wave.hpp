#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/waves/wave_writer.hpp"

namespace dsdpv1::tb {

/// A wave whose file is opened late: it keeps the declarations until then. Changes come afterwards only.
class DeferredWave : public WaveWriter {
 public:
  DeferredWave(std::string path, std::string date) : path_(std::move(path)), date_(std::move(date)) {}
  /// Throws InputError, as open_wave does.
  void open();

  void open_scope(const std::string& name) override {
    declare([name](WaveWriter& writer) { writer.open_scope(name); });
  }
  void close_scope() override {
    declare([](WaveWriter& writer) { writer.close_scope(); });
  }
  Signal wire(const std::string& name, int width) override;
  Signal words(const std::string& name) override;
  void alias(const std::string& name, Signal of) override {
    declare([this, name, of](WaveWriter& writer) { writer.alias(name, signals_.at(of)); });
  }
  void set(bus::Tick at, Signal signal, int level) override { writer_->set(at, signals_[signal], level); }
  void say(bus::Tick at, Signal signal, std::string_view word) override { writer_->say(at, signals_[signal], word); }
  void set(Picoseconds at, Signal signal, std::string_view levels) override {
    writer_->set(at, signals_[signal], levels);
  }
  void say(Picoseconds at, Signal signal, std::string_view word) override { writer_->say(at, signals_[signal], word); }
  void finish(Picoseconds end) override { writer_->finish(end); }
  void save(bus::Tick at) override { writer_->save(at); }
  bool failed() const override { return writer_ != nullptr && writer_->failed(); }
  void check() const override {
    if (writer_ != nullptr) writer_->check();
  }
  void finish(bus::Tick end) override { writer_->finish(end); }

 private:
  void declare(std::function<void(WaveWriter&)> declaration) { declarations_.push_back(std::move(declaration)); }

  std::string path_, date_;
  std::vector<std::function<void(WaveWriter&)>> declarations_;
  Signal declared_ = 0;
  std::vector<Signal> signals_;  ///< the writer's, by signal of this class
  std::unique_ptr<WaveWriter> writer_;
};

}  // namespace dsdpv1::tb
