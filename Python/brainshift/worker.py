# SPDX-License-Identifier: BSD-3-Clause
"""Does one case of a batch: `pvpython worker.py JOB`, the job as JSON."""

import json
import os
import sys
import traceback


def load_plugin():
    """Loads the plugin unless ParaView has it."""
    from paraview import servermanager, simple

    manager = servermanager.ActiveConnection.Session.GetSessionProxyManager()
    if not manager.GetProxyDefinitionManager().HasDefinition("filters", "FreeFormDeformation"):
        simple.LoadPlugin(os.environ["BRAINSHIFT_PLUGIN"], remote=False, ns=vars(simple))


def figures_of_case(case):
    """The numbers of a case for the table of the batch."""
    from brainshift.files import figures_of
    from brainshift.fitting import Fit
    from brainshift.reporting import left_out_mean

    bent = figures_of(case.bent)
    found = {"largest displacement (mm)": float(bent.MaximumDisplacement),
             "smallest Jacobian determinant": float(bent.MinimumJacobian)}
    for measure, _, reason in case.measures():
        if not reason:
            name = "traced points" if measure == case.trace_distance else "contacts"
            found[f"{name} RMS (mm)"] = float(measure.RMS)
    errors, fit = case.landmark_errors(), case.fit_source()
    if case.landmarks_fitted_before():
        pass  # no accuracy follows from them
    elif case.fits_landmarks():  # errors at these are no accuracy
        left_out = left_out_mean(Fit(fit))
        if left_out is not None:
            found["landmarks left out, mean (mm)"] = left_out
    elif errors is not None:
        found["landmarks mean (mm)"] = errors.mean
    if case.resection is not None:
        found.update({"tumour before (ml)": case.resection.before,
                      "tumour left (ml)": case.resection.left})
        if case.resection.left_interval:
            found["left, from (ml)"], found["left, to (ml)"] = case.resection.left_interval
    return found


def run(job):
    """Does the steps of a job. Returns its figures, what it wrote, paths from its folder, and why
    the figures may be wrong."""
    import brainshift
    from brainshift.batching import EXPORTED, PAGE
    from brainshift.roles import paired

    case = brainshift.Case(**paired(
        {role: path for role, path in job["case"].items() if role != "name"}))
    outputs = []
    for step in job["steps"]:
        print(step, flush=True)
        lacking = {each.name: each.lacks for each in case.steps}
        if step == "Resect":
            if case.tumour is not None and case.cavity is not None:
                case.resect()
        elif step == "Report":
            outputs.append(brainshift.report(case, os.path.join(job["folder"], PAGE)))
        elif step == "Export":
            case.run(step, folder=os.path.join(job["folder"], EXPORTED))
            outputs += case.exported
        elif step in ("Judge", "Refine") and lacking[step]:
            print(f"left out: it lacks {lacking[step]}", flush=True)
        else:
            case.run(step)
    return (figures_of_case(case), [os.path.relpath(file, job["folder"]) for file in outputs],
            [f"{step}: {sentence}" for step, sentence in case.doubts()])


def main(job):
    """Does a job and writes its result, whole or not at all."""
    from brainshift.batching import RESULT

    result = {"key": job["key"], "problem": "", "figures": {}, "outputs": [], "doubts": []}
    try:
        load_plugin()
        result["figures"], result["outputs"], result["doubts"] = run(job)
    except Exception as error:  # whatever it is, the batch goes on and reports it
        traceback.print_exc()
        result["problem"] = str(error) or type(error).__name__
    target = os.path.join(job["folder"], RESULT)
    with open(target + ".part", "w", encoding="utf-8") as file:
        json.dump(result, file)
    os.replace(target + ".part", target)


if __name__ == "__main__":
    main(json.loads(sys.argv[1]))
