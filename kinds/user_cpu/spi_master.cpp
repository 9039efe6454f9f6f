#include "kinds/user_cpu/spi_master.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::user_cpu {

void SpiMaster::begin(Tick at, std::vector<std::uint8_t> out, const SpiFault& fault) {
  if (const auto bit = fault.flipped_bit; bit && *bit / 8 < out.size())
    out[*bit / 8] = static_cast<std::uint8_t>(out[*bit / 8] ^ 0x80U >> *bit % 8);
  const Tick begin = std::max(at, free_at_);
  free_at_ = begin + SpiFrame(out, timing_, fault.cut_after).duration() + timing_.gap;
  send(begin, std::move(out), fault.cut_after);
}

void PinSpiMaster::send(Tick at, std::vector<std::uint8_t> out, std::optional<std::size_t> bits) {
  begin_ = at;
  frame_ = SpiFrame(std::move(out), timing(), bits);
  edge_ = 0;
}

void PinSpiMaster::run(Tick now) {
  const SerialEdge edge = frame_[edge_++];
  if (edge.pin == dsdpv1::Pin::kMiso)
    frame_.sampled(pins_.miso(now));
  else
    pins_.set_serial(now, edge.pin, edge.level);
}

std::unique_ptr<SpiMaster> SerialPins::make_spi_master(const SpiTiming& timing) {
  return std::make_unique<PinSpiMaster>(*this, timing);
}

}  // namespace dsdpv1::user_cpu
