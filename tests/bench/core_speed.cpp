// How fast the core runs at a saturated 12 Mbit/s bus: data exchanges of one size, back to back at T_SYN, without any
// bench round it. The edges of the requests are made beforehand, so that only the core is measured. counters:
// x_real_time = simulated time / CPU time.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "model/dpram/crc16.hpp"
#include "model/dsdpv1/chip.hpp"
#include "tests/conformance/slave_bench.hpp"

namespace {

using conformance::Bytes;
using dsdpv1::Chip;
using dsdpv1::Pin;
using profibus::Tick;

constexpr Tick kBit = 1000;  // 12 Mbit/s

struct Edge {
  Tick at;
  bool level;
};

// The line's changes for one telegram that starts at 0, and its length.
std::vector<Edge> edges_of(const Bytes& bytes, Tick& length) {
  std::vector<Edge> edges;
  bool level = true;
  Tick at = 0;
  for (const bus::Character& character : bus::characters(bytes)) {
    for (int i = 0; i < bus::kCharacterBits; ++i, at += kBit) {
      const bool bit = ((character.bits >> i) & 1) != 0;
      if (bit != level) edges.push_back({at, bit});
      level = bit;
    }
  }
  length = at;
  return edges;
}

class Slave {
 public:
  explicit Slave(int io) {
    chip_.set(10 * 250, Pin::kReset, 1);
    chip_.advance(now_);
    conformance::Init init;
    init.cfg = identifiers(io);
    const Bytes block = init.block();
    for (std::size_t i = 0; i < block.size(); ++i) poke(dsdpv1::regs::kInit + i, block[i]);
    const unsigned crc = dpram::crc16(block.data(), static_cast<int>(block.size()));
    poke(dsdpv1::regs::kInitCrc, static_cast<std::uint8_t>(crc >> 8));
    poke(dsdpv1::regs::kInitCrc + 1, static_cast<std::uint8_t>(crc & 0xFF));
    poke(dsdpv1::regs::kUserCommand1, dsdpv1::regs::kUserCommand1Init);
    wait(1'000'000);
    for (const Bytes& request : {bus::encode(bus::make_telegram(100, 2, 0x49)),
                                 bus::encode(bus::make_telegram(5, 2, 0x6D, conformance::Prm().bytes(), 61, 62)),
                                 bus::encode(bus::make_telegram(5, 2, 0x5D, init.cfg, 62, 62))})
      send(edges_of(request, length_), 100);
    for (const std::uint8_t fc : {std::uint8_t{0x5D}, std::uint8_t{0x7D}}) {
      exchange_.push_back(
          edges_of(bus::encode(bus::make_telegram(5, 2, fc, Bytes(static_cast<std::size_t>(io), 0x5A))), length_));
    }
    answer_bits_ = 11 + 11 * (io + 9);
  }

  void exchange() { send(exchange_[toggle_ ^= 1], answer_bits_ + 34); }
  Tick now() const { return now_; }
  std::uint64_t exchanges() const { return chip_.status().data_exchanges; }

 private:
  static Bytes identifiers(int io) {
    Bytes cfg;
    for (int left = io; left > 0; left -= 16) cfg.push_back(static_cast<std::uint8_t>(0x30 | (std::min(left, 16) - 1)));
    return cfg;
  }
  void poke(std::size_t address, std::uint8_t value) { chip_.poke(static_cast<std::uint16_t>(address), value); }
  void wait(Tick ticks) { chip_.advance(now_ += ticks); }
  void send(const std::vector<Edge>& edges, int idle_bits) {
    for (const Edge& edge : edges) chip_.set(now_ + edge.at, Pin::kPbrxd, edge.level ? 1 : 0);
    wait(length_ + idle_bits * kBit);
  }

  Chip chip_;
  Tick now_ = 6000 * 250, length_ = 0;
  int answer_bits_ = 0;
  unsigned toggle_ = 0;
  std::vector<std::vector<Edge>> exchange_;
};

void saturated_bus(benchmark::State& state) {
  Slave slave(static_cast<int>(state.range(0)));
  const Tick begin = slave.now();
  const std::uint64_t before = slave.exchanges();
  while (state.KeepRunning()) slave.exchange();
  if (slave.exchanges() - before != static_cast<std::uint64_t>(state.iterations()))
    state.SkipWithError("exchanges were lost");
  state.counters["x_real_time"] =
      benchmark::Counter(static_cast<double>(slave.now() - begin) / 12e9, benchmark::Counter::kIsRate);
}
BENCHMARK(saturated_bus)->Arg(2)->Arg(16)->Arg(64)->Arg(244);

}  // namespace

BENCHMARK_MAIN();
