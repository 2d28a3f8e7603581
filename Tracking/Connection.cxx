// SPDX-License-Identifier: BSD-3-Clause
#include "Tracking/Connection.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fcntl.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <future>
#include <memory>
#include <system_error>
#include <thread>
#include <utility>

namespace brainshift
{
namespace
{
using Addresses = std::shared_ptr<addrinfo>;

// Milliseconds as poll() wants them.
int inMs(double seconds)
{
  return seconds < 0.0 ? -1 : static_cast<int>(std::ceil(seconds * 1000.0));
}

Addresses find(const std::string& host, const std::string& port, int flags)
{
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = flags | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), port.c_str(), &wanted, &found) != 0)
  {
    return {};
  }
  return { found, freeaddrinfo };
}

// A query to a name server cannot be interrupted, so a thread of its own makes it and may be left
// running. Numeric addresses and "localhost" need no query.
Addresses addressesOf(
  const std::string& host, const std::string& port, double seconds, const StopSignal& stop)
{
  const std::string numeric = host == "localhost" ? "127.0.0.1" : host;
  if (Addresses found = find(numeric, port, AI_NUMERICHOST))
  {
    return found;
  }
  std::promise<Addresses> promise;
  std::future<Addresses> answer = promise.get_future();
  std::thread([promise = std::move(promise), host, port]() mutable {
    promise.set_value(find(host, port, 0));
  }).detach();
  constexpr double pollEach = 0.05; // seconds
  for (double waited = 0.0; waited < seconds; waited += pollEach)
  {
    if (answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    {
      return answer.get();
    }
    if (stop.waitFor(pollEach))
    {
      return {};
    }
  }
  return {};
}

std::string textOf(int error)
{
  return std::generic_category().message(error);
}
}

StopSignal::StopSignal()
{
  if (pipe(this->Ends) != 0)
  {
    throw std::system_error(
      errno, std::generic_category(), "The system provides no pipe for the pointer");
  }
  for (const int end : this->Ends)
  {
    fcntl(end, F_SETFD, FD_CLOEXEC);
  }
}

StopSignal::~StopSignal()
{
  for (const int end : this->Ends)
  {
    ::close(end);
  }
}

void StopSignal::stop()
{
  const char byte = 0;
  // Nothing reads the byte, so all waiting threads wake up. A full pipe has the same effect.
  [[maybe_unused]] const auto written = write(this->Ends[1], &byte, 1);
}

bool StopSignal::waitFor(double seconds) const
{
  pollfd watched{ this->Ends[0], POLLIN, 0 };
  return poll(&watched, 1, inMs(seconds)) > 0;
}

bool Connection::waitFor(short events, double seconds) const
{
  pollfd watched[2] = { { this->Socket, events, 0 }, { this->Stop.descriptor(), POLLIN, 0 } };
  int ready = 0;
  do
  {
    ready = poll(watched, 2, inMs(seconds));
  } while (ready < 0 && errno == EINTR);
  return ready > 0 && watched[1].revents == 0;
}

std::string Connection::open(const std::string& host, int port, double seconds)
{
  this->close();
  const std::string address = host + ", port " + std::to_string(port);
  const Addresses found = addressesOf(host, std::to_string(port), seconds, this->Stop);
  if (this->Stop.waitFor(0.0))
  {
    return {};
  }
  if (!found)
  {
    return "The host " + host + " is not known";
  }
  std::string problem;
  for (const addrinfo* at = found.get(); at; at = at->ai_next)
  {
    this->close();
    this->Socket = socket(at->ai_family, at->ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (this->Socket < 0)
    {
      return "The system provides no socket: " + textOf(errno);
    }
    int error = ::connect(this->Socket, at->ai_addr, at->ai_addrlen) == 0 ? 0 : errno;
    if (error == EINPROGRESS)
    {
      if (!this->waitFor(POLLOUT, seconds))
      {
        this->close();
        return this->Stop.waitFor(0.0) ? "" : "No server answered at " + address + " in time";
      }
      socklen_t size = sizeof(error);
      getsockopt(this->Socket, SOL_SOCKET, SO_ERROR, &error, &size);
    }
    if (error == 0)
    {
      const int on = 1; // notices a machine that is gone
      setsockopt(this->Socket, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof(on));
      return {};
    }
    problem = "No server is at " + address + ": " + textOf(error);
  }
  this->close();
  return problem;
}

Connection::Result Connection::read(unsigned char* bytes, std::size_t size, double seconds)
{
  std::size_t done = 0;
  while (done < size)
  {
    if (!this->waitFor(POLLIN, done > 0 ? std::abs(seconds) : seconds))
    {
      return this->Stop.waitFor(0.0) ? Result::Stopped : Result::Stalled;
    }
    const auto count = recv(this->Socket, bytes + done, size - done, 0);
    if (count < 0 && (errno == EINTR || errno == EAGAIN))
    {
      continue;
    }
    if (count <= 0)
    {
      return done > 0 ? Result::Broken : Result::Closed;
    }
    done += static_cast<std::size_t>(count);
  }
  return Result::Read;
}

void Connection::close()
{
  if (this->Socket >= 0)
  {
    ::close(this->Socket);
    this->Socket = -1;
  }
}
}
