// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief VTK's software mapper, which draws a volume unbent if the GPU cannot draw it bent.
 */
#ifndef BrainShift_SoftwareFallback_h
#define BrainShift_SoftwareFallback_h

class vtkSmartVolumeMapper;
class vtkVolumeMapper;

namespace brainshift
{
/// Gives the fallback what a mapper draws, and how.
void drawInSoftware(vtkVolumeMapper* mapper, vtkSmartVolumeMapper* fallback);
}

#endif
