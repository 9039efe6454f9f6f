// Input and output of a port are bounded, and the next peer gets nothing of the previous one.
#include "tb/serve/host_connection.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace dsdpv1 {
namespace {

using bus::Bytes;
using tb::Descriptor;

/// A port whose other end belongs to the test.
class Port : public tb::serve::HostConnection {
 public:
  std::string name() const override { return "port"; }
  /// The host that uses the port from now on.
  Descriptor connect() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends.data()), 0);
    own_.reset(ends[0]);
    set_peer(own_.get());
    return Descriptor(ends[1]);
  }

 protected:
  void look() override {}
  void lost(const std::string& /*why*/) override { own_.reset(); }

 private:
  Descriptor own_;
};

class HostConnectionTest : public testing::Test {
 protected:
  HostConnectionTest() {
    port_.say = [this](const std::string& text) { said_.push_back(text); };
    port_.on_gone = [this] { ++gone_; };
  }
  /// Reads all available bytes.
  static std::size_t read_all(const Descriptor& host) {
    std::array<char, 65536> bytes{};
    std::size_t total = 0;
    for (ssize_t count = 0; (count = ::read(host.get(), bytes.data(), bytes.size())) > 0;)
      total += static_cast<std::size_t>(count);
    return total;
  }

  Port port_;
  std::vector<std::string> said_;
  int gone_ = 0;
};

TEST_F(HostConnectionTest, NoMoreIsReceivedThanAskedForAndTheRestStays) {
  const Descriptor host = port_.connect();
  ASSERT_EQ(::write(host.get(), "123456", 6), 6);
  EXPECT_EQ(port_.receive(4), (Bytes{'1', '2', '3', '4'}));
  EXPECT_TRUE(port_.receive(0).empty());
  EXPECT_EQ(port_.receive(4), (Bytes{'5', '6'}));
}

TEST_F(HostConnectionTest, BytesAreNotWaitedForWhileNothingIsRead) {
  const Descriptor host = port_.connect();
  EXPECT_EQ(port_.watched(true).events, POLLIN);
  EXPECT_EQ(port_.watched(false).events, 0);
}

TEST_F(HostConnectionTest, WhatAHostDoesNotReadIsKeptUpToALimitAndThenThrownAway) {
  const Descriptor host = port_.connect();
  const Bytes answer(1000, 7);
  for (int i = 0; i < 3000; ++i) port_.send(answer);
  ASSERT_EQ(said_.size(), 1U);
  EXPECT_NE(said_[0].find("does not read"), std::string::npos);
  std::size_t got = 0;
  for (std::size_t more = 0; (more = read_all(host)) > 0; got += more) port_.receive(0);
  EXPECT_GT(got, Port::kMostKept - answer.size());
  EXPECT_LT(got, 3000U * answer.size());
}

TEST_F(HostConnectionTest, AHostThatHangsUpIsNoticedThoughItIsNotReadFrom) {
  {
    const Descriptor host = port_.connect();
    ASSERT_EQ(::write(host.get(), "1", 1), 1);
  }
  EXPECT_TRUE(port_.receive(0).empty());
  EXPECT_EQ(gone_, 1);
}

TEST_F(HostConnectionTest, HostThatHungUpIsReadOnceMore) {
  {
    const Descriptor host = port_.connect();
    ASSERT_EQ(::write(host.get(), "123", 3), 3);
  }
  EXPECT_EQ(port_.receive(2), (Bytes{'1', '2'}));
  EXPECT_EQ(gone_, 0);
  EXPECT_TRUE(port_.receive(100).empty());
  EXPECT_EQ(gone_, 1);
}

TEST_F(HostConnectionTest, HostThatHungUpIsNotReadWhenThereIsNoRoom) {
  {
    const Descriptor host = port_.connect();
    ASSERT_EQ(::write(host.get(), "1", 1), 1);
  }
  EXPECT_TRUE(port_.receive(0).empty());
  EXPECT_EQ(gone_, 1);
}

TEST_F(HostConnectionTest, WhatWasKeptForAHostIsNotForTheNext) {
  {
    const Descriptor slow = port_.connect();
    for (int i = 0; i < 1000; ++i) port_.send(Bytes(1000, 7));
  }
  port_.receive(0);
  const Descriptor next = port_.connect();
  port_.receive(0);
  EXPECT_EQ(read_all(next), 0U);
}

}  // namespace
}  // namespace dsdpv1
