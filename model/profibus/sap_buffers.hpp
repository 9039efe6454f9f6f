#pragma once
// The fixed buffers of figure 8, as large as the protocol allows. Outputs and inputs are double: buffer 1 has the
// latest data of the other side, buffer 2 the data passed on (ruling S4: the user and Read_Outputs see output 2, the
// master and Read_Inputs see input 2).
#include <array>
#include <cstdint>
#include <cstring>

namespace dsdpv1::profibus {

/// Maximum data of a telegram: 244 bytes after the SAP bytes, less those that each service puts before the user's. A
/// chip may hold less (Capacities).
constexpr int kMaxIo = 244, kMaxCfg = 244, kMaxUserPrm = 244 - 7, kMaxDiag = 244 - 6, kMaxAcyclic = 244 - 4;

/// A buffer of fixed size with the number of bytes in use.
template <int N>
struct Block {
  std::array<std::uint8_t, N> bytes{};
  int size = 0;

  void assign(const std::uint8_t* from, int count) {
    std::memcpy(bytes.data(), from, static_cast<std::size_t>(count));
    size = count;
  }
  void clear(int count) {
    bytes.fill(0);
    size = count;
  }
  bool equals(const std::uint8_t* other, int count) const {
    return size == count && std::memcmp(bytes.data(), other, static_cast<std::size_t>(count)) == 0;
  }
  template <class Archive>
  void store(Archive& archive) {
    auto& [all, used] = *this;
    archive(all);
    archive.within(0, N, used);
  }
};

using IoBlock = Block<kMaxIo>;
using Pdu = Block<kMaxAcyclic + 4>;  ///< of C1 or C2: Function_Num, slot, index, length, data (7.2)

/// Two buffers with the gate between them that Sync and Freeze close.
class DoubleBuffer {
 public:
  void reset(int size) {
    first_.clear(size);
    second_.clear(size);
    held_ = false;
  }
  void write(const std::uint8_t* bytes) {
    first_.assign(bytes, first_.size);
    if (!held_) second_ = first_;
  }
  void clear() {
    first_.clear(first_.size);
    second_.clear(second_.size);
  }
  void pass() { second_ = first_; }
  void hold() { held_ = true; }
  void release() {
    held_ = false;
    pass();
  }
  bool held() const { return held_; }
  int size() const { return first_.size; }
  const IoBlock& shown() const { return second_; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [first, second, held] = *this;
    archive(first, second, held);
  }

 private:
  IoBlock first_, second_;
  bool held_ = false;
};

}  // namespace dsdpv1::profibus
