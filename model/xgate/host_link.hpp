#pragma once
// The line to the host (4.3.1, 4.7): a command comes, after a time its answer leaves, byte by byte. UART: each byte
// takes 10 bits. SPI: the host's clock fetches the answer; before it the module sends FFH (X14).
#include "model/xgate/frame.hpp"

namespace dsdpv1::xgate {

/// Hears each byte that the module sends by UART, from its start bit to the end of its stop bit.
struct ByteSink {
  void (*call)(void* self, Cycle begins, Cycle ends, std::uint8_t byte) = nullptr;
  void* self = nullptr;
};

class HostLink {
 public:
  static constexpr std::uint8_t kIdle = 0xFF;

  explicit HostLink(const Config& config) : config_(config), rate_(config.rate) {}

  void attach(const ByteSink& sink) { sink_ = sink; }
  void take_over(const HostLink& observed) { sink_ = observed.sink_; }
  void reset();

  /// UART: the stop bit of a byte has ended at `now`. False: the module does not listen, and the byte is lost (X2).
  bool receive(Cycle now, std::uint8_t byte);
  /// SPI, while NSS is low: a byte begins; the byte at MISO. It ends, or NSS rises in it, which loses it.
  std::uint8_t begin_byte();
  void end_byte(Cycle now, std::uint8_t mosi);
  void cut_byte() { fetching_ = false; }

  /// A command that is to be carried out and answered at `now`.
  bool due(Cycle now) const { return phase_ == Phase::kThinking && now >= at_; }
  const Frame& command() const { return parser_.frame(); }
  Error fault() const { return fault_; }  ///< of the command on the line
  /// The answer begins at `now`; `wire` has its bytes.
  Wire& wire() { return wire_; }
  void answer(Cycle now);
  bool answer_waits() const { return phase_ == Phase::kAnswering; }

  std::uint32_t rate() const { return rate_; }
  /// Command 03: from its answer's end and a time on (X13).
  void set_rate(std::uint32_t rate) { new_rate_ = rate; }

  void eval(Cycle now);
  Cycle next() const;

  template <class Archive>
  void store(Archive& archive) {
    auto& [config, sink, parser, phase, at, gap_ends, rate_at, rate, new_rate, fault, overflow, fetching, wire, sent] =
        *this;
    archive.given(config, sink);
    archive(parser, fault, overflow, fetching, wire);
    archive.within(Phase::kListening, Phase::kAnswering, phase);
    archive.cycles(at, gap_ends, rate_at);
    archive.within(1200U, 3'000'000U, rate);
    archive.within(0U, 3'000'000U, new_rate);
    archive.within(0, kFrameHead + kMostData, sent);
    archive.check(phase_ != Phase::kAnswering || sent_ < wire_.size);
  }

 private:
  enum class Phase : std::uint8_t { kListening, kThinking, kAnswering };

  void take(Cycle now, std::uint8_t byte);
  void complete(Cycle now, Error fault);
  void gap(Cycle now);
  void report() const;
  void finish(Cycle now);
  Cycle byte_at(int place) const;

  const Config& config_;
  ByteSink sink_;
  FrameParser parser_;
  Phase phase_ = Phase::kListening;
  Cycle at_ = 0;  ///< kThinking: of the answer; kAnswering: of its first byte
  Cycle gap_ends_ = profibus::kNever, rate_at_ = profibus::kNever;
  std::uint32_t rate_, new_rate_ = 0;
  Error fault_;
  bool overflow_ = false;  ///< a byte was lost since the last command
  bool fetching_ = false;  ///< SPI: the byte in progress is one of the answer
  Wire wire_;
  int sent_ = 0;  ///< bytes of it that have left
};

}  // namespace dsdpv1::xgate
