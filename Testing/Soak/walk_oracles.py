# SPDX-License-Identifier: BSD-3-Clause
"""What must hold after the actions of the random walk: no message, no dialog, no empty cell, no
lost stroke; undo and redo lead back; linked views have one zoom; a view drawn anew, the bent volume
baked, and a state that is opened again give the same picture."""
import os
import re
import xml.etree.ElementTree

import numpy
import test_hand as hand
import walk_actions as actions
import window_testing as window
from brainshift_testing import on_screen, picture, structural_similarity
from paraview import servermanager, simple
from paraview.modules.vtkRemotingViews import vtkPVView
from vtkmodules.util.numpy_support import vtk_to_numpy

#: Messages that may come, and why. Whole sentences, as patterns.
EXPECTED = (
    ("^walk$", "window_testing prints the names of its steps"),
    ("Show Evidence is on, but the volume carries no uncertainty", "the walk ticks it anywhere"),
    ("The base lattice was fitted for .* The figures of the fit are not valid for it",
     "the walk changes the kernel of one of two filters"),
    ("The deformation varies so strongly", "strokes of the walk fold tissue"),
    ("The fold guard applied .* of the deformation", "so do its pulls"),
    ("The mask holds back the tissue at the anchor", "the walk pulls outside its mask"),
    ("Without a partner: ", "the walk chooses one list of landmarks only"))

FAR_PIXEL = 0.05  # of full scale, between two ways to draw the same pixel
FAR_PIXELS = 0.003  # share of pixels that may be so far apart: a small view has a scale of colours
BAKED_ALIKE = 0.80  # structural similarity of a bent slice and a baked one


class Wrong(AssertionError):
    """What did not hold."""


def hold(holds, words):
    if not holds:
        raise Wrong(words)


# After each action --------------------------------------------------------------------------------


def no_message():
    told, _ = hand.messages()
    hand.forget_messages()
    bad = [line for line in told if line.strip() and not any(
        re.search(words, line) for words, _ in EXPECTED)]
    hold(not bad, f"Output Messages: {bad}")


def no_dialog():
    said = hand.dialogs()
    hold(not said, f"a dialog came: {said}")


def cells(layout, cell=0):
    """The cells of a layout and their views; None where a cell is empty."""
    if layout.IsSplitCell(cell):
        return [found for side in (1, 2) for found in cells(layout, 2 * cell + side)]
    view = layout.GetView(cell)  # undo can leave one that is gone
    lives = view and servermanager.ProxyManager().GetProxyName("views", view)
    return [(cell, view if lives else None)]


def no_empty_cell():
    for (name, _), layout in simple.GetLayouts().items():
        views = [view for _, view in cells(layout)]
        empty = views.count(None)
        hold(empty in (0, len(views)), f"{empty} of the {len(views)} cells of {name} are empty")


def strokes():
    return {source.SMProxy.GetGlobalID(): tuple(source.Strokes) for source in actions.bent()}


# Now and then -------------------------------------------------------------------------------------


#: Not looked at, by kind of proxy: ParaView moves scales of colours to where there is room, at each
#: picture; a view or display that undo or redo brings back lacks helpers that no picture here
#: shows; so does the animation of a source. A view has no size before it is seen. A crosshair that
#: is moved is no step to undo, so a display that redo brings back shows where it was at first.
#: A view that redo brings back brings its time along, to all views.
#: Where undo takes a display away, ParaView hides its scale of colours, and redo does not show it.
_HELPERS = ("DataAxesGrid", "GlyphType", "OSPRayScaleFunction", "OpacityTransferFunction",
            "PolarAxes", "ScaleTransferFunction", "SliceFunction", "TextureTransform")
PARAVIEWS_OWN = {
    "ScalarBarWidgetRepresentation": (
        "Position", "PositionInfo", "DataRangeMin", "DataRangeMax", "Enabled", "StickyVisible",
        "Visibility"),
    "Contour": ("Locator",),
    "RenderView": ("AxesGrid", "LegendGrid", "PolarGrid", "CameraFocalDisk", "CameraFocalDiskInfo",
                   "ViewSize", "ViewTime"),
    "RepresentationAnimationHelper": ("Source",),
    "UniformGridRepresentation": (*_HELPERS, "SlicePosition"),
    "GeometryRepresentation": _HELPERS}
MAPPED = (" LookupTable", " ScalarOpacityFunction")
MAPS = ("PVLookupTable ", "PiecewiseFunction ", "TransferFunction2D ")
GROUPS = ("sources", "filters", "representations", "views", "misc", "lookup_tables",
          "piecewise_functions")


def state():
    """What a state file would hold now, parsed."""
    path = os.path.join(actions.Files.folder, "now.xml")
    with window.unrecorded():
        servermanager.ProxyManager().SMProxyManager.SaveXMLState(path)
    return xml.etree.ElementTree.parse(path).getroot()


def living(number):
    """The proxy of a number that a state file names; None if it is gone."""
    return servermanager.ProxyManager().SMProxyManager.GetSession().GetRemoteObject(int(number))


def properties():
    """What a state file keeps of all proxies: the values of each property by its proxy's kind and
    number and its name."""
    found = {}
    for proxy in state().iter("Proxy"):
        if proxy.get("group") in GROUPS and proxy.get("type") not in ("TimeKeeper", "PVSMWriter"):
            name = f"{proxy.get('type')} {proxy.get('id')}"
            found[name] = ""
            lives = living(proxy.get("id"))
            for kept in proxy.iter("Property"):
                known = lives.GetProperty(kept.get("name")) if lives else None
                if kept.get("name") in PARAVIEWS_OWN.get(proxy.get("type"), ()) or (
                        known and known.GetInformationOnly()):
                    continue
                values = [part.get("value") for part in kept if part.tag in ("Element", "Proxy")]
                found[f"{name} {kept.get('name')}"] = " ".join(map(str, values))
    return _by_colours(found)


def _by_colours(found):
    """Properties with the colours and opacities of a map in place of its number: undo and redo may
    make it anew."""
    shown = {}
    for kind, points in (("PVLookupTable", "RGBPoints"), ("PiecewiseFunction", "Points")):
        shown.update((name.split()[1], values) for name, values in found.items()
                     if name.startswith(kind) and name.endswith(" " + points))
    return {name: shown.get(values, values) if name.endswith(MAPPED) else values
            for name, values in found.items() if not name.startswith(MAPS)}


def _kind(found, name):
    """In brackets, the representation of a display."""
    kind = found.get(" ".join([*name.split()[:2], "Representation"]))
    return f" ({kind})" if kind else ""


def _alike(left, right):
    """Whether two values are the same but for the last digits of a camera that was rotated."""
    if left == right or left is None or right is None:
        return left == right
    try:
        numbers = [[float(part) for part in value.split()] for value in (left, right)]
    except ValueError:
        return False
    return len(numbers[0]) == len(numbers[1]) and numpy.allclose(*numbers, rtol=1e-12, atol=1e-12)


def undo_and_redo_lead_back(times):
    """Undoes some steps and redoes as many; afterwards all properties are what they were."""
    times = min(times, len(window.undo_labels()))
    labels = window.undo_labels()
    before, kept = properties(), strokes()
    for action in ["actionEditUndo"] * times + ["actionEditRedo"] * times:
        hold(hand.action(action), f"{action} is disabled after {labels[:times]}: "
             f"{window.undo_labels()[:5]}, {window.redo_labels()[:5]}")
        actions.idle(20)
    actions.idle(100)
    hold(strokes() == kept, f"strokes changed by undo and redo of {labels[:times]}")
    after = properties()
    changed = [f"{name}{_kind(after, name)}: {before.get(name)} became {after.get(name)}"
               for name in sorted({*before, *after})
               if not _alike(before.get(name), after.get(name))]
    hold(not changed, f"undo and redo of {labels[:times]} changed {len(changed)}: {changed[:8]}")


def _drawn(view):
    """The displays of a view that it shows. A scale of colours whose Visibility undo has brought
    back is not among them: ParaView shows it only with Enabled, which no state keeps."""
    return [display for display in view.Representations
            if getattr(display, "Visibility", 0) and getattr(display, "Enabled", 1)]


def _shown_as(display):
    """The representation of a display; empty for what has none, such as a scale of colours."""
    chosen = getattr(display, "Representation", None)
    return str(chosen.GetData()) if chosen is not None else ""


def _volumes(view):
    return sum(_shown_as(display) in ("Deformed Volume", "Volume") for display in _drawn(view))


def _copied(display, manager):
    """A display of the same kind and properties that no view has shown."""
    proxy = display.SMProxy
    copy = manager.NewProxy(proxy.GetXMLGroup(), proxy.GetXMLName())
    if proxy.GetProperty("Input"):
        controller = servermanager.vtkSMParaViewPipelineController()
        controller.PreInitializeProxy(copy)
        copy.GetProperty("Input").Copy(proxy.GetProperty("Input"))  # first, as ParaView does
        controller.PostInitializeProxy(copy)
        copy.UpdateVTKObjects()
    copy.Copy(proxy)
    copy.UpdateVTKObjects()
    return copy


def drawn_anew(view, change=lambda copy: None):
    """The picture that another view makes of the same properties, with displays of its own.
    `change`: what to do to each display before."""
    with window.unrecorded():
        return _draw_anew(view, change)


def _draw_anew(view, change):
    manager = servermanager.ProxyManager().SMProxyManager
    view.SMProxy.SynchronizeCameraProperties()
    generic = vtkPVView.GetUseGenericOpenGLRenderWindow()
    vtkPVView.SetUseGenericOpenGLRenderWindow(False)  # it has a window of its own
    try:
        fresh = manager.NewProxy("views", "RenderView")
        fresh.UpdateVTKObjects()
    finally:
        vtkPVView.SetUseGenericOpenGLRenderWindow(generic)
    copies = []
    each = view.SMProxy.NewPropertyIterator()
    each.UnRegister(None)
    while not each.IsAtEnd():
        if each.GetKey() not in ("Representations", "HiddenRepresentations"):
            fresh.GetProperty(each.GetKey()).Copy(each.GetProperty())
        each.Next()
    shown = fresh.GetProperty("Representations")
    for display in _drawn(view):
        copies.append(_copied(display, manager))
        change(copies[-1])
        shown.AddProxy(copies[-1])
    fresh.UpdateVTKObjects()
    fresh.StillRender()
    image = fresh.CaptureWindow(1)
    width, height, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)
    result = pixels[:, :, :3].astype(float) / 255.0
    image.UnRegister(None)
    shown.RemoveAllProxies()
    fresh.UpdateVTKObjects()
    return result


def far_share(left, right):
    """The share of pixels that are far apart in two pictures."""
    return float((numpy.abs(left - right).max(axis=2) > FAR_PIXEL).mean())


def save(name, image):
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkIOImage import vtkPNGWriter
    height, width, _ = image.shape
    data = vtkImageData()
    data.SetDimensions(width, height, 1)
    values = numpy.rint(image.reshape(-1, 3) * 255).astype("uint8")
    data.GetPointData().SetScalars(numpy_to_vtk(values, deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(os.path.join(actions.Files.folder, f"{name}.png"))
    writer.SetInputData(data)
    writer.Write()


def save_both(left, right):
    """Keeps two pictures that should be alike, and the state; returns the names of the files."""
    actions.Files.kept += 1
    names = [f"{side}{actions.Files.kept}" for side in ("left", "right")]
    for name, image in zip(names, (left, right)):
        save(name, image)
    shown = f"shown{actions.Files.kept}.pvsm"
    with window.unrecorded():
        servermanager.ProxyManager().SMProxyManager.SaveXMLState(
            os.path.join(actions.Files.folder, shown))
    return ", ".join([*(f"{name}.png" for name in names), shown])


def same(words, left, right, most=FAR_PIXELS):
    """Holds pictures against each other, and keeps those that differ as files."""
    hold(left.shape == right.shape, f"{words}: {left.shape} and {right.shape} pixels")
    share = far_share(left, right)
    if share > most:
        raise Wrong(f"{words}: {100 * share:.2f} % of the pixels are far apart "
                    f"({save_both(left, right)})")


def rest():
    """Puts tools down, ends flicker, and waits until the window has drawn what is due."""
    hand.take(hand.NONE)
    hand.over()
    if hand.is_checked(actions.FLICKER):
        hand.action(actions.FLICKER)
    actions.idle(700)  # a burst of the wheel ends, and pictures become still


def views_are_drawn_right():
    """What is on the screen is the still picture, and another view draws the same."""
    for view in actions.render_views():
        with window.unrecorded():
            seen = on_screen(view)[:, :, :3] / 255.0
            still = picture(view)
        name = f"view {actions.number(view)}"
        if seen.shape == still.shape:
            same(f"the screen shows an old picture of {name}", seen, still)
        if _volumes(view) < 2:  # two that overlap are blended in the order in which they came
            same(f"{name} drawn anew differs", still, drawn_anew(view))


def linked_views_zoom_together():
    """The cameras of linked slice views, and the properties that are linked, have one zoom."""
    for link in state().iter("PropertyLink"):
        views = [living(part.get("id")) for part in link
                 if part.get("name") == "CameraParallelScale"]
        zooms = {round(zoom, 6) for view in views if view for zoom in (
            view.GetActiveCamera().GetParallelScale(),
            view.GetProperty("CameraParallelScale").GetElement(0))}
        hold(len(zooms) < 2, f"views of {link.get('name')} have the zooms {sorted(zooms)} mm")


def _bent_slices():
    """A view of slices with a bent volume that it shows alone, for planes of two may coincide;
    None if there is none."""
    for view in actions.render_views():
        shown = [display for display in _drawn(view) if _shown_as(display)]
        for display in shown[:len(shown) == 1]:
            source = getattr(display, "Input", None)
            if source is not None and actions.kind_of(source) == "FreeFormDeformation" and (
                    _shown_as(display) == "Deformed Slices"):
                return view, source
    return None


def _show_one_plane(display):
    """Planes hide each other in space, and those of a bent volume are larger than baked ones."""
    for name, shown in (("ShowSagittal", 0), ("ShowCoronal", 0), ("ShowAxial", 1)):
        if display.GetProperty(name):
            display.GetProperty(name).SetElement(0, shown)
    display.UpdateVTKObjects()


def baked_is_alike():
    """A bent volume in slices is drawn as the same volume baked."""
    found = _bent_slices()
    if not found:
        return
    view, source = found
    with window.unrecorded():
        manager = servermanager.ProxyManager().SMProxyManager
        bake = manager.NewProxy("filters", "BakeDeformation")
        bake.GetProperty("Input").SetInputConnection(0, source.SMProxy, 0)
        bake.UpdateVTKObjects()
        bake.UpdatePipeline()

        def keep(copy):
            if view.InteractionMode != "2D":
                _show_one_plane(copy)

        def use(copy):
            keep(copy)
            used = copy.GetProperty("Input")  # a scale of colours has none
            if used and used.GetProxy(0) == source.SMProxy:
                used.SetInputConnection(0, bake, 0)
                copy.UpdateVTKObjects()
        bent, baked = drawn_anew(view, keep), drawn_anew(view, use)
    alike = structural_similarity(bent, baked)
    if alike < BAKED_ALIKE:
        raise Wrong(f"view {actions.number(view)} is unlike the baked volume: {alike:.3f} "
                    f"({save_both(bent, baked)})")


def pictures():
    """Of the views that are seen: their sizes and pixels, by layout and cell. Those of others are
    None."""
    seen = hand.seen_views()
    found = {}
    for (name, _), layout in simple.GetLayouts().items():
        for cell, proxy in cells(layout):
            view = proxy and proxy.GetGlobalID() in seen and servermanager._getPyProxy(proxy)
            found[name, cell] = view and (tuple(view.ViewSize), picture(view)) or None
    return found


def state_comes_back():
    """Saves, empties the window, opens the state: the same cells, strokes and, where the same
    layout is seen in the same size, pictures."""
    path = os.path.join(actions.Files.folder, "kept.pvsm")
    with window.unrecorded():
        before, kept = pictures(), sorted(strokes().values())
    hand.save_state(path)
    hand.reset_session()
    hold(not simple.GetSources(), "the session is not empty after Reset Session")
    hand.load_state(path)
    actions.idle(300)
    hold(sorted(strokes().values()) == kept, "strokes of the state differ")
    with window.unrecorded():
        after = pictures()
    hold(set(after) == set(before), f"the cells {sorted(before)} became {sorted(after)}")
    for cell, found in after.items():
        old, new = before[cell], found
        if old and new and old[0] == new[0]:
            same(f"picture {cell} of the state differs", old[1], new[1])
