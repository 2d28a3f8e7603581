# SPDX-License-Identifier: BSD-3-Clause
"""The orders of the dock Case and what it shows, as JSON. The window calls `answer`.

The window has one case in hand. An order changes it through `Case`, so a script and the dock do the
same; after each order the whole case is told again, as `_told` describes.
"""

import itertools
import json
import os
import traceback

from .cases import Case
from .casesources import OPENED, POINT_ROLES, give_name, name_of, sources
from .points import read_from
from .roles import ROLES, ending, holds_both, paired, proposed
from .scenes import turn_to_opening

#: What a role is called in the window, and what it is.
_ROLES = {
    "volume": ("Volume", "The volume before surgery, at rest. It is the one that is bent."),
    "brain": ("Brain", "A mask or labels of the brain. It is the cortex of fits and distances, and "
                       "tissue outside of it is held."),
    "tumour": ("Tumour", "Labels of the tumour before surgery, in the frame of the volume."),
    "traces": ("Traces", "Points that were traced on the cortex (mm)."),
    "opening": ("Opening", "Where the skull is open: a mask, or a sphere. The fit holds the cortex "
                           "only outside of it."),
    "landmarks": ("Landmarks", "Landmarks at rest (mm). A file that has both positions of each "
                               "landmark counts for both rows."),
    "measured": ("Measured", "The same landmarks as measured during surgery (mm)."),
    "electrodes": ("Electrodes", "Contacts as measured (mm). The fit takes those of grids to the "
                                 "tissue under their sheet, strips as traced points, and leaves "
                                 "out shafts and what floats or is buried."),
    "reference": ("Reference", "A volume from during or after surgery. The bent volume is compared "
                               "with it, and refined by it."),
    "cavity": ("Cavity", "A mask of the removed tissue, drawn in the reference."),
}

#: Filters whose images have no role.
_RESULTS = ("FreeFormDeformation", "CompareVolumes", "Moments", "Resection", "FitDeformation",
            "RefinedLattice", "DeformationLattice", "TraceDistance")

#: Colours of points in a view that tell themselves apart for all eyes (Okabe and Ito).
_ORANGE, _BLUE = (0.902, 0.624, 0.0), (0.0, 0.447, 0.698)

#: Radius of an opening that nothing is known of, and the least one (mm).
_RADIUS, _LEAST_RADIUS = 30.0, 10.0

#: The case; the connection that it is of; the last case that the user began, which is kept while it
#: is empty; the cases by name, for they know what they found.
_in_hand = {"case": None, "former": None, "connection": None, "new": None, "known": {}}


def _cases():
    """The cases of the session."""
    return [_in_hand["known"].setdefault(case.name, case) for case in Case.all()]


def _case():
    """The case in hand: the former one, or one of the session, or a new one."""
    from paraview import servermanager

    connection = servermanager.ActiveConnection
    if _in_hand["connection"] is not connection:
        _in_hand.update(case=None, connection=connection, known={})
    _name_again()
    case, known = _in_hand["case"], _cases()
    if known and (case is None or case not in (*known, _in_hand["new"])):  # as after an undo
        case = _in_hand["former"] if _in_hand["former"] in known else _seen(known)
    case = case or Case()
    _in_hand["known"][case.name] = _in_hand["case"] = case
    return case


def _seen(known):
    """The case that the active view shows, as after a state was loaded; else the first."""
    from paraview import simple

    view = simple.GetActiveView()
    for case in known if view else ():
        if any(_is_shown(case.part(part), view) for part in ("bent", "resected", "comparison")):
            return case
        if _is_shown(case.part("moments"), view):
            begun = [each for each in case.moments if each.minutes <= view.ViewTime]
            return known[known.index((begun or case.moments[:1])[-1])]
    return known[0]


def _name_again():
    """Gives sources that a case opened their names back: ParaView's dialog that loads a state calls
    them by their files, colin_T1w colin_T..w.nii.gz."""
    for source in sources():
        path = getattr(source, "FileName", None) or getattr(source, "FileNames", None) or ""
        path = path if isinstance(path, str) else path[0]
        if (source.SMProxy.HasAnnotation(OPENED) and ending(path)
                and _name(source).lower().endswith(ending(path))):
            give_name(source)


def _source(number):
    """The source with a proxy's number; None for 0 or if there is none."""
    from paraview import simple

    return next((source for source in simple.GetSources().values()
                 if number and source.SMProxy.GetGlobalID() == number), None)


def _name(source):
    return name_of(source) or "a source"


def _number(source):
    return source.SMProxy.GetGlobalID() if source else 0


# What is told --------------------------------------------------------------------------------


def _may_have(case, source, role):
    """Whether a source may have a role, as far as it was read."""
    if source.SMProxy.GetXMLName() in _RESULTS or case.makes(source, role):
        return False
    information = source.GetDataInformation()
    return information.DataSetTypeIsA("vtkPointSet" if role in POINT_ROLES else "vtkImageData")


def _told_roles(case):
    """Of each role: name, label, tip, the number of its source or 0, and the sources that may have
    it: pairs of number and name."""
    present = sources()
    for role, (label, tip) in _ROLES.items():
        chosen = case.part(role)
        choices = [source for source in present
                   if source == chosen or _may_have(case, source, role)]
        yield {"role": role, "label": label, "tip": tip, "chosen": _number(chosen),
               "choices": [[_number(source), _name(source)] for source in choices]}


def _told_settings(case):
    """The settings: `shown` is whether one matters with the present roles."""
    has_brain = case.brain is not None
    points = case.traces is not None or case.electrodes is not None
    several = len(case.moments) > 1
    by_time = bool(case.traces_by_time)
    shown = {
        "surface_level": points and not has_brain,
        "holds_outside": has_brain, "mask_growth": has_brain and case.holds_outside,
        "brain_labels": has_brain, "tumour_labels": case.tumour is not None,
        "cavity_labels": case.cavity is not None,
        "landmarks_judge": all(case.landmarks or (None,)),
        "moment": several, "minutes": several,
        "traces_by_time": by_time or several and case.has_stamps(), "trace_start": by_time}
    return {name: {"value": getattr(case, name), "shown": bool(on)} for name, on in shown.items()}


def _told_steps(case):
    doubtful = case.doubtful()
    steps = [{**step._asdict(), "doubtful": step.name in doubtful} for step in case.steps]
    missing = [role for role in ("tumour", "cavity") if getattr(case, role) is None]
    lacks = ", ".join(filter(None, [case.lacks_bent(), *(f"a {role}" for role in missing)]))
    steps.append(_step("Tumour left", lacks, case._left))
    steps.append(_step("Report", case.lacks_bent(), case.reported))
    steps.append(_step("Moments", *_found_moments(case)))
    return steps


def _found_moments(case):
    """What showing the moments lacks, and which there are."""
    moments = case.moments
    if case.lacks_bent() or len(moments) < 2:
        return case.lacks_bent() or "another moment: press New Moment", ""
    times = ", ".join(f"{each.moment or 'first'} {each.minutes:g} min" for each in moments)
    return "", f"{len(moments)} moments: {times}; tissue between them is interpolated"


def _step(name, lacks, found):
    state = "lacks" if lacks else "done" if found else "ready"
    return {"name": name, "state": state, "lacks": lacks, "found": found}


def _told(case):
    """All that the dock shows: the cases, and of the case in hand roles, settings and steps."""
    ball = case.opening_ball()
    return {
        "case": case.name, "cases": [[each.name, _label(each)] for each in _cases()],
        "roles": list(_told_roles(case)), "settings": _told_settings(case),
        "sphere": [*ball[0], ball[1]] if ball else [],
        "steps": _told_steps(case), "bent": _number(case.bent),
        "comparison": _number(case.comparison)}


def _label(case):
    """What a case is called: the name of its first source, and its moment."""
    name = next((_name(case.part(role)) for role in ROLES if case.part(role)), "empty")
    return f"{name}, {case.moment or 'first moment'}" if len(case.moments) > 1 else name


# Orders --------------------------------------------------------------------------------------


def _choose(case, role, source=0, path=""):
    """Gives a role to a source or a file; neither takes it away."""
    chosen = path or _source(source)
    if source and chosen is None:
        raise ValueError(f"{_ROLES[role][0]}: the source is gone")
    is_first_brain = role == "brain" and case.brain is None
    if role in ("landmarks", "measured"):
        _choose_landmarks(case, role, chosen)
    else:
        setattr(case, role, chosen)
    if case.bent is not None and (role == "volume" or is_first_brain):
        _look_first(case, anew=is_first_brain)


def _choose_landmarks(case, role, chosen):
    if isinstance(chosen, str) and os.path.isfile(chosen) and holds_both(chosen):
        case.landmarks = chosen
        return
    rest, measured = case.landmarks or (None, None)
    pair = (chosen, measured) if role == "landmarks" else (rest, chosen)
    case.landmarks = pair if any(pair) else None


def _set(case, name, value):
    from paraview import simple

    view = simple.GetActiveView()
    former = [points for points in (case.traces, *(each.part("timed") for each in case.moments))
              if view and _is_shown(points, view)]
    setattr(case, name, value)
    now = case.traces_now()
    if former and now not in former:  # points of another moment would be seen
        for points in former:
            simple.Hide(points, view)
        if now is not None:
            _show_points(now, view, _ORANGE)


def _set_sphere(case, numbers=()):
    """Sets centre and radius (mm) of the opening. Without them, a sphere around the points that
    were traced, for they were traced in it; else one at the middle of the volume."""
    case.opening = (tuple(numbers[:3]), numbers[3]) if numbers else _guessed_sphere(case)


def _guessed_sphere(case):
    import numpy

    source = case.traced or case.electrodes
    points = read_from(source).positions if source is not None else []
    if len(points):
        centre = numpy.mean(points, axis=0)
        radius = max(_LEAST_RADIUS, numpy.linalg.norm(points - centre, axis=1).max())
        return tuple(numpy.round(centre, 1).tolist()), round(float(radius), 1)
    bounds = case.volume.GetDataInformation().GetBounds() if case.volume else [0.0] * 6
    return tuple(round((bounds[i] + bounds[i + 1]) / 2, 1) for i in (0, 2, 4)), _RADIUS


def _look_first(case, anew=False):
    """Shows the bent volume where nothing shows it yet, in place of other cases, and lets the tools
    act on it. `anew`: with the look that fits now, also where it is shown."""
    from paraview import simple

    view = simple.GetActiveViewOrCreate("RenderView")
    if anew or not any(_is_shown(case.part(part), view) for part in ("bent", "resected")):
        case.show(view)
    case.hide_others(view, _cases())
    simple.SetActiveSource(case.bent)


def _show_points(source, view, color):
    from paraview import simple

    shown = simple.Show(source, view)
    shown.SetRepresentationType("Points")
    shown.ColorArrayName = ["POINTS", ""]  # ColorBy(None) fails where there is an array
    shown.PointSize, shown.RenderPointsAsSpheres = 9.0, 1
    shown.AmbientColor = shown.DiffuseColor = color


def _look(case):
    """Shows the bent volume with a look, and the points on the cortex."""
    from paraview import simple

    view = simple.GetActiveViewOrCreate("RenderView")
    case.show(view)
    for points, measure, color in ((case.traced, case.trace_distance, _ORANGE),
                                   (case.electrodes, case.contact_distance, _BLUE)):
        if points is not None and not (measure and _is_shown(measure, view)):
            _show_points(points, view, color)
    simple.SetActiveSource(case.bent)


def _is_shown(source, view):
    return source is not None and any(getattr(shown, "Input", None) == source and shown.Visibility
               for shown in view.Representations)


def _measure(case):
    """Shows the distances of the points, in place of the points."""
    from paraview import simple

    view = simple.GetActiveViewOrCreate("RenderView")
    for points, measure in ((case.traced, case.trace_distance),
                            (case.electrodes, case.contact_distance)):
        if measure is not None:
            simple.Hide(points, view)
            simple.Show(measure, view)


def _run(case, step, **settings):
    if step == "Tumour left":
        from paraview import simple

        case.resect()
        case.show_resection()
        turn_to_opening(case, simple.GetActiveView())
    elif step == "Moments":
        case.show_moments()
    elif step == "Report":
        from .reporting import report

        case.reported = report(case, **settings)
    else:
        case.run(step, **settings) if step not in ("Look", "Measure") else (
            _look if step == "Look" else _measure)(case)


def _accept(case, roles):
    """Takes files over, by role: into a new case if there is another volume already. What fails is
    said at the end."""
    if roles.get("volume") and case.volume is not None:
        case = _begin(case)
    problems, roles = [], paired(roles, case.part("landmarks"))
    for role in ROLES:
        if roles.get(role):
            try:
                setattr(case, role, roles[role])
            except (ValueError, OSError) as error:
                problems.append(f"{_ROLES[role][0]}: {error}")
    if case.bent is not None:
        _look_first(case)
    if problems:
        raise ValueError("; ".join(problems))


def _select(case, name):
    """Takes another case in hand, and shows it."""
    chosen = next((each for each in _cases() if each.name == name), case)
    _in_hand["case"] = chosen
    if chosen != case and chosen.bent is not None:
        _look_first(chosen)


def _begin_moment(case):
    """Another moment of the same surgery, which is in hand from now on."""
    taken = {each.moment for each in case.moments}
    names = (f"moment {number}" for number in itertools.count(len(taken) + 1))
    moment = case.begin_moment(next(name for name in names if name not in taken))
    _in_hand.update(case=moment, former=case)
    _in_hand["known"][moment.name] = moment
    _look_first(moment)


def _begin(_):
    """Another case, which is in hand from now on."""
    case = Case()
    _in_hand.update(case=case, new=case)
    _in_hand["known"][case.name] = case
    return case


def _sort(paths):
    """What each of some files may be, or those of one folder: role, path, reason."""
    return [[each.role or "", each.file, each.reason] for each in proposed(paths)]


_ORDERS = {"choose": _choose, "set": _set, "sphere": _set_sphere, "run": _run, "accept": _accept,
           "select": _select, "begin": _begin, "moment": _begin_moment}


def answer(text):
    """Does an order, and tells what came of it. Both are JSON.

    - `text`: `{"order": name, "with": arguments}`. The order `tell` changes nothing, and `sort`
      tells only what files may be.

    Returns `{"problem": sentence or "", "told": what _told or _sort returns}`.
    """
    asked = json.loads(text)
    order, arguments = asked["order"], asked.get("with", {})
    problem, told = "", None
    try:
        if order == "sort":
            told = _sort(**arguments)
        elif order != "tell":
            _ORDERS[order](_case(), **arguments)
    except (ValueError, OSError) as error:
        problem = str(error)
    except Exception as error:  # the window must not end; its output has where it was
        traceback.print_exc()
        problem = f"{type(error).__name__}: {error}"
    if order != "sort":
        try:
            told = _told(_case())
        except ValueError as error:  # the session has the case twice
            problem = problem or str(error)
        except Exception as error:
            traceback.print_exc()
            problem = problem or f"{type(error).__name__}: {error}"
    return json.dumps({"problem": problem[:1].upper() + problem[1:], "told": told})
