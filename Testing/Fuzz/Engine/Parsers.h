// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The parsers of BrainShift as functions of bytes, one for each program of libFuzzer.
///
/// Each reads what the bytes hold, whole, and returns; a refusal is a Problem. Whatever else leaves
/// it is a fault, and so is what a sanitizer reports. CMakeLists.txt makes a program of each line
/// that begins with void.
#ifndef BrainShift_FuzzParsers_h
#define BrainShift_FuzzParsers_h

#include "Testing/Fuzz/Engine/CaseFile.h"

namespace brainshift::fuzz
{
// Volumes, each the file of one format.
void dicom(const Bytes& bytes);
void metaimage(const Bytes& bytes);
void mgh(const Bytes& bytes);
void minc1(const Bytes& bytes);
void minc2(const Bytes& bytes); // libminc and HDF5 are not instrumented
void nifti(const Bytes& bytes);
void nrrd(const Bytes& bytes);
void omezarr(const Bytes& bytes); // files of a folder (folderOf in CaseFile.cxx)

// Displacement fields.
void metaimagefield(const Bytes& bytes);
void niftifield(const Bytes& bytes);
void nrrdfield(const Bytes& bytes);

// Packed frames, after 5 bytes: columns and rows of 2, the lower first, and bytes of a number.
void deflated(const Bytes& bytes);
void jpeg(const Bytes& bytes);
void jpeg2000(const Bytes& bytes);
void jpegls(const Bytes& bytes);
void rle(const Bytes& bytes);

// The DICOM file that a written series is to be like.
void like(const Bytes& bytes);

// Surfaces and streamlines.
void freesurfer(const Bytes& bytes);
void gifti(const Bytes& bytes);
void mrtrix(const Bytes& bytes);
void trackvis(const Bytes& bytes);
void trx(const Bytes& bytes); // files of a folder

// Transforms. FSL's and SPM's warps are their own fixed and moving image.
void elastix(const Bytes& bytes);
void fslwarp(const Bytes& bytes);
void hdf5(const Bytes& bytes); // nor is HDF5 here
void itktext(const Bytes& bytes);
void lta(const Bytes& bytes);
void matlab(const Bytes& bytes);
void spmwarp(const Bytes& bytes);
void xfm(const Bytes& bytes);

// Landmarks.
void fcsv(const Bytes& bytes);
void markups(const Bytes& bytes);
void table(const Bytes& bytes);
void tag(const Bytes& bytes);

// The live pointer: messages, 58 bytes of header and a body, and recorded sessions.
void message(const Bytes& bytes);
void session(const Bytes& bytes);

// What OME-Zarr, TRX and bundles of scenes are packed in.
void zip(const Bytes& bytes);
}

#endif
