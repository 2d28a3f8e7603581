// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// When the volumes of a DICOM series were made.
#ifndef BrainShift_DICOMTimes_h
#define BrainShift_DICOMTimes_h

#include "Formats/DICOM/DICOMImages.h"

namespace brainshift
{
/**
 * Moves images that were made after midnight to the next day, where their dates do not say it. The
 * order of TemporalPositionIdentifier, ContentDate or InstanceNumber decides where the times of day
 * fall by more than half a day; without it the shortest span counts.
 *
 * @param places images of each position, in any order
 * @return the end of a sentence that says so; empty if no two images at one position are more than
 *         half a day apart on one date
 */
std::string passMidnight(std::vector<std::vector<DICOMFrame>>& places);

/**
 * Finds out whether images at all places have the same triggers, to 1 ms, as those of a beating
 * heart have. Such triggers become equal. Others, of a gated series, do not tell volumes apart.
 *
 * @param places images of each position, in any order
 * @return the end of a sentence that says so, if triggers differ; empty otherwise
 */
std::string compareTriggers(std::vector<std::vector<DICOMFrame>>& places);

/** Makes images be sorted without their triggers. Returns the end of a sentence that says so. */
std::string leaveTriggers(std::vector<std::vector<DICOMFrame>>& places);

/**
 * Times of volumes, s: from offsets, the heart's trigger, the acquisition or the reference time; if
 * none of them grow, from the time between volumes that the header names. At least one.
 *
 * @param note gets the end of a sentence if the times may be others
 */
std::vector<double> timesOf(const std::vector<std::vector<DICOMFrame>>& volumes, std::string& note);
}

#endif
