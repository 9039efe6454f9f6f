#pragma once
// UART's exchange (UA7 to UA14; docs/microarchitecture_rsu.md 6.4): writes a block of the host to its area and returns
// one area of the chip.
#include <array>

#include "model/dpram/ram.hpp"
#include "model/dsdpv1/host_telegram.hpp"

namespace dsdpv1 {

class Exchange {
 public:
  Exchange(dpram::Ram& ram, bool cfg_length) : ram_(ram), cfg_length_(cfg_length) {}

  void start(const Request& request, const std::uint8_t* data);
  /// Makes move `index`, from 0; `data_exch` as before the cycle. Returns true with the last one.
  bool move(int index, bool data_exch);

  // The reply, after the last move.
  std::uint8_t function() const { return function_; }
  std::uint16_t address() const { return area_->address; }
  const std::uint8_t* data() const { return data_.data(); }
  int size() const { return header_ + rest_; }
  /// The reply's length byte (UA12).
  std::uint8_t length_byte() const;

  /// `block`: the block passed to start().
  template <class Archive>
  void store(Archive& archive, const std::uint8_t* block) {
    auto& [ram, cfg_length, to, sent, from, flags, chip_command1, chip_command2, area, function, header, rest, data] =
        *this;
    archive.given(ram, cfg_length);
    archive(to, flags, chip_command1, chip_command2, function, data);
    archive.within(0, 0xFF, sent);
    archive.within(0, kMostHeader, header);
    archive.within(0, kMostRest, rest);
    archive.place(area, kAreas, kAreaCount - 1);
    if constexpr (Archive::kReads) from = block;
  }
  /// Move `index` can follow from start() and the moves before it.
  bool is_possible(int index) const;

 private:
  /// An area that a reply may return.
  struct Area {
    std::uint16_t address;
    int header;             ///< bytes up to and including the length
    int most;               ///< largest length
    std::uint8_t function;  ///< bit of the reply's function
    std::uint8_t flag;      ///< bit of B00E or B00F
    bool second;            ///< B00F
  };
  static constexpr int kAreaCount = 5, kMostHeader = 4, kMostRest = 245;
  static const Area kAreas[kAreaCount];

  bool move_reply(int index, bool data_exch);
  void choose(bool data_exch);
  void take_length();
  bool clears() const;
  void clear();

  dpram::Ram& ram_;
  const bool cfg_length_;
  std::uint16_t to_ = 0;  // destination of the host's block
  int sent_ = 0;          // its bytes
  const std::uint8_t* block_ = nullptr;
  std::uint8_t flags_ = 0, chip_command1_ = 0, chip_command2_ = 0;
  const Area* area_ = nullptr;
  std::uint8_t function_ = 0;
  int header_ = 0, rest_ = 0;
  std::array<std::uint8_t, 256> data_{};
};

}  // namespace dsdpv1
