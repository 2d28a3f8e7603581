// SPDX-License-Identifier: BSD-3-Clause
#include "Tracking/SessionFile.h"

#include "Common/Numbers.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <locale>
#include <utility>

namespace brainshift
{
namespace
{
constexpr const char* FirstLine = "# BrainShift pointer session 1";
constexpr std::string_view PlacementWord = "# image from tracker";
constexpr std::uintmax_t MostBytes = 512ULL << 20;
constexpr std::size_t LongestLine = 1024;
constexpr std::size_t Numbers = 12;

using Row = std::array<double, Numbers>; // a matrix of 3 x 4, row after row

Row rowOf(const glm::dmat3& rotation, const glm::dvec3& translation)
{
  Row row{};
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      row[4 * i + j] = rotation[j][i];
    }
    row[4 * i + 3] = translation[i];
  }
  return row;
}

void writeRow(std::ostream& out, const Row& row)
{
  for (const double number : row)
  {
    out << '\t' << number;
  }
  out << '\n';
}

// The parts of a line between tabs.
std::vector<std::string_view> partsOf(std::string_view line)
{
  std::vector<std::string_view> parts;
  while (true)
  {
    const std::size_t tab = line.find('\t');
    parts.push_back(line.substr(0, tab));
    if (tab == std::string_view::npos)
    {
      return parts;
    }
    line.remove_prefix(tab + 1);
  }
}

std::string lineOf(const std::string& path, std::size_t number)
{
  return "Line " + std::to_string(number) + " of " + path + " ";
}

bool readNumber(std::string_view text, double& number)
{
  const std::optional<double> found = numberIn(text);
  number = found.value_or(number);
  return found && std::isfinite(number);
}

// 12 numbers from the part `first` on.
bool readRow(const std::vector<std::string_view>& parts, std::size_t first, glm::dmat3& rotation,
  glm::dvec3& translation)
{
  Row row{};
  if (parts.size() != first + Numbers)
  {
    return false;
  }
  for (std::size_t i = 0; i < Numbers; ++i)
  {
    if (!readNumber(parts[first + i], row[i]))
    {
      return false;
    }
  }
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      rotation[j][i] = row[4 * i + j];
    }
    translation[i] = row[4 * i + 3];
  }
  return true;
}

// One sentence if a line is neither a pose nor a remark.
std::string readLine(std::string_view line, Session& session)
{
  const std::vector<std::string_view> parts = partsOf(line);
  if (parts.front() == PlacementWord)
  {
    Pose placed; // for its checks
    if (!readRow(parts, 1, placed.rotation, placed.tip) || !problemOf(placed).empty())
    {
      return "is not a registration of the tracker";
    }
    session.placement = Placement{ placed.rotation, placed.tip };
    return {};
  }
  if (line.empty() || line.front() == '#')
  {
    return {};
  }
  Pose pose;
  if (parts.size() < 2 || !readNumber(parts[0], pose.seconds) ||
    !readRow(parts, 2, pose.rotation, pose.tip))
  {
    return "is no pose: a time, a device and 12 numbers, with tabs between them";
  }
  const std::string problem = problemOf(pose);
  if (!problem.empty())
  {
    return "is no pose: " + problem;
  }
  if (pose.seconds < 0.0 || (!session.poses.empty() && pose.seconds < session.poses.back().seconds))
  {
    return "has a time before that of the line above it";
  }
  if (session.poses.size() == MostPoses)
  {
    return "has one pose more than the limit of " + std::to_string(MostPoses);
  }
  pose.device = std::string(parts[1]);
  session.poses.push_back(std::move(pose));
  return {};
}

std::string problemOfFile(const std::string& path)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
  {
    return "There is no file " + path;
  }
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  return error || bytes > MostBytes ? "The file " + path + " has " + std::to_string(bytes) +
      " bytes; the limit is " + std::to_string(MostBytes)
                                    : "";
}

// A line that ends. getline() of a string would keep all that a damaged file calls a line.
bool nextLine(std::istream& in, std::string& line)
{
  std::array<char, LongestLine> text{};
  in.getline(text.data(), static_cast<std::streamsize>(text.size()));
  line = text.data();
  return in.good();
}
}

std::string writeSession(const std::string& path, const Session& session)
{
  const std::string part = path + ".part";
  {
    std::ofstream out(part, std::ios::binary);
    out.imbue(std::locale::classic());
    out.precision(std::numeric_limits<double>::max_digits10);
    out << FirstLine << "\n# seconds\tdevice\ttracker from tool: 3 rows of 4 numbers, mm\n";
    if (session.placement)
    {
      out << PlacementWord;
      writeRow(out, rowOf(session.placement->rotation, session.placement->translation));
    }
    for (const Pose& pose : session.poses)
    {
      out << pose.seconds << '\t' << pose.device;
      writeRow(out, rowOf(pose.rotation, pose.tip));
    }
    out.flush();
    if (!out)
    {
      out.close();
      std::remove(part.c_str());
      return "The session cannot be written to " + path;
    }
  }
  std::error_code error;
  std::filesystem::rename(part, path, error);
  return error ? "The session cannot be written to " + path + ": " + error.message() : "";
}

std::string readSession(const std::string& path, Session& session)
{
  std::string problem = problemOfFile(path);
  if (!problem.empty())
  {
    return problem;
  }
  std::ifstream in(path, std::ios::binary);
  std::string line;
  if (!nextLine(in, line) || line != FirstLine)
  {
    return "The file " + path + " does not begin with \"" + FirstLine + "\"";
  }
  Session read;
  std::size_t number = 1;
  while (nextLine(in, line))
  {
    ++number;
    problem = readLine(line, read);
    if (!problem.empty())
    {
      return lineOf(path, number) + problem;
    }
  }
  if (!in.eof() || !line.empty())
  {
    return lineOf(path, number + 1) + "is not whole or longer than 1023 characters";
  }
  if (read.poses.empty())
  {
    return "The file " + path + " has no pose";
  }
  session = std::move(read);
  return {};
}

namespace
{
double machineSeconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
}

Replay::Replay(Session session, std::function<double()> clock)
  : Played(std::move(session))
  , Clock(clock ? std::move(clock) : machineSeconds)
  , Start(this->Clock())
{
  this->Counter.state.phase = SourceState::Phase::Running;
}

double Replay::now() const
{
  return this->Clock() - this->Start;
}

std::vector<Pose> Replay::take()
{
  // From the first pose on: a recording may begin long after its server.
  const std::vector<Pose>& poses = this->Played.poses;
  const double now = this->now();
  for (; this->Next < poses.size(); ++this->Next)
  {
    Pose pose = poses[this->Next];
    pose.seconds -= poses.front().seconds;
    if (pose.seconds > now)
    {
      return this->Counter.take();
    }
    this->Counter.add(pose);
  }
  this->Counter.state.phase = SourceState::Phase::Ended;
  this->Counter.state.problem = "The recorded session is at its end";
  return this->Counter.take();
}

SourceState Replay::state() const
{
  return this->Counter.stateAt(this->now());
}
}
