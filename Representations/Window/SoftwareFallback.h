// SPDX-License-Identifier: BSD-3-Clause
// VTK's software mapper, for where the GPU cannot draw a volume bent.
#ifndef BrainShift_SoftwareFallback_h
#define BrainShift_SoftwareFallback_h

class vtkSmartVolumeMapper;
class vtkVolumeMapper;

namespace brainshift
{
// Gives it what a mapper draws and how.
void drawInSoftware(vtkVolumeMapper* mapper, vtkSmartVolumeMapper* fallback);
}

#endif
