#include "kinds/dsdpv1/user_cpu/acyclic_server.hpp"

#include <algorithm>
#include <utility>

extern "C" {
#include "driver/dsdpv1_acyclic_internal.h"
}

namespace dsdpv1::user_cpu {

static_assert(kMayRead == DSDPV1_MAY_READ && kMayWrite == DSDPV1_MAY_WRITE && kMayTransport == DSDPV1_MAY_TRANSPORT);
static_assert(kClass1 == DSDPV1_CLASS_1 && kClass2 == DSDPV1_CLASS_2 && kBothClasses == DSDPV1_CLASS_BOTH);
static_assert(kInvalidParameter == DSDPV1_EC_INVALID_PARAMETER);

AcyclicServer::AcyclicServer(AcyclicOptions options) : options_(std::move(options)) { fill_table(); }

void AcyclicServer::fill_table() {
  for (AcyclicObject& object : options_.objects) entries_.push_back({this, &object});
  for (Entry& entry : entries_) {
    const AcyclicObject& object = *entry.object;
    dsdpv1_object line{};
    line.slot = object.slot;
    line.index = object.index;
    line.services = object.services;
    line.classes = object.classes;
    line.min_length = object.min_length;
    line.max_length = static_cast<std::uint8_t>(object.data.size());
    line.read = line.write = line.transport = &AcyclicServer::handle;
    line.ctx = &entry;
    table_.push_back(line);
  }
  if (options_.im0) fill_im0(*options_.im0);
}

void AcyclicServer::fill_im0(const Nameplate& nameplate) {
  im0_.manufacturer_id = nameplate.manufacturer_id;
  im0_.order_id = nameplate.order_id.c_str();
  im0_.serial_number = nameplate.serial_number.c_str();
  im0_.hardware_revision = nameplate.hardware_revision;
  im0_.software_type = 'V';
  std::copy_n(nameplate.software_revision.begin(), 3, im0_.software_revision);
  im0_.profile_id = nameplate.profile_id;
  im0_.version_major = im0_.version_minor = 1;
}

dsdpv1_error AcyclicServer::open(dsdpv1_device& device) {
  const dsdpv1_table table = {table_.data(), table_.size(), options_.im0 ? &im0_ : nullptr};
  return dsdpv1_acyclic_open(&acyclic_, &device, &table);
}

dsdpv1_error AcyclicServer::poll(Tick now) {
  now_ = now;
  const dsdpv1_error late = answer_due(now);
  dsdpv1_acyclic_result result{};
  const dsdpv1_error polled = dsdpv1_acyclic_poll(&acyclic_, &result);
  count(result);
  return late == DSDPV1_OK ? polled : late;
}

/// By the driver's table alone: no device is open.
std::optional<std::vector<std::uint8_t>> AcyclicServer::answer(unsigned master_class,
                                                               const std::vector<std::uint8_t>& pdu) {
  dsdpv1_channel& channel = acyclic_.channels[master_class - 1];
  acyclic_.table = {table_.data(), table_.size(), options_.im0 ? &im0_ : nullptr};
  std::copy_n(pdu.begin(), kAcyclicHeader, channel.request);
  std::copy(pdu.begin() + kAcyclicHeader, pdu.end(), channel.data);
  channel.state = DSDPV1_CHANNEL_OPEN;
  dsdpv1_dispatch(&acyclic_, master_class - 1);
  if (std::exchange(channel.state, DSDPV1_CHANNEL_IDLE) != DSDPV1_CHANNEL_READY) return std::nullopt;
  std::vector<std::uint8_t> bytes(channel.answer, channel.answer + kAcyclicHeader);
  bytes.insert(bytes.end(), channel.data, channel.data + channel.answer_length);
  return bytes;
}

void AcyclicServer::count(const dsdpv1_acyclic_result& result) {
  const auto areas = [](std::uint8_t bits) {
    return static_cast<std::uint64_t>((bits & DSDPV1_CLASS_1) != 0) + ((bits & DSDPV1_CLASS_2) != 0 ? 1 : 0);
  };
  counters_.requests += areas(result.received);
  counters_.answers += areas(result.answered);
  counters_.refusals += areas(result.refused);
  counters_.repeated += areas(result.repeated);
  counters_.dropped += areas(result.dropped);
}

// --- answers ---------------------------------------------------------------------------------------------------------

dsdpv1_outcome AcyclicServer::handle(void* ctx, const dsdpv1_request* request, dsdpv1_reply* reply) {
  const Entry& entry = *static_cast<const Entry*>(ctx);
  return entry.server->serve(*entry.object, *request, *reply);
}

dsdpv1_outcome AcyclicServer::serve(AcyclicObject& object, const dsdpv1_request& request, dsdpv1_reply& reply) {
  if (options_.answering == Answering::kNever) return DSDPV1_DEFERRED;
  reply.error_code_1 = options_.error_code_1;
  reply.error_code_2 = options_.error_code_2;
  const bool refuse = options_.answering == Answering::kRefuse;
  std::vector<std::uint8_t> data;
  if (!refuse) {
    if (request.function != DSDPV1_DS_WRITE) data = object.data;
    if (request.function != DSDPV1_DS_READ) std::copy_n(request.data, request.length, object.data.begin());
    if (request.function == DSDPV1_DS_READ) data.resize(std::min<std::size_t>(data.size(), request.length));
  }
  if (options_.delay > 0) {
    later_.push_back({now_ + options_.delay, request.ticket, refuse, std::move(data)});
    return DSDPV1_DEFERRED;
  }
  std::copy(data.begin(), data.end(), reply.data);
  reply.length = static_cast<std::uint8_t>(data.size());
  return refuse ? DSDPV1_FAILED : DSDPV1_DONE;
}

dsdpv1_error AcyclicServer::answer_due(Tick now) {
  dsdpv1_error first = DSDPV1_OK;
  while (!later_.empty() && later_.front().due <= now) {
    const Later answer = std::move(later_.front());
    later_.pop_front();
    const dsdpv1_error error =
        answer.refuse ? dsdpv1_acyclic_refuse(&acyclic_, answer.ticket, options_.error_code_1, options_.error_code_2)
                      : dsdpv1_acyclic_answer(&acyclic_, answer.ticket, answer.data.data(),
                                              static_cast<std::uint8_t>(answer.data.size()));
    if (error == DSDPV1_OK) {
      ++counters_.answers;
      counters_.refusals += answer.refuse ? 1 : 0;
    } else if (first == DSDPV1_OK) {
      first = error;
    }
  }
  return first;
}

}  // namespace dsdpv1::user_cpu
