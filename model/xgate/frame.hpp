#pragma once
// A frame between host and module (tables 4.3 to 4.5): `7E CMD len special data[len] XOR`, in both directions.
#include "model/profibus/sap_buffers.hpp"
#include "model/xgate/config.hpp"
#include "model/xgate/error.hpp"

namespace dsdpv1::xgate {

constexpr int kMostData = 255, kFrameHead = 4;
constexpr std::uint8_t kFrameStart = 0x7E;
constexpr std::uint8_t kInitialise = 0x04;  ///< its errors are a separate class (table 4.11)
/// Bits of `special`: an error; an alarm was acknowledged; the segments, always 1 of 1.
constexpr std::uint8_t kErrorFlag = 0x80, kAlarmFlag = 0x40, kOneSegment = 0x11;

struct Frame {
  std::uint8_t command = 0, special = kOneSegment;
  profibus::Block<kMostData> data;

  int size() const { return data.size; }
  std::uint8_t at(int place) const { return data.bytes[static_cast<std::size_t>(place)]; }
  template <class Archive>
  void store(Archive& archive) {
    auto& [code, flags, bytes] = *this;
    archive(code, flags, bytes);
  }
};

/// The bytes of a frame on the line.
using Wire = profibus::Block<kFrameHead + kMostData + 1>;

std::uint8_t xor_of(const std::uint8_t* bytes, int size);
void compose(const Frame& frame, Wire& wire);
/// An error answer in one of the two forms (X3). `special`: kOneSegment, with kAlarmFlag if it is set.
void compose_error(std::uint8_t command, std::uint8_t special, Error error, ErrorForm form, Wire& wire);

/// Takes a frame byte by byte. Bytes before a start are skipped.
class FrameParser {
 public:
  enum class Got : std::uint8_t { kNothing, kFrame, kWrongXor };

  Got take(std::uint8_t byte);
  void drop() { place_ = Place::kStart; }
  bool open() const { return place_ != Place::kStart; }
  bool has_command() const { return place_ > Place::kCommand; }  ///< of an open frame
  /// The last frame, or the part of it that has come.
  const Frame& frame() const { return frame_; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [place, length, sum, frame] = *this;
    archive.within(Place::kStart, Place::kXor, place);
    archive(length, sum, frame);
    archive.check(place != Place::kData || frame.size() < length);
  }

 private:
  enum class Place : std::uint8_t { kStart, kCommand, kLength, kSpecial, kData, kXor };
  void add(std::uint8_t byte);

  Place place_ = Place::kStart;
  std::uint8_t length_ = 0, xor_ = 0;
  Frame frame_;
};

}  // namespace dsdpv1::xgate
