// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Objects of ParaView's own HDF5 library, and its errors.
#ifndef BrainShift_HDF5Objects_h
#define BrainShift_HDF5Objects_h

#include "vtk_hdf5.h"

namespace brainshift
{
/** An object of the library, closed at the end of the scope. */
class HDF5Handle
{
public:
  HDF5Handle(hid_t id, herr_t (*close)(hid_t))
    : Id(id)
    , Close(close)
  {
  }
  ~HDF5Handle()
  {
    if (this->Id >= 0)
    {
      this->Close(this->Id);
    }
  }
  HDF5Handle(const HDF5Handle&) = delete;
  HDF5Handle& operator=(const HDF5Handle&) = delete;

  bool isOpen() const { return this->Id >= 0; }
  operator hid_t() const { return this->Id; }

private:
  hid_t Id;
  herr_t (*Close)(hid_t);
};

/** Keeps the library from writing its errors to the terminal. */
class HDF5Silence
{
public:
  HDF5Silence()
  {
    H5Eget_auto2(H5E_DEFAULT, &this->Function, &this->Data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~HDF5Silence() { H5Eset_auto2(H5E_DEFAULT, this->Function, this->Data); }
  HDF5Silence(const HDF5Silence&) = delete;
  HDF5Silence& operator=(const HDF5Silence&) = delete;

private:
  H5E_auto2_t Function = nullptr;
  void* Data = nullptr;
};
}

#endif
