// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Files/ByteSink.h"

#include "Formats/Files/WholeFile.h"

#include "vtk_zlib.h"

#include <algorithm>
#include <cerrno>
#include <utility>

namespace brainshift
{
ByteSink::ByteSink(const std::string& fileName, bool pack)
  : Packs(pack)
{
  errno = 0;
  if (pack)
  {
    this->Packed = gzopen(fileName.c_str(), "wb");
  }
  else
  {
    this->Plain.open(fileName, std::ios::binary);
  }
  if (pack ? !this->Packed : !this->Plain)
  {
    this->keepProblem();
  }
}

ByteSink::~ByteSink()
{
  this->close();
}

bool ByteSink::write(const void* bytes, std::size_t count)
{
  constexpr std::size_t Piece = 1u << 30; // zlib counts in 32 bits
  const char* next = static_cast<const char*>(bytes);
  while (count > 0 && this->Problem.empty())
  {
    const std::size_t piece = std::min(count, Piece);
    errno = 0;
    const bool taken = this->Packs ? gzwrite(static_cast<gzFile>(this->Packed), next,
                                       static_cast<unsigned>(piece)) == static_cast<int>(piece)
                                   : !!this->Plain.write(next, static_cast<std::streamsize>(piece));
    if (!taken)
    {
      this->keepProblem();
    }
    next += piece;
    count -= piece;
  }
  return this->Problem.empty();
}

std::string ByteSink::close()
{
  errno = 0;
  bool good = true;
  if (this->Packed)
  {
    good = gzclose(static_cast<gzFile>(std::exchange(this->Packed, nullptr))) == Z_OK;
  }
  else if (this->Plain.is_open())
  {
    this->Plain.close();
    good = !!this->Plain;
  }
  if (!good && this->Problem.empty())
  {
    this->keepProblem();
  }
  return this->Problem;
}

void ByteSink::keepProblem()
{
  this->Problem = lastSystemError();
}
}
