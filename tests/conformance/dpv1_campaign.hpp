#pragma once
// Random acyclic operations on C1 and both C2 channels beside the cyclic exchange: every answer is that of its request,
// nothing is lost, doubled or mixed up, whatever the user's delays, wrong answers and the masters' aborts are.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <optional>
#include <random>

#include "tests/conformance/dpv1_side.hpp"

namespace dsdpv1::conformance {
/// A master with one way to the slave: C1 from the holder, or a C2 channel.
struct Client {
  std::uint8_t master = 0;
  bool c1 = false;
  int sap = 0;        ///< 0: not connected
  bool busy = false;  ///< a request is open
  bool with_user = false;
  bool answered = false;  ///< the user's answer is in the chip
  Bytes request, answer;
  int done = 0, aborted = 0;
};

class Campaign : public Dpv1Test {
 protected:
  void play(unsigned seed, Engines engines, int operations) {
    random_.seed(seed);
    world_.emplace(quick_search(), engines);
    start_world();
    for (int i = 0; finished() < operations && !HasFailure(); ++i) act();
    std::size_t refused_by_user_side = 0;
    for (const profibus::Event& event : world_->chip.events())
      refused_by_user_side += event.reason == Reason::kAcyclicAnswerDiffers || event.reason == dpram::Reason::kC1Crc ||
                                      event.reason == dpram::Reason::kC2Crc
                                  ? 1U
                                  : 0U;
    EXPECT_EQ(refused_by_user_side, wrong_answers_);
    for (const Client& client : clients_) {
      EXPECT_GT(client.done, operations / 10);
      EXPECT_EQ(client.aborted > 0, !client.c1);
    }
    EXPECT_GT(exchanges_, operations / 2);
    EXPECT_EQ(world_->chip.status().data_exchanges, static_cast<unsigned>(exchanges_));
  }

 private:
  SlaveBench& world() { return *world_; }
  int below(int limit) { return static_cast<int>(random_() % static_cast<unsigned>(limit)); }
  int finished() const { return clients_[0].done + clients_[1].done + clients_[2].done; }

  void start_world() {
    world().power_on();
    world().enable_dpv1(true);
    ASSERT_TRUE(world().initialise());
    world().find_baud(0);
    Prm prm;
    prm.user = {0x80, 0, 0};
    ASSERT_TRUE(is_sc(world().set_prm(prm)));
    ASSERT_TRUE(is_sc(world().check_cfg()));
    clients_[0].c1 = true;
    clients_[0].master = 2;
    clients_[0].sap = kC1Sap;
    clients_[1].master = 1;
    clients_[2].master = 9;
  }

  Exchange send(const Client& client, int sap, const Bytes& pdu) {
    return send_fc(world(), kSrdFirst, sap, client.c1 ? kC1Sap : kC2Ssap, pdu, client.master);
  }

  void act() {
    const int what = below(100);
    if (what < 15) return exchange();
    if (what < 75) return client(clients_.at(static_cast<std::size_t>(below(3))));
    if (what < 99) return user(below(2) == 0);
    world().run_cycles(below(20'000));
  }

  void exchange() {
    const Bytes outputs = {static_cast<std::uint8_t>(exchanges_), static_cast<std::uint8_t>(exchanges_ >> 8)};
    const Exchange answer = ask(world(), kNoSap, outputs);
    ASSERT_TRUE(is_data(answer)) << kind_of(answer);
    ++exchanges_;
  }

  void client(Client& client) {
    if (client.sap == 0) return connect_client(client);
    if (!client.busy) return request(client);
    if (!client.c1 && below(40) == 0) return abort(client);
    poll(client);
  }

  void connect_client(Client& client) {
    const Exchange immediate = send(client, kManagerSap, initiate_pdu());
    ASSERT_TRUE(is_data(immediate)) << kind_of(immediate);
    client.sap = immediate.answer().data.at(1);
    ASSERT_TRUE(is_data(send(client, client.sap, {})));
  }

  void request(Client& client) {
    ++serial_;  // slot and index tell the requests apart
    const int functions = client.c1 ? 2 : 3;
    constexpr int kFunctions[] = {0x5E, 0x5F, 0x51};
    const int function = kFunctions[below(functions)], length = below(4) == 0 ? below(241) : below(12);
    Bytes pdu = pdu_of(function, serial_ >> 8 & 0xFF, serial_ & 0xFF, length);
    for (int i = 0; function != 0x5E && i < length; ++i) pdu.push_back(static_cast<std::uint8_t>(random_()));
    ASSERT_TRUE(is_sc(send(client, client.sap, pdu)));
    client.busy = true;
    client.with_user = client.answered = false;
    client.request = pdu;
  }

  void poll(Client& client) {
    const Exchange exchange = send(client, client.sap, {});
    if (!client.answered) {
      ASSERT_TRUE(is_sc(exchange)) << kind_of(exchange);
      return;
    }
    ASSERT_TRUE(is_data(exchange)) << kind_of(exchange);
    ASSERT_EQ(exchange.answer().data, client.answer);
    client.busy = client.answered = false;
    ++client.done;
  }

  void abort(Client& client) {
    ASSERT_TRUE(is_sc(send(client, client.sap, {0x58, 0, 0x20, 0})));
    client.busy = client.answered = client.with_user = false;
    client.sap = 0;
    ++client.aborted;
  }

  /// The user looks at one of the areas: takes a request, or answers the one it has.
  void user(bool c1) {
    const Area& area = c1 ? kC1Area : kC2Area;
    std::optional<Bytes>& open = c1 ? open_[0] : open_[1];
    if (const Bytes pdu = fetch(area); !pdu.empty()) {
      open = pdu;
      if (Client* owner = owner_of(pdu, c1)) owner->with_user = true;
      return;
    }
    if (!open || below(2) == 0) return;
    answer(area, *open, owner_of(*open, c1));
  }

  Client* owner_of(const Bytes& pdu, bool c1) {
    Client* found = nullptr;
    for (Client& client : clients_) {
      if (client.c1 != c1 || !client.busy || client.answered || client.request != pdu) continue;
      EXPECT_EQ(found, nullptr);
      found = &client;
    }
    return found;
  }

  void answer(const Area& area, const Bytes& request, Client* owner) {
    Bytes pdu = answer_to(request);
    if (owner != nullptr && below(10) == 0) {
      const bool crc = below(2) == 0;
      const bool given = give(area, crc ? pdu : wrong(pdu), static_cast<std::uint16_t>(crc ? 1 + below(0xFFFF) : 0));
      EXPECT_TRUE(given) << "the master is waiting for this one";
      ++wrong_answers_;
      return;
    }
    const bool given = give(area, pdu);
    open_.at(area.flag - 1U).reset();
    if (owner == nullptr) return;  // aborted meanwhile: dropped here, or refused by the chip
    EXPECT_TRUE(given);
    owner->answered = true;
    owner->answer = pdu;
  }

  Bytes wrong(Bytes pdu) {
    pdu[0] ^= 0x01;  // 5E and 5F exchanged, 51 unknown
    if ((pdu[0] & 0x80) == 0 && pdu[0] == 0x5F) pdu.resize(4);
    if (pdu[0] == 0x5E) pdu[3] = 0;
    if (pdu[0] == 0x5E) pdu.resize(4);
    return pdu;
  }

  Bytes answer_to(const Bytes& request) {
    const int function = request[0];
    if (below(8) == 0) return pdu_of(function | 0x80, 0x80, 0xB0 | below(10), below(256));
    Bytes pdu(request.begin(), request.begin() + 4);
    if (function == 0x5F) return pdu;
    pdu[3] = static_cast<std::uint8_t>(below(request[3] + 1));
    for (int i = 0; i < pdu[3]; ++i) pdu.push_back(static_cast<std::uint8_t>(random_()));
    return pdu;
  }

  Bytes fetch(const Area& area) { return Dpv1Test::fetch(world(), area); }
  bool give(const Area& area, const Bytes& pdu, std::uint16_t crc_error = 0) {
    return Dpv1Test::give(world(), area, pdu, crc_error);
  }

  std::mt19937 random_;
  std::optional<SlaveBench> world_;
  std::array<Client, 3> clients_;
  std::array<std::optional<Bytes>, 2> open_;  ///< what the user has of C1 and C2
  int serial_ = 0, exchanges_ = 0;
  std::size_t wrong_answers_ = 0;
};

}  // namespace dsdpv1::conformance
