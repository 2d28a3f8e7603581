// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// An array of an image's values that lie in several arrays.
///
/// Several MPI ranks draw parts of a volume that are larger than the pieces of ParaView's pipeline.
/// A rank leaves its piece where it is, and has only the rest in arrays of its own. For VTK, all
/// are one read-only array. What reads all values takes them in runs (forEachRun): VTK's own ways
/// find each value by itself, and GetVoidPointer makes a copy.
#ifndef BrainShift_PiecedArray_h
#define BrainShift_PiecedArray_h

#include "Common/Extent.h"
#include "vtkBrainShiftCommonModule.h" // for the export macro

#include "vtkDataArray.h" // for its smart pointer
#include "vtkImplicitArray.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace brainshift
{
/// A box of the array of another extent. Extents count values: points, or cells.
struct ArrayPiece
{
  Extent box;    ///< what counts of the array
  Extent layout; ///< of the array
  vtkSmartPointer<vtkDataArray> values;
};

/// Finds the values of an extent in pieces, which together have all of it: a back end of VTK's
/// implicit arrays.
template <typename T>
class Pieces
{
public:
  Pieces(const Extent& extent, std::vector<ArrayPiece> pieces)
    : Whole(extent)
    , Components(pieces.front().values->GetNumberOfComponents())
    , All(std::move(pieces))
  {
    this->First.reserve(this->All.size());
    for (const ArrayPiece& piece : this->All)
    {
      this->First.push_back(static_cast<const T*>(piece.values->GetVoidPointer(0)));
    }
  }

  /// A value as VTK counts them.
  T map(vtkIdType value) const
  {
    T found{};
    const vtkIdType tuple = value / this->Components;
    this->forEachRun(tuple, tuple + 1, [&](vtkIdType, const T* values, vtkIdType) {
      found = values[value - tuple * this->Components];
    });
    return found;
  }

  /// See below.
  template <typename Visit>
  void forEachRun(vtkIdType first, vtkIdType end, const Visit& visit) const
  {
    const Extent& e = this->Whole;
    const vtkIdType sideX = e[1] - e[0] + 1;
    const vtkIdType sideY = e[3] - e[2] + 1;
    for (vtkIdType at = first; at < end;)
    {
      const vtkIdType row = at / sideX;
      const int x = e[0] + static_cast<int>(at - row * sideX);
      const int y = e[2] + static_cast<int>(row % sideY);
      const int z = e[4] + static_cast<int>(row / sideY);
      const std::size_t i = this->pieceAt(x, y, z);
      const Extent& box = this->All[i].box;
      const Extent& in = this->All[i].layout;
      const vtkIdType inX = in[1] - in[0] + 1;
      const vtkIdType inY = in[3] - in[2] + 1;
      const vtkIdType offset = ((z - in[4]) * inY + (y - in[2])) * inX + (x - in[0]);
      const vtkIdType count = std::min<vtkIdType>(std::min(box[1], e[1]) - x + 1, end - at);
      visit(at, this->First[i] + offset * this->Components, count);
      at += count;
    }
  }

private:
  std::size_t pieceAt(int x, int y, int z) const
  {
    const auto holds = [&](const ArrayPiece& piece) {
      const Extent& box = piece.box;
      return x >= box[0] && x <= box[1] && y >= box[2] && y <= box[3] && z >= box[4] && z <= box[5];
    };
    return std::find_if(this->All.begin(), this->All.end() - 1, holds) - this->All.begin();
  }

  Extent Whole;
  int Components;
  std::vector<ArrayPiece> All;
  std::vector<const T*> First; // values of each piece
};

/** An array whose values follow each other in memory: the array itself, or a copy. */
VTKBRAINSHIFTCOMMON_EXPORT vtkSmartPointer<vtkDataArray> contiguous(vtkDataArray* array);

/// The pieces of an array of numbers of the type T; null: it has none. They are recognised by the
/// name of their class, for each library has a class of its own.
template <typename T>
vtkImplicitArray<Pieces<T>>* asPieced(vtkDataArray* array)
{
  return vtkImplicitArray<Pieces<T>>::SafeDownCast(array);
}

/// The array itself, or a copy in runs if it has none.
template <typename T>
vtkSmartPointer<vtkDataArray> inRuns(vtkDataArray* array)
{
  return asPieced<T>(array) ? vtkSmartPointer<vtkDataArray>(array) : contiguous(array);
}

/**
 * Calls visit(first, values, count) for runs of tuples that follow each other in memory, in order;
 * together they are the tuples from `first` up to, but not including, `end`.
 *
 * @param array    what inRuns<T> returned
 */
template <typename T, typename Visit>
void forEachRun(vtkDataArray* array, vtkIdType first, vtkIdType end, const Visit& visit)
{
  if (auto pieced = asPieced<T>(array))
  {
    pieced->GetBackend()->forEachRun(first, end, visit);
  }
  else if (first < end)
  {
    const T* values = static_cast<const T*>(array->GetVoidPointer(0));
    visit(first, values + first * array->GetNumberOfComponents(), end - first);
  }
}

/**
 * The array of an extent whose values are in pieces. They are not copied.
 *
 * @param pieces   one or more, alike in type and components, which together have all of the extent;
 *                 the first gives the name. Arrays that are not laid out tuple by tuple are copied.
 */
VTKBRAINSHIFTCOMMON_EXPORT vtkSmartPointer<vtkDataArray> arrayOfPieces(
  const Extent& extent, std::vector<ArrayPiece> pieces);
}

#endif
