#include "gdb_bench.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <cerrno>

namespace dsdpv1::arm::test {
namespace {

constexpr time_t kPatienceSeconds = 300;

}  // namespace

GdbBench::GdbBench(std::uint64_t instructions) : target(load_elf(LOOP_ELF)), instructions_(instructions) {}

GdbBench::~GdbBench() {
  stop();
  end();
}

void GdbBench::start() {
  GdbOptions options;
  options.stopped = [this] { return stopped_.load(); };
  options.say = [this](const std::string& line) {
    const std::scoped_lock lock(mutex_);
    said_.push_back(line);
  };
  server_ = std::make_unique<GdbServer>(target, options);
  port_ = server_->port();
  thread_ = std::thread([this] { run(*server_); });
}

void GdbBench::run(GdbServer& server) {
  constexpr std::uint64_t kPiece = 1000;
  bool known = true;
  while (known && !stopped_ && !target.ended() && target.done() < instructions_)
    known = target.run(server, std::min(target.done() + kPiece, instructions_));
  server_.reset();
}

void GdbBench::end() {
  if (thread_.joinable()) thread_.join();
}

std::vector<std::string> GdbBench::said() const {
  const std::scoped_lock lock(mutex_);
  return said_;
}

RawGdb::RawGdb(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const timeval patience{kPatienceSeconds, 0};
  ::setsockopt(socket_.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  ::setsockopt(socket_.get(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  const int on = 1;
  ::setsockopt(socket_.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(::connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
}

void RawGdb::write(const std::string& bytes) {
  EXPECT_EQ(::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
}

std::string RawGdb::read(std::size_t count) {
  std::string bytes(count, '\0');
  if (::recv(socket_.get(), bytes.data(), count, MSG_WAITALL) == static_cast<ssize_t>(count)) return bytes;
  ADD_FAILURE() << "the server is silent or gone";
  return "";
}

bool RawGdb::closed() {
  char byte = 0;
  const ssize_t count = ::recv(socket_.get(), &byte, 1, 0);
  return count == 0 || (count < 0 && errno == ECONNRESET);  // the latter if our last acknowledgement was not read
}

void RawGdb::send(const std::string& packet) {
  write(gdb_frame(packet));
  EXPECT_EQ(read(1), "+");
}

std::string RawGdb::reply() {
  EXPECT_EQ(read(1), "$");
  std::string payload;
  for (std::string byte = read(1); !byte.empty() && byte != "#"; byte = read(1)) payload += byte;
  EXPECT_EQ("$" + payload + "#" + read(2), gdb_frame(payload)) << "checksum";
  write("+");
  return payload;
}

std::string RawGdb::ask(const std::string& packet) {
  send(packet);
  return reply();
}

}  // namespace dsdpv1::arm::test
