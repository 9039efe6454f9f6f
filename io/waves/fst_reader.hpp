#pragma once
// Reads FST with fstapi in a separate process. fstapi ends the program when a file is damaged, and it pushes its
// changes, while a WaveReader is asked for them.
#include <optional>

#include "io/waves/child_stream.hpp"
#include "io/waves/wave_name.hpp"
#include "io/waves/wave_reader.hpp"

namespace dsdpv1::tb {

class FstReader : public WaveReader {
 public:
  /// Reads the declarations; throws InputError.
  explicit FstReader(std::string path);

  const WaveDeclarations& declarations() const override { return declarations_; }
  void select(const std::vector<bool>& signals) override { selected_ = signals; }
  bool next(WaveEvent& event) override;
  std::uint64_t begin() const override { return begin_; }
  std::uint64_t end() const override { return now_; }
  double share() const override;

 private:
  void check_file() const;
  void read_declarations();
  bool read_entry(ChildStream& told, WaveScopes& scopes);
  void add_variable(std::uint32_t scope, const std::string& name, const WaveSignal& signal, std::uint32_t handle);
  bool normalise(const WaveSignal& declared);
  [[noreturn]] void damaged() const;

  std::string path_;
  WaveDeclarations declarations_;
  std::vector<bool> selected_;
  std::optional<ChildStream> changes_;
  std::string value_;
  std::size_t names_ = 0;  ///< bytes of them
  std::uint64_t begin_ = 0, last_ = 0, now_ = 0;
};

}  // namespace dsdpv1::tb
