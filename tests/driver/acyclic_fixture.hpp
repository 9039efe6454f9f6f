#pragma once
#include <optional>
#include <tuple>

#include "driver/dsdpv1_acyclic.h"
#include "tests/driver/driver_fixture.hpp"

namespace dsdpv1 {

/// A device with a table: slot 1 is plain data, slot 2 calls the test. Requests and answers are bytes as in the DPRAM.
class AcyclicTest : public DriverTest {
 protected:
  void SetUp() override {
    DriverTest::SetUp();
    config.dpv1 = true;
    objects = {
        data_object({1, 1}, DSDPV1_MAY_READ | DSDPV1_MAY_WRITE, DSDPV1_CLASS_BOTH, {1, 4}, parameter.data()),
        data_object({1, 2}, DSDPV1_MAY_READ, DSDPV1_CLASS_BOTH, {0, 4}, parameter.data()),
        data_object({1, 3}, DSDPV1_MAY_WRITE, DSDPV1_CLASS_BOTH, {2, 3}, parameter.data()),
        data_object({1, 4}, DSDPV1_MAY_READ | DSDPV1_MAY_WRITE, DSDPV1_CLASS_2, {0, 4}, parameter.data()),
        data_object({1, 5}, DSDPV1_MAY_READ | DSDPV1_MAY_WRITE, DSDPV1_CLASS_BOTH, {0, 240}, largest.data()),
        handled_object({2, 1}),
        handled_object({2, 2}),
    };
  }

  using Two = std::pair<std::uint8_t, std::uint8_t>;
  /// `place`: slot and index; `lengths`: least and largest.
  static dsdpv1_object data_object(Two place, unsigned services, unsigned classes, Two lengths, std::uint8_t* data) {
    dsdpv1_object object{};
    std::tie(object.slot, object.index) = place;
    std::tie(object.min_length, object.max_length) = lengths;
    object.services = static_cast<std::uint8_t>(services);
    object.classes = static_cast<std::uint8_t>(classes);
    object.data = data;
    return object;
  }

  dsdpv1_object handled_object(Two place) {
    dsdpv1_object object = data_object(place, DSDPV1_MAY_READ | DSDPV1_MAY_WRITE | DSDPV1_MAY_TRANSPORT,
                                       DSDPV1_CLASS_BOTH, {0, 240}, nullptr);
    object.read = object.write = object.transport = [](void* ctx, const dsdpv1_request* request, dsdpv1_reply* reply) {
      return static_cast<AcyclicTest*>(ctx)->handle(*request, *reply);
    };
    object.ctx = this;
    return object;
  }

  dsdpv1_outcome handle(const dsdpv1_request& request, dsdpv1_reply& reply) {
    seen = request;
    seen_data = request.function == DSDPV1_DS_READ ? Bytes{} : Bytes(request.data, request.data + request.length);
    if (while_handling) while_handling();
    if (codes) {
      reply.error_code_1 = codes->first;
      reply.error_code_2 = codes->second;
    }
    std::copy(reply_data.begin(), reply_data.end(), reply.data);
    reply.length = reply_length.value_or(static_cast<std::uint8_t>(reply_data.size()));
    return outcome;
  }

  void open() {
    table.objects = objects.data();
    table.count = objects.size();
    ASSERT_EQ(dsdpv1_acyclic_open(&acyclic, &device, &table), DSDPV1_OK);
    initialise();
  }

  /// One request and one poll; the bytes of the answer, empty when there is none.
  Bytes ask(int master_class, const Bytes& request) {
    chip.answers[master_class - 1].clear();
    chip.put_request(master_class, request);
    EXPECT_EQ(poll(), DSDPV1_OK);
    return chip.answers[master_class - 1];
  }

  /// Has the handler defer a request; its ticket.
  std::uint16_t defer(int master_class, const Bytes& request) {
    outcome = DSDPV1_DEFERRED;
    EXPECT_THAT(ask(master_class, request), testing::IsEmpty());
    EXPECT_NE(done.open & master_class, 0);
    return seen.ticket;
  }

  dsdpv1_error poll() { return dsdpv1_acyclic_poll(&acyclic, &done); }
  dsdpv1_error answer(std::uint16_t ticket, const Bytes& data) {
    return dsdpv1_acyclic_answer(&acyclic, ticket, data.data(), static_cast<std::uint8_t>(data.size()));
  }
  const Bytes& last_answer(int master_class) const { return chip.answers[master_class - 1]; }
  static Bytes with_data(Bytes header, const Bytes& data) {
    header.insert(header.end(), data.begin(), data.end());
    return header;
  }

  Bytes parameter = {0x11, 0x22, 0x33, 0x44};
  Bytes largest = Bytes(240, 0x5A);
  std::vector<dsdpv1_object> objects;
  dsdpv1_table table{};
  dsdpv1_acyclic acyclic{};
  dsdpv1_acyclic_result done{};

  dsdpv1_outcome outcome = DSDPV1_DONE;
  Bytes reply_data;
  std::optional<std::uint8_t> reply_length;
  std::optional<std::pair<std::uint8_t, std::uint8_t>> codes;
  std::function<void()> while_handling;
  dsdpv1_request seen{};
  Bytes seen_data;
};

/// The same for each class of masters: INSTANTIATE_TEST_SUITE_P with 1 and 2.
class AcyclicTestOfEachClass : public AcyclicTest, public testing::WithParamInterface<int> {
 protected:
  int cls() const { return GetParam(); }
  std::uint16_t area(int offset) const { return static_cast<std::uint16_t>((cls() == 1 ? 0x5D0 : 0x6D0) + offset); }
  void spoil_crc() { chip.at(area(0xF5)) = static_cast<std::uint8_t>(chip.at(area(0xF5)) ^ 1); }
};

}  // namespace dsdpv1
