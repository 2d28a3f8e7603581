# SPDX-License-Identifier: BSD-3-Clause
"""Writes MINC2 volumes with libminc, for tests of the reader. A volume is an array indexed
[i, j, k] and the 4 x 4 affine from indices to RAS mm."""

import ctypes
import ctypes.util
import os

import h5py
import numpy

REAL, INTEGER, LABEL = 0, 1, 2  # classes of volumes
TYPES = {"int8": 1, "int16": 3, "int32": 4, "float32": 5, "float64": 6, "uint8": 100,
         "uint16": 101, "uint32": 102}
SPATIAL, TIME, RECORD, REGULAR, FILE_ORDER = 1, 2, 6, 1, 0


def library():
    """libminc, or None where it is not installed."""
    name = ctypes.util.find_library("minc2")
    return ctypes.CDLL(name) if name else None


def _sizes(numbers):
    return (ctypes.c_ulonglong * len(numbers))(*(int(number) for number in numbers))


def _done(status, what):
    assert status == 0, f"libminc: {what}"


def _dimension(minc, name, kind, count, start, step, cosines=None):
    handle = ctypes.c_void_p()
    _done(minc.micreate_dimension(name.encode(), kind, REGULAR, ctypes.c_ulonglong(count),
                                  ctypes.byref(handle)), "dimension")
    if kind == RECORD:
        return handle
    _done(minc.miset_dimension_start(handle, ctypes.c_double(start)), "start")
    _done(minc.miset_dimension_separation(handle, ctypes.c_double(step)), "separation")
    if cosines is not None:
        _done(minc.miset_dimension_cosines(handle, (ctypes.c_double * 3)(*cosines)), "cosines")
    return handle


def _space(minc, shape, affine):
    """Axes of space by the names that lie nearest; a negative step keeps cosines near the name."""
    steps = numpy.linalg.norm(affine[:3, :3], axis=0)
    axes = affine[:3, :3] / steps
    starts = numpy.linalg.solve(axes, affine[:3, 3])
    dimensions = []
    for i, count in enumerate(shape):
        nearest = int(numpy.argmax(numpy.abs(axes[:, i])))
        sign = numpy.sign(axes[nearest, i])
        dimensions.append(_dimension(minc, "xyz"[nearest] + "space", SPATIAL, count,
                                     sign * starts[i], sign * steps[i], sign * axes[:, i]))
    return dimensions


def write(name, voxels, affine, kind=REAL, times=None, slice_ranges=None, labels=()):
    """Writes voxels [i, j, k], or [time, i, j, k] with times (start, step). `slice_ranges`: the
    least and the largest real value of each slice i, for whole numbers over all their type."""
    minc = library()
    if os.path.exists(name):
        os.remove(name)  # HDF5 writes no file that somebody still reads
    dimensions = _space(minc, voxels.shape[-3:], affine)
    if times is not None:
        dimensions.insert(0, _dimension(minc, "time", TIME, len(voxels), *times))
    volume = ctypes.c_void_p()
    handles = (ctypes.c_void_p * len(dimensions))(*dimensions)
    props = ctypes.c_void_p()
    _done(minc.minew_volume_props(ctypes.byref(props)), "properties")
    _done(minc.micreate_volume(name.encode(), len(dimensions), handles, TYPES[voxels.dtype.name],
                               kind, props, ctypes.byref(volume)), "volume")
    if slice_ranges is not None:
        _done(minc.miset_slice_scaling_flag(volume, 1), "slice scaling")
    for value, label in labels:
        _done(minc.midefine_label(volume, value, label.encode()), "label")
    _done(minc.micreate_volume_image(volume), "image")
    if kind == REAL:
        limits = numpy.iinfo(voxels.dtype) if voxels.dtype.kind in "iu" else None
        low, high = (limits.min, limits.max) if limits else (voxels.min(), voxels.max())
        _done(minc.miset_volume_valid_range(volume, ctypes.c_double(high), ctypes.c_double(low)),
              "valid range")
        if slice_ranges is None:
            _done(minc.miset_volume_range(volume, ctypes.c_double(high), ctypes.c_double(low)),
                  "range")
    for i, (low, high) in enumerate(slice_ranges or ()):
        place = _sizes([i] + [0] * (len(dimensions) - 1))
        _done(minc.miset_slice_range(volume, place, ctypes.c_size_t(len(dimensions)),
                                     ctypes.c_double(high), ctypes.c_double(low)), "slice range")
    stored = numpy.ascontiguousarray(voxels)
    _done(minc.miset_voxel_value_hyperslab(
        volume, TYPES[voxels.dtype.name], _sizes([0] * voxels.ndim), _sizes(voxels.shape),
        stored.ctypes.data_as(ctypes.c_void_p)), "voxels")
    _done(minc.miclose_volume(volume), "close")
    return name


def write_vectors(name, vectors, affine, isFirst=False):
    """Writes vectors [i, j, k, 3], float32, with the components as the last axis or the first."""
    minc = library()
    if os.path.exists(name):
        os.remove(name)
    dimensions = _space(minc, vectors.shape[:3], affine)
    dimensions.insert(0 if isFirst else 3, _dimension(minc, "vector_dimension", RECORD, 3, 0, 1))
    stored = numpy.ascontiguousarray(
        numpy.moveaxis(vectors, 3, 0) if isFirst else vectors, numpy.float32)
    volume, props = ctypes.c_void_p(), ctypes.c_void_p()
    _done(minc.minew_volume_props(ctypes.byref(props)), "properties")
    _done(minc.micreate_volume(name.encode(), 4, (ctypes.c_void_p * 4)(*dimensions),
                               TYPES["float32"], REAL, props, ctypes.byref(volume)), "volume")
    _done(minc.micreate_volume_image(volume), "image")
    high, low = ctypes.c_double(stored.max()), ctypes.c_double(stored.min())
    _done(minc.miset_volume_valid_range(volume, high, low), "valid range")
    _done(minc.miset_volume_range(volume, high, low), "range")
    _done(minc.miset_voxel_value_hyperslab(
        volume, TYPES["float32"], _sizes([0] * 4), _sizes(stored.shape),
        stored.ctypes.data_as(ctypes.c_void_p)), "voxels")
    _done(minc.miclose_volume(volume), "close")
    return name


def make_uneven(name, axis, positions):
    """Gives an axis of a file a list of positions, as MINC writes an irregular one."""
    path = f"minc-2.0/dimensions/{axis}"
    with h5py.File(name, "r+") as file:
        kept = dict(file[path].attrs)
        del file[path]
        made = file.create_dataset(path, data=numpy.asarray(positions, float))
        for key, value in {**kept, "spacing": numpy.bytes_("irregular")}.items():
            made.attrs[key] = value
