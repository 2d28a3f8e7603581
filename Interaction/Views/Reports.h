// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Queries to the process that has the data or the picture. A report is a proxy whose information
/// properties are the results, so a query works the same with a server and without one.
#ifndef BrainShift_Reports_h
#define BrainShift_Reports_h

#include <vtkSmartPointer.h>

#include <QString>

#include <vector>

class vtkSMProxy;

namespace brainshift
{
/// Makes the report with this XML name in the session of `beside`. It takes part in no undo step.
vtkSmartPointer<vtkSMProxy> makeReport(vtkSMProxy* beside, const char* name);

/// Lets a proxy property of a report point at the object of the query.
void pointAt(vtkSMProxy* report, const char* property, vtkSMProxy* about);

/// Sends a property of a report although it is what it was: on several MPI ranks the query then
/// holds for the picture that was drawn since.
void askAnew(vtkSMProxy* report, const char* property);

/// The numbers of an information property, fetched anew.
std::vector<double> answerOf(vtkSMProxy* report, const char* property);

/// The text of an information property, fetched anew.
QString textOf(vtkSMProxy* report, const char* property);
}

#endif
