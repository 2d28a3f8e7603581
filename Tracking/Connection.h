// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A connection to a server that another thread can end at once.
#ifndef BrainShift_Connection_h
#define BrainShift_Connection_h

#include <cstddef>
#include <string>

namespace brainshift
{
/** Ends what waits in other threads, once and for all. */
class StopSignal
{
public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  void stop();
  /** Waits for seconds. True if it was stopped. */
  bool waitFor(double seconds) const;
  /** Is readable once it was stopped. */
  int descriptor() const { return this->Ends[0]; }

private:
  int Ends[2] = { -1, -1 }; // of a pipe
};

/** Reads from a server. It sends nothing. */
class Connection
{
public:
  explicit Connection(const StopSignal& stop)
    : Stop(stop)
  {
  }
  ~Connection() { this->close(); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /** Connects within `seconds`, which hold for finding the host too. Returns one sentence without a
   * full stop if it cannot; an empty one too if it was stopped. */
  std::string open(const std::string& host, int port, double seconds);

  enum class Result
  {
    Read,
    Closed,  ///< before the first byte
    Broken,  ///< after the first byte
    Stalled, ///< no byte came for `seconds`
    Stopped,
  };

  /**
   * Reads `size` bytes.
   *
   * @param seconds   that a byte may take; below 0: the first byte may take for ever, and each
   *                  further one the absolute value
   */
  Result read(unsigned char* bytes, std::size_t size, double seconds);

  void close();

private:
  bool waitFor(short events, double seconds) const; // false: stopped or too late

  const StopSignal& Stop;
  int Socket = -1;
};
}

#endif
