#pragma once
// A user CPU's SPI controller: frames of XSS, each edge at its tick.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kinds/user_cpu/serial_pins.hpp"
#include "kinds/user_cpu/transfer.hpp"

namespace dsdpv1::user_cpu {

/// Faults to inject into a frame.
struct SpiFault {
  std::optional<std::size_t> flipped_bit;  ///< of MOSI, from 0
  std::optional<std::size_t> cut_after;    ///< bits after which XSS rises
};

class SpiMaster : public Transfer {
 public:
  /// Begins a frame, not before `at` nor before the gap has passed. Bytes cut off by a fault are received as FF.
  void begin(Tick at, std::vector<std::uint8_t> out, const SpiFault& fault = {});
  virtual const std::vector<std::uint8_t>& received() const = 0;

 protected:
  explicit SpiMaster(const SpiTiming& timing) : timing_(timing) {}
  const SpiTiming& timing() const { return timing_; }

 private:
  /// XSS falls at `at`, and rises after `bits` of the bytes, or all.
  virtual void send(Tick at, std::vector<std::uint8_t> out, std::optional<std::size_t> bits) = 0;

  SpiTiming timing_;
  Tick free_at_ = 0;
};

class PinSpiMaster : public SpiMaster {
 public:
  PinSpiMaster(SerialPins& pins, const SpiTiming& timing) : SpiMaster(timing), pins_(pins) {}

  const std::vector<std::uint8_t>& received() const override { return frame_.received(); }
  Tick next() const override { return done() ? bus::kNever : begin_ + frame_[edge_].at; }
  void run(Tick now) override;
  bool done() const override { return edge_ >= frame_.size(); }

 private:
  void send(Tick at, std::vector<std::uint8_t> out, std::optional<std::size_t> bits) override;

  SerialPins& pins_;
  SpiFrame frame_;
  std::size_t edge_ = 0;  ///< the next
  Tick begin_ = 0;
};

}  // namespace dsdpv1::user_cpu
