#include "model/profibus/request.hpp"

#include <cstring>

#include "model/profibus/telegram_rx.hpp"

namespace dsdpv1::profibus {
namespace {

void put(Frame& frame, unsigned byte) {
  frame.bytes[static_cast<std::size_t>(frame.size++)] = static_cast<std::uint8_t>(byte);
}

void put_end(Frame& frame, int body) {
  unsigned fcs = 0;
  for (int i = body; i < frame.size; ++i) fcs += frame.bytes[static_cast<std::size_t>(i)];
  put(frame, fcs & 0xFF);
  put(frame, sd::kEd);
}

void build_sd1(const Request& request, std::uint8_t code, std::uint8_t address, Frame& frame) {
  put(frame, sd::kSd1);
  put(frame, request.sa);
  put(frame, address);
  put(frame, code);
  put_end(frame, 1);
}

void build_sd2(const Request& request, const Reply& reply, std::uint8_t address, Frame& frame) {
  const bool to_sap = request.ssap != kNoSap, from_sap = to_sap && request.dsap != kNoSap;  // S21
  const unsigned le = static_cast<unsigned>(reply.size) + 3U + (to_sap ? 1U : 0U) + (from_sap ? 1U : 0U);
  put(frame, sd::kSd2);
  put(frame, le);
  put(frame, le);
  put(frame, sd::kSd2);
  put(frame, request.sa | (to_sap ? kSapBit : 0U));
  put(frame, address | (from_sap ? kSapBit : 0U));
  put(frame, reply.code);
  if (to_sap) put(frame, static_cast<unsigned>(request.ssap));
  if (from_sap) put(frame, static_cast<unsigned>(request.dsap));
  std::memcpy(&frame.bytes[static_cast<std::size_t>(frame.size)], reply.data, static_cast<std::size_t>(reply.size));
  frame.size += reply.size;
  put_end(frame, 4);
}

}  // namespace

void build_frame(const Request& request, const Reply& reply, std::uint8_t address, Frame& frame) {
  frame.size = 0;
  switch (reply.kind) {
    case Reply::Kind::kNothing: return;
    case Reply::Kind::kShort: return put(frame, sd::kSc);
    case Reply::Kind::kSd1: return build_sd1(request, reply.code, address, frame);
    case Reply::Kind::kData: return build_sd2(request, reply, address, frame);
  }
}

}  // namespace dsdpv1::profibus
