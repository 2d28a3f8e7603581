# SPDX-License-Identifier: BSD-3-Clause
"""What the random walk does in ParaView's window. An action is a generator: it finds out whether it
is possible, says in words what it will do, and does it when it is resumed. One that says nothing
was impossible."""
import os
import time

import test_hand as hand
import window_testing as window
from paraview import servermanager, simple

MOST_SOURCES, MOST_VIEWS, MOST_LAYOUTS = 7, 5, 3
FLICKER = "actionBrainShiftFlicker"
TOOLS = {"Move": hand.MOVE, "Soft": hand.SOFT, "Stamp": hand.STAMP, "Pull": hand.PULL}
#: Filters of one input in the menu, and how often each is chosen.
FILTERS = {"FreeFormDeformation": 6, "BakeDeformation": 1, "DeformationField": 1,
           "FitDeformation": 1, "DeformationLattice": 1, "Contour": 1}
#: Of a bent volume only, others of others.
OF_BENT = ("BakeDeformation", "DeformationField", "DeformationLattice")
LATTICES = ("FitDeformation", "DeformationLattice", "RefinedLattice", "DeformationField")
KINDS = ("Deformed Volume", "Deformed Slices", "Outline", "Slice")
LISTS = {"SliceComparison": ("None", "Two colours", "Checkerboard", "Difference", "Wipe"),
         "VolumeComparison": ("Off", "Two colours"),
         "ComparisonColors": ("Red and green", "Blue and orange"),
         "Show": ("Both", "Deformed", "Reference"), "Kernel": ("B-Spline", "Catmull-Rom"),
         "Inverse": ("Exact", "Negated"), "SliceInterpolation": ("Linear", "Nearest neighbour"),
         "WorldAxes": ("RAS", "LPS", "From the data")}
BOXES = ("GuardFolding", "ShowCrosshair", "OrientationMarks", "ShowEvidence", "DrawSegment",
         "ShowAxial", "ShowSagittal", "Evidence", "Shade")
KEYS = ("o", "i", "x", "+", "-", " ", "Escape", "PgUp")
SPLITS = ("Split Horizontal Axis", "Split Vertical Axis")
LOOKS = ("Skin", "Brain", "Bone", "See-through", "Vessels")
CAMERAS = ("actionResetCamera", "actionPositiveX", "actionNegativeZ", "actionIsometricView",
           "actionZoomToData", "actionRotate90degCW")
COLOURS = ("actionScalarBarVisibility", "actionResetRange", "actionRescaleVisibleRange")


class Files:
    """What there is to open, and where states are kept."""

    volumes, labels, points, folder = [], [], [], ""
    states = 0
    kept = 0  # pairs of pictures that should have been alike

    @classmethod
    def state(cls):
        return os.path.join(cls.folder, "walk.pvsm")


def idle(milliseconds=0):
    """Lets the window do what is due and else sleeps, as a window does without a hand."""
    end = time.monotonic() + milliseconds / 1000.0
    hand.wait()
    while time.monotonic() < end:
        time.sleep(0.01)
        hand.wait()


# What there is -----------------------------------------------------------------------------------


def sources():
    """All of the pipeline, oldest first."""
    return sorted(simple.GetSources().values(), key=lambda source: source.SMProxy.GetGlobalID())


def kind_of(source):
    return source.SMProxy.GetXMLName()


def name_of(source):
    manager = servermanager.ProxyManager()
    return manager.GetProxyName("sources", source.SMProxy)


def is_applied(source):
    """Whether it has data: a new filter has none before Apply."""
    return bool(source.SMProxy.GetOutputPortsCreated()) and (
        source.GetDataInformation().GetDataSetType() >= 0)


def is_volume(source):
    return is_applied(source) and source.GetDataInformation().DataSetTypeIsA("vtkImageData")


def scalar_volumes():
    """Volumes with numbers of one component, which one can bend and compare."""
    return [source for source in sources() if is_volume(source) and (
        kind_of(source) not in LATTICES) and (
        source.PointData.GetNumberOfArrays() > 0
        and source.PointData.GetArray(0).GetNumberOfComponents() == 1)]


def is_bent(source):
    """Whether a volume carries a deformation, which can be bent no further."""
    return is_applied(source) and source.GetDataInformation().GetFieldDataInformation(
        ).GetArrayInformation("FFDDisplacements") is not None


def bent():
    return [source for source in sources() if kind_of(source) == "FreeFormDeformation"]


def is_used(source):
    """Whether a filter is made of it."""
    for other in sources():
        for name in other.ListProperties():
            kept = other.SMProxy.GetProperty(name)
            if kept is not None and kept.IsA("vtkSMInputProperty") and any(
                    kept.GetProxy(i) == source.SMProxy for i in range(kept.GetNumberOfProxies())):
                return True
    return False


def render_views():
    """Those on the screen, oldest first."""
    seen = hand.seen_views()
    return sorted((view for view in simple.GetRenderViews() if view.SMProxy.GetGlobalID() in seen),
                  key=lambda view: view.SMProxy.GetGlobalID())


def number(view):
    return view.SMProxy.GetGlobalID()


def pixel(chance, view, share=0.5):
    """In the middle part of a view."""
    return [round(side * (0.5 + share * (chance.random() - 0.5))) for side in view.ViewSize]


def activate(source):
    hand.select(source)
    idle(20)


# Actions -----------------------------------------------------------------------------------------


def open_file(chance):
    if len(sources()) >= MOST_SOURCES:
        return
    path = chance.choice(Files.volumes + Files.labels + Files.points)
    yield f"open {os.path.relpath(path, Files.folder)}"
    hand.open_file(path)
    apply_it()


def apply_it():
    idle(20)
    hand.click("Accept")
    idle(50)


def accept(_):
    yield "press Apply"
    apply_it()


def add_filter(chance):
    if not sources() or len(sources()) >= MOST_SOURCES:
        return
    active = chance.choice(sources()) if chance.random() < 0.4 else simple.GetActiveSource()
    name = chance.choices(list(FILTERS), FILTERS.values())[0]
    if active is None or not is_volume(active) or is_bent(active) != (name in OF_BENT) or (
            name == "FreeFormDeformation" and active not in scalar_volumes()):
        return
    yield f"{name} of {name_of(active)}"
    activate(active)
    hand.create_filter(name)
    if chance.random() < 0.85:
        apply_it()


def compare(chance):
    volumes = scalar_volumes()
    if len(volumes) < 2 or len(sources()) >= MOST_SOURCES:
        return
    first = chance.choice(bent()) if bent() and chance.random() < 0.7 else chance.choice(volumes)
    other = chance.choice([volume for volume in volumes if volume != first])
    if not is_applied(first):
        return
    yield f"CompareVolumes of {name_of(first)} with {name_of(other)}"
    hand.create_filter_of_two("CompareVolumes", first, "Reference", other)
    apply_it()


#: What fits into each list of the panel, by the kinds of sources.
ATTACHED = {"FreeFormDeformation": {
    "Mask": ("NRRDVolumeReader",), "Segmentation": ("NRRDVolumeReader",),
    "Lattice": ("FitDeformation", "DeformationLattice", "RefinedLattice")},
    "FitDeformation": {"RestLandmarks": ("LandmarkReader",), "MeasuredLandmarks": (
        "LandmarkReader",), "Segmentation": ("NRRDVolumeReader",)}}


def attach(chance):
    """A mask, a segmentation, a lattice or landmarks, in the lists of the panel."""
    able = [source for source in sources() if kind_of(source) in ATTACHED]
    if not able:
        return
    source = chance.choice(able)
    name, kinds = chance.choice(list(ATTACHED[kind_of(source)].items()))
    fitting = [other for other in sources() if kind_of(other) in kinds and is_applied(other)]
    other = chance.choice([None, *fitting])
    entry = "None" if other is None else name_of(other)
    yield f"choose {entry} as {name} of {name_of(source)}"
    activate(source)
    if hand.choose(name, entry) and chance.random() < 0.8:
        apply_it()


def select(chance):
    if not sources():
        return
    source = chance.choice(sources())
    yield f"select {name_of(source)}"
    activate(source)


def click_eye(chance):
    shown = [source for source in sources() if is_applied(source)]
    if not shown or simple.GetActiveView() is None:
        return
    source = chance.choice(shown)
    yield f"click the eye of {name_of(source)}"
    hand.click_eye(source)


def delete(chance):
    free = [source for source in sources() if not is_used(source)]
    if not free or (len(sources()) < MOST_SOURCES - 3 and chance.random() < 0.6):
        return
    source = chance.choice(free)
    yield f"delete {name_of(source)}"
    activate(source)
    hand.delete_selected()


def delete_tree(chance):
    if len(sources()) < 5:
        return
    source = chance.choice(sources())
    yield f"delete {name_of(source)} and what is made of it"
    activate(source)
    hand.delete_selected(downstream=True)


def four_views(_):
    if len(simple.GetRenderViews()) >= MOST_VIEWS or len(simple.GetLayouts()) >= MOST_LAYOUTS:
        return
    yield "Four Views"
    hand.action("actionBrainShiftFourViews")
    idle(100)


def take_tool(chance):
    name = chance.choice(list(TOOLS))
    yield f"press the button {name}"
    hand.action("actionBrainShift" + name)


def stroke(chance):
    """With a tool in hand, in a view that shows the active deformation, or any."""
    views = render_views()
    if not views or not bent():
        return
    name, view = chance.choice(list(TOOLS)), chance.choice(views)
    start = pixel(chance, view)
    end = [at + chance.randint(-18, 18) for at in start]
    turns = chance.choice((0, 0, 1, -1, 2)) if name == "Stamp" else 0
    yield f"{name} in view {number(view)} from {start} to {end}, {turns} clicks of the wheel"
    source = chance.choice(bent())
    if simple.GetActiveSource() not in bent():
        activate(source)
    hand.take(TOOLS[name])
    hand.over(view)
    if turns:
        hand.hover(start)
        hand.wheel(start, turns)
        idle(chance.choice((0, 700)))
    else:
        hand.drag(start, end, steps=2, modifiers=chance.choice((0, 0, 0, hand.SHIFT)))
    hand.over()
    if chance.random() < 0.5:
        hand.take(hand.NONE)


def cancelled_stroke(chance):
    views = render_views()
    if not views or not bent():
        return
    view, name = chance.choice(views), chance.choice(("Move", "Soft", "Stamp", "Pull"))
    start = pixel(chance, view)
    yield f"{name} in view {number(view)} from {start}, and Escape"
    hand.take(TOOLS[name])
    hand.over(view)
    hand.hover(start)
    hand.press(start)
    hand.drag_to([at + 12 for at in start])
    idle()
    hand.tap(hand.ESCAPE)
    hand.release([at + 12 for at in start])
    hand.over()
    hand.take(hand.NONE)


def click_view(chance):
    views = render_views()
    if not views:
        return
    view = chance.choice(views)
    at = pixel(chance, view)
    yield f"click view {number(view)} at {at}"
    simple.SetActiveView(view)
    hand.over(view)
    hand.drag(at, at, steps=1)
    hand.over()


def move_camera(chance):
    """Turns, zooms, steps through slices, drags grey values, by mouse and wheel without a tool."""
    views = render_views()
    if not views:
        return
    view, way = chance.choice(views), chance.choice(("drag", "right drag", "wheel", "shift drag",
                                                     "control wheel", "double click"))
    start = pixel(chance, view, 0.8)
    end = [at + chance.randint(-25, 25) for at in start]
    yield f"{way} in view {number(view)} from {start} to {end}"
    hand.take(hand.NONE)
    hand.over(view)
    if way == "wheel":
        hand.wheel(start, chance.choice((-2, -1, 1, 2)))
    elif way == "control wheel":
        hand.wheel(start, chance.choice((-2, -1, 1, 2)), hand.CONTROL)
    elif way == "right drag":
        hand.right_drag(start, end, steps=2)
    elif way == "double click":
        hand.double_click(start)
    else:
        hand.drag(start, end, steps=2, modifiers=hand.SHIFT if way == "shift drag" else 0)
    hand.over()


def press_key(chance):
    views = render_views()
    if not views:
        return
    view, key = chance.choice(views), chance.choice(KEYS)
    at = pixel(chance, view)
    yield f"key {key} in view {number(view)} at {at}"
    hand.over(view)
    hand.hover(at)
    if key == "o":
        hand.key_down(key)
        idle(50)
        hand.key_up(key)
    else:
        hand.tap({"Escape": hand.ESCAPE, "PgUp": hand.PAGE_UP}.get(key, key))
        if key == " ":
            hand.tap(" ")
    hand.over()


def flicker(_):
    yield "press Flicker"
    hand.action(FLICKER)


def undo(chance):
    times = chance.choice((1, 1, 1, 2, 3, 6))
    yield f"undo {times} of {window.undo_labels()[:times]}"
    for _ in range(times):
        hand.action("actionEditUndo")
        idle(20)
    finish_split("actionEditUndo")


def redo(chance):
    times = chance.choice((1, 1, 2, 3, 6))
    yield f"redo {times}"
    for _ in range(times):
        hand.action("actionEditRedo")
        idle(20)
    finish_split("actionEditRedo")


def finish_split(action):
    """ParaView splits a cell in two steps, Split View and Create Render View. Between the two a
    cell is empty."""
    if window.redo_labels()[:1] == ["Create Render View"]:
        hand.action(action)
        idle(20)


def close_view(chance):
    views = render_views()
    if len(views) < 2 and chance.random() < 0.8 or not views:
        return
    view = chance.choice(views)
    yield f"close view {number(view)}"
    hand.press_frame(view, "Close")


def split_view(chance):
    views = render_views()
    if not views or len(simple.GetRenderViews()) >= MOST_VIEWS:
        return
    view, way = chance.choice(views), chance.choice(SPLITS)
    yield f"{way} of view {number(view)}"
    if hand.press_frame(view, way):
        hand.fill_frame()


def maximize(chance):
    views = render_views()
    if not views:
        return
    view = chance.choice(views)
    yield f"maximize or restore view {number(view)}"
    if not hand.press_frame(view, "Restore"):
        hand.press_frame(view, "Maximize")


def new_layout(_):
    if len(simple.GetLayouts()) >= MOST_LAYOUTS:
        return
    yield "new layout"
    hand.new_layout()
    hand.fill_frame()


def show_layout(chance):
    count = len(simple.GetLayouts())
    if count < 2:
        return
    tab = chance.randrange(count)
    yield f"show layout {tab}"
    hand.show_layout(tab)


def close_layout(chance):
    count = len(simple.GetLayouts())
    if count < 2:
        return
    tab = chance.randrange(count)
    yield f"close layout {tab}"
    hand.close_layout(tab)


def choose_kind(chance):
    if simple.GetActiveSource() is None or not is_volume(simple.GetActiveSource()):
        return
    kind = chance.choices(KINDS, (5, 4, 1, 1))[0]
    yield f"show {name_of(simple.GetActiveSource())} as {kind}"
    hand.choose("Representation", kind)


def choose_in_list(chance):
    name = chance.choice(list(LISTS))
    entry = chance.choice(LISTS[name])
    if hand.is_enabled(name) is None:
        return
    yield f"choose {entry} as {name}"
    hand.choose(name, entry)
    if chance.random() < 0.5:
        apply_it()


def tick(chance):
    shown = [name for name in BOXES if hand.is_enabled(name)]
    if not shown:
        return
    name = chance.choice(shown)
    yield f"tick {name}"
    hand.click(name)
    apply_it()


def choose_look(chance):
    name = chance.choice(LOOKS)
    yield f"look {name}"
    hand.click(name)


def use_toolbar(chance):
    name = chance.choices((*CAMERAS, *COLOURS, "actionVCRNextFrame", "actionVCRFirstFrame",
                           "actionBrainShiftReset"), (2,) * 6 + (1,) * 3 + (2, 1, 1))[0]
    yield f"press {name}"
    hand.action(name)


def tick_stroke(chance):
    row = chance.randint(0, 3)
    if hand.cell("BrainShiftStrokes", row, 0) is None:
        return
    yield f"tick stroke {row + 1}"
    hand.click_cell("BrainShiftStrokes", row, check=True)


def run(chance):
    """Refines or aligns a few steps, and stops or cancels."""
    name = chance.choice(("BrainShiftRefine", "BrainShiftAlign"))
    if name == "BrainShiftRefine" and hand.is_visible(name + "Open") and not hand.is_visible(name):
        hand.click(name + "Open")
    if not hand.is_visible(name):
        return
    end = chance.choice(("Stop", "Escape"))
    yield f"{name}, then {end}"
    if not hand.click(name):
        return
    idle(300)
    hand.tap(hand.ESCAPE) if end == "Escape" else hand.click(name + "Stop")
    idle(100)


def resize(chance):
    size = chance.choice(((760, 560), (860, 620), (700, 520)))
    yield f"resize the window to {size}"
    hand.resize_window(*size)


def save_state(_):
    yield "save the state"
    hand.save_state(Files.state())
    Files.states += 1


def load_state(chance):
    if not Files.states or chance.random() < 0.3:
        return
    yield "reset the session and load the state"
    hand.take(hand.NONE)
    hand.reset_session()
    hand.load_state(Files.state())
    idle(100)


def begin():
    """A window after its start has one empty view."""
    hand.take(hand.NONE)
    simple.GetActiveViewOrCreate("RenderView")


#: How often each is chosen, and whether strokes may change in it.
ACTIONS = {open_file: (8, False), accept: (2, False), add_filter: (7, False),
           compare: (3, False), attach: (4, True), select: (6, False), click_eye: (4, False),
           delete: (5, True), delete_tree: (2, True), four_views: (4, False),
           take_tool: (2, False), stroke: (14, True), cancelled_stroke: (2, True),
           click_view: (4, True), move_camera: (8, True), press_key: (4, True),
           flicker: (1, False), undo: (9, True), redo: (6, True), close_view: (3, False),
           split_view: (1, False), maximize: (1, False), new_layout: (2, False),
           show_layout: (3, False), close_layout: (2, False), choose_kind: (4, False),
           choose_in_list: (4, False), tick: (3, False), choose_look: (2, False),
           use_toolbar: (4, True), tick_stroke: (2, True), run: (2, True),
           resize: (1, False), save_state: (2, False), load_state: (1, True)}


def choose(chance):
    """A possible action: its words, what carries it out, and whether strokes may change."""
    while True:
        if not scalar_volumes() and chance.random() < 0.5:
            function = open_file
        elif not bent() and chance.random() < 0.3:
            function = add_filter
        else:
            function = chance.choices(
                list(ACTIONS), [weight for weight, _ in ACTIONS.values()])[0]
        steps = function(chance)
        words = next(steps, None)
        if words is not None:
            return words, steps, ACTIONS[function][1]
