// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Finds the views that a change of a source is seen in.
#ifndef BrainShift_ShowingViews_h
#define BrainShift_ShowingViews_h

#include <QSet>

class pqPipelineSource;
class pqView;

namespace brainshift
{
/// The views that show the source or something made of it.
QSet<pqView*> viewsShowing(pqPipelineSource* source);
}

#endif
