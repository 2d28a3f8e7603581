// SPDX-License-Identifier: BSD-3-Clause A server of OpenIGTLink on loopback, and messages made by
/// @file
/// hand: not by the library that reads them.
#ifndef BrainShift_TestServer_h
#define BrainShift_TestServer_h

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace brainshift
{
using Bytes = std::vector<unsigned char>;

inline void put(Bytes& bytes, std::uint64_t number, int count)
{
  for (int i = count - 1; i >= 0; --i)
  {
    bytes.push_back(static_cast<unsigned char>(number >> (8 * i)));
  }
}

inline void putName(Bytes& bytes, const std::string& name, std::size_t size)
{
  for (std::size_t i = 0; i < size; ++i)
  {
    bytes.push_back(i < name.size() ? static_cast<unsigned char>(name[i]) : 0);
  }
}

inline void putFloat(Bytes& bytes, float number)
{
  std::uint32_t bits = 0;
  std::memcpy(&bits, &number, sizeof(bits));
  put(bytes, bits, 4);
}

// CRC-64 of ECMA-182, bit by bit.
inline std::uint64_t checksumOf(const Bytes& bytes)
{
  std::uint64_t sum = 0;
  for (const unsigned char byte : bytes)
  {
    sum ^= static_cast<std::uint64_t>(byte) << 56;
    for (int bit = 0; bit < 8; ++bit)
    {
      sum = (sum >> 63) != 0 ? (sum << 1) ^ 0x42F0E1EBA9EA3693ULL : sum << 1;
    }
  }
  return sum;
}

// Columns of a matrix of 3 x 4: a quarter turn around z, and the tip (mm).
inline std::array<float, 12> poseNumbers(float x, float y, float z)
{
  return { 0, 1, 0, -1, 0, 0, 0, 0, 1, x, y, z };
}

inline Bytes bodyOf(const std::array<float, 12>& numbers)
{
  Bytes body;
  for (const float number : numbers)
  {
    putFloat(body, number);
  }
  return body;
}

struct TestMessage
{
  std::string type = "TRANSFORM";
  std::string device = "StylusToReference";
  Bytes body = bodyOf(poseNumbers(1, 2, 3));
  std::uint64_t version = 1;
  std::uint64_t wrongSum = 0;                               // what its checksum is wrong by
  std::uint64_t announced = static_cast<std::uint64_t>(-1); // its size; -1: the true one

  Bytes bytes() const
  {
    Bytes all;
    put(all, this->version, 2);
    putName(all, this->type, 12);
    putName(all, this->device, 20);
    put(all, 0, 8);
    put(all,
      this->announced == static_cast<std::uint64_t>(-1) ? this->body.size() : this->announced, 8);
    put(all, checksumOf(this->body) + this->wrongSum, 8);
    all.insert(all.end(), this->body.begin(), this->body.end());
    return all;
  }
};

inline Bytes transform(float x, float y, float z, const std::string& device = "StylusToReference")
{
  return TestMessage{ "TRANSFORM", device, bodyOf(poseNumbers(x, y, z)) }.bytes();
}

// A body of version 2: an extended header, the content, a table of one text, and the text.
inline Bytes extended(const Bytes& content, const std::string& key, const std::string& value)
{
  Bytes body;
  put(body, 12, 2);
  put(body, key.empty() ? 0 : 10, 2);
  put(body, key.size() + value.size(), 4);
  put(body, 0, 4);
  body.insert(body.end(), content.begin(), content.end());
  if (!key.empty())
  {
    put(body, 1, 2);
    put(body, key.size(), 2);
    put(body, 3, 2);
    put(body, value.size(), 4);
    putName(body, key, key.size());
    putName(body, value, value.size());
  }
  return body;
}

// Listens on a free port of 127.0.0.1. Each client is served by `serve`, one after the other.
class TestServer
{
public:
  class Client
  {
  public:
    Client(int socket, const std::atomic<bool>& over)
      : Socket(socket)
      , Over(over)
    {
    }
    // False once the client is gone.
    bool send(const Bytes& bytes) const
    {
      std::size_t done = 0;
      while (done < bytes.size() && !this->Over)
      {
        pollfd asked{ this->Socket, POLLOUT, 0 };
        if (poll(&asked, 1, 20) == 0)
        {
          continue;
        }
        const auto count = ::send(
          this->Socket, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (count < 0)
        {
          return false;
        }
        done += static_cast<std::size_t>(count);
      }
      return !this->Over;
    }
    // Until the client or the test is gone.
    void stay() const
    {
      pollfd asked{ this->Socket, POLLRDHUP, 0 };
      while (!this->Over && poll(&asked, 1, 20) == 0)
      {
      }
    }

  private:
    int Socket;
    const std::atomic<bool>& Over;
  };

  explicit TestServer(std::function<void(const Client&)> serve)
    : Serve(std::move(serve))
    , Listening(socket(AF_INET, SOCK_STREAM, 0))
  {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    const int bound = bind(this->Listening, reinterpret_cast<sockaddr*>(&address), size);
    if (bound != 0 || listen(this->Listening, 4) != 0)
    {
      throw std::runtime_error("No port is free on the loopback");
    }
    getsockname(this->Listening, reinterpret_cast<sockaddr*>(&address), &size);
    this->Port = ntohs(address.sin_port);
    this->Thread = std::thread([this] { this->run(); });
  }
  ~TestServer()
  {
    this->Over = true;
    this->Thread.join();
    close(this->Listening);
  }
  TestServer(const TestServer&) = delete;
  TestServer& operator=(const TestServer&) = delete;

  int port() const { return this->Port; }

private:
  void run()
  {
    pollfd asked{ this->Listening, POLLIN, 0 };
    while (!this->Over)
    {
      if (poll(&asked, 1, 20) > 0)
      {
        const int client = accept(this->Listening, nullptr, nullptr);
        this->Serve(Client(client, this->Over));
        close(client);
      }
    }
  }

  std::function<void(const Client&)> Serve;
  int Listening;
  int Port = 0;
  std::atomic<bool> Over{ false };
  std::thread Thread;
};
}

#endif
