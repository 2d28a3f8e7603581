# SPDX-License-Identifier: BSD-3-Clause
"""Reads figures of a volume from the process that has it."""


def report_on(source, port, association, name):
    """A report on an array of a volume that has not measured yet.

    - `source`: the proxy of the source. It must be up to date.
    - `association`: 0 for points, 1 for cells.
    """
    report = source.GetSessionProxyManager().NewProxy("misc", "VolumeLookReport")
    report.UnRegister(None)  # Python holds it
    report.PrototypeOn()  # a question is no step to undo
    report.GetProperty("Source").AddProxy(source)
    report.GetProperty("Port").SetElement(0, port)
    report.GetProperty("Association").SetElement(0, association)
    report.GetProperty("ArrayName").SetElement(0, name)
    return report


def measure(report, command="Measure"):
    """Lets a report measure and fetches its figures."""
    report.UpdateVTKObjects()
    report.InvokeCommand(command)
    report.UpdatePropertyInformation()


def numbers(report, name):
    """All elements of one of its properties."""
    answer = report.GetProperty(name)
    return [answer.GetElement(i) for i in range(answer.GetNumberOfElements())]
