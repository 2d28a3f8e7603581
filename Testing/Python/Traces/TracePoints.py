# SPDX-License-Identifier: BSD-3-Clause
# Proves that Trace Points are opaque in front of the tissue of a Deformed Volume, and faded,
# hidden or shown behind it by choice. This holds in both projections, for several volumes, beside
# surfaces and with a server. Strokes uncover points. Neither points nor their colours make the
# renderer cast the volume again.
import numpy
from brainshift_testing import (ball, load_plugin, look, on_server, picture, run_tests, scratch,
                                server_finds_plugin, show_volume, view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    CSVReader, Calculator, ClearSelection, ColorBy, Delete, FreeFormDeformation,
    GetColorTransferFunction, Hide, PolyPointSource, Render, SelectSurfacePoints, Show, Sphere,
    TableToPoints, ThresholdTable, Wavelet)

MIDDLE = numpy.array((16.0, 16.0, 16.0))  # of a ball of radius 9, green, seen along -z
GREEN, RED, BLACK = (0, 1, 0), (1, 0, 0), (0, 0, 0)
COLORS = [0, *GREEN, 100, *GREEN]
OPAQUE = [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 1, 0.5, 0, 100, 1, 0.5, 0]
FAINT = [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 0.01, 0.5, 0, 100, 0.01, 0.5, 0]
SINK = brainshift.soft(MIDDLE, (0, 0, -6.0), 1000.0, sigma=5.0)  # all of it, by 6 mm
# In front of the ball, within it, behind it, beside it.
FRONT, WITHIN, BEHIND, BESIDE = (12, 12, 28), (19, 12, 22), (12, 19, 4), (16, 29, 4)
PLACES = (FRONT, WITHIN, BEHIND, BESIDE)
SIZE, HALF_HEIGHT, DISTANCE = 120, 18.0, 200.0


class Scene:
    def __init__(self, points=PLACES, parallel=True, opacities=OPAQUE):
        self.bent = FreeFormDeformation(Input=volume(ball()))
        self.view = view_along((0, 0, -1), MIDDLE, DISTANCE, size=SIZE,
                               half_height=HALF_HEIGHT if parallel else None)
        self.view.CameraViewAngle = 12.0
        self.volume = show_volume(self.bent, self.view, "Deformed Volume", COLORS, opacities)
        self.source = PolyPointSource(Points=numpy.ravel(points).tolist())
        self.traces = show_traces(self.source, self.view)

    def pixel(self, place):
        """The colour (0 to 1) where a place is seen."""
        image = picture(self.view)
        column, row = self.place_in_picture(numpy.array(place, float))
        return image[row, column]

    def place_in_picture(self, place):
        half = HALF_HEIGHT
        if not self.view.CameraParallelProjection:
            depth = MIDDLE[2] + DISTANCE - place[2]
            half = depth * numpy.tan(numpy.radians(self.view.CameraViewAngle / 2))
        column, row = ((place[:2] - MIDDLE[:2]) / half + 1) * SIZE / 2
        return int(column), int(row)

    def colors(self, *places):
        return [tuple(self.pixel(place).round(2)) for place in places]

    def frames(self):
        """Pictures of the volume that were cast to draw the view once more."""
        before = brainshift.counters(self.volume)["frames"]
        picture(self.view)
        return brainshift.counters(self.volume)["frames"] - before


def show_traces(source, view):
    traces = Show(source, view, "GeometryRepresentation")
    traces.SetRepresentationType("Trace Points")
    traces.DiffuseColor = traces.AmbientColor = RED
    traces.TraceRadius, traces.HiddenOpacity = 0.8, 0.25
    return traces


def assert_close(colors, expected, what):
    assert numpy.abs(numpy.array(colors) - expected).max() < 0.06, (what, colors, expected)


def mixed(share):
    return tuple(share * numpy.array(RED) + (1 - share) * numpy.array(GREEN))


def test_faded_hidden_or_shown():
    for parallel in (True, False):
        scene = Scene(parallel=parallel)
        assert scene.traces.HiddenPoints == "Fade"
        for hidden, opacity, behind in (("Fade", 0.25, mixed(0.25)), ("Fade", 0.6, mixed(0.6)),
                                        ("Hide", 0.6, GREEN), ("Show", 0.6, RED)):
            scene.traces.HiddenPoints, scene.traces.HiddenOpacity = hidden, opacity
            assert_close(scene.colors(*PLACES), (RED, behind, behind, RED),
                         (parallel, hidden, opacity))
        Delete(scene.view)


def test_strokes_uncover_and_cover():
    scene = Scene()
    assert_close(scene.colors(WITHIN), [mixed(0.25)], "within the ball")
    scene.bent.Strokes = SINK
    assert_close(scene.colors(WITHIN, BEHIND), (RED, mixed(0.25)), "the ball has sunk")
    scene.bent.Strokes = []
    assert_close(scene.colors(WITHIN), [mixed(0.25)], "taken back")
    Delete(scene.view)


def test_a_crowd_is_as_faint_as_one_point():
    crowd = [(12 + 0.05 * i, 12, 4 + 0.1 * i) for i in range(20)]
    scene = Scene(points=crowd)
    assert_close(scene.colors(crowd[-1]), [mixed(0.25)], "twenty points in a row")
    Delete(scene.view)


def test_faded_points_hide_a_set_drawn_later():
    scene = Scene(points=[12, 19, 14])
    traces = show_traces(PolyPointSource(Points=[12, 19, 4]), scene.view)
    traces.DiffuseColor = traces.AmbientColor = (0, 0, 1)
    assert_close(scene.colors((12, 19, 14)), [mixed(0.25)], "red alone")
    Delete(scene.view)


def test_translucent_points_are_blended_once():
    scene = Scene(points=[(16 + 0.05 * i, 16, 38 - i) for i in range(5)])
    scene.traces.HiddenPoints, scene.traces.Opacity = "Show", 0.5
    assert_close(scene.colors((16.1, 16, 36)), [mixed(0.5)], "in front of tissue")
    Delete(scene.view)


def test_the_first_radius_suits_any_view():
    for parallel in (True, False):
        for distance_factor in (1, 40):
            scene = Scene(points=[FRONT], parallel=parallel)
            scene.traces.TraceRadius, scene.volume.Visibility = 0, 0
            scene.view.CameraParallelScale = HALF_HEIGHT * distance_factor
            scene.view.CameraViewAngle = 12.0 if distance_factor == 1 else 160.0
            drawn = (picture(scene.view)[:, :, 0] > 0.3).sum()
            assert 40 <= drawn <= 60, (drawn, "a ball of 4 pixels")
            scene.view.PPI = 144  # a screen at 200 %
            drawn = (picture(scene.view)[:, :, 0] > 0.3).sum()
            assert 170 <= drawn <= 230, (drawn, "a ball of 8 pixels")
            scene.view.PPI = 72
            scene.traces.TraceRadius = 0.001
            assert 4 <= (picture(scene.view)[:, :, 0] > 0.3).sum() <= 12, "a ball of 1.5 pixels"
            Delete(scene.view)


def test_the_first_radius_suits_the_points():
    wide = [(16 + 200 * x, 16, 16) for x in (-1, 0, 1)]
    scene = Scene(points=wide, opacities=FAINT)
    scene.traces.TraceRadius = 0
    Render(scene.view)  # selecting does, and the first time moves the camera
    look(scene.view, (0, 0, -1), MIDDLE, DISTANCE)
    scene.view.CameraParallelScale = 20.0  # a ball of 4 mm, a hundredth of their extent
    drawn = (picture(scene.view)[:, :, 0] > 0.3).sum()
    assert abs(drawn - numpy.pi * (4 * SIZE / 40) ** 2) < 40, drawn
    rim = [SIZE // 2 + 8, SIZE // 2, SIZE // 2 + 9, SIZE // 2 + 1]
    assert selected(scene, rim) == [1], "the ball is selected at its rim"
    assert selected(scene, [side + 8 for side in rim]) == [], "beside it"
    Delete(scene.view)


def test_the_volume_is_not_cast_again():
    scene = Scene()
    picture(scene.view)
    assert scene.frames() == 0, "nothing changed"
    changes = {
        "position": lambda: setattr(scene.source, "Points", (numpy.ravel(PLACES) + 1).tolist()),
        "outside of all that was seen": lambda: setattr(
            scene.source, "Points", [*numpy.ravel(PLACES), 16, 16, 90, 16, 16, -90]),
        "color": lambda: setattr(scene.traces, "DiffuseColor", (0, 0, 1)),
        "radius": lambda: setattr(scene.traces, "TraceRadius", 2.0),
        "hidden": lambda: setattr(scene.traces, "HiddenPoints", "Hide"),
        "opacity": lambda: setattr(scene.traces, "Opacity", 0.5)}
    for what, change in changes.items():
        before = picture(scene.view)
        change()
        assert scene.frames() == 0, what
        assert (picture(scene.view) != before).any(), (what, "is not seen")
    scene.view.CameraPosition = [26, 16, 200]
    assert scene.frames() == 1, "another camera"
    scene.bent.Strokes = SINK
    assert scene.frames() == 1, "a stroke"
    scene.volume.Opacity = 1.0
    Delete(scene.view)


def test_what_the_clipping_planes_cut_is_cast_again():
    # The eye is in the ball. There the near plane decides what is seen, and it follows the points.
    scene = Scene(points=[WITHIN, (16, 16, -300)], parallel=False, opacities=FAINT)
    scene.view.CameraPosition = [16, 16, 18]
    picture(scene.view)
    scene.source.Points = [*WITHIN, 16, 16, -3000]
    assert scene.frames() == 1
    Delete(scene.view)


def test_a_kept_picture_is_the_one_cast():
    scene = Scene()
    picture(scene.view)
    scene.source.Points = [*numpy.ravel(PLACES), 16, 22, 40]
    kept = picture(scene.view)
    scene.volume.SampleDistance = 0.4
    picture(scene.view)
    scene.volume.SampleDistance = 0.0
    assert numpy.abs(picture(scene.view) - kept).max() < 0.01
    Delete(scene.view)


def test_faint_tissue_hides_nothing():
    scene = Scene(opacities=FAINT)
    assert_close(scene.colors(*PLACES), [RED] * 4, "all points are seen")
    Delete(scene.view)


def test_the_nearest_of_two_volumes_hides():
    scene = Scene(points=[FRONT, BESIDE])
    other = volume(ball(), origin=(0, 0, 30))
    show_volume(other, scene.view, "Deformed Volume", [0, 0, 0, 1, 100, 0, 0, 1], OPAQUE)
    assert_close(scene.colors(FRONT, BESIDE), ((0.25, 0, 0.75), RED), "a blue ball in front")
    Hide(other, scene.view)
    assert_close(scene.colors(FRONT), [RED], "and without it")
    Delete(scene.view)


def test_surfaces_hide_points_whatever_is_chosen():
    scene = Scene()
    plane = Sphere(Center=(16, 16, 40), Radius=6.0)
    display = Show(plane, scene.view)
    display.AmbientColor = display.DiffuseColor = (0, 0, 1)
    display.Ambient, display.Diffuse = 1.0, 0.0
    for hidden in ("Fade", "Show"):
        scene.traces.HiddenPoints = hidden
        assert_close(scene.colors(FRONT, WITHIN, BEHIND), [(0, 0, 1)] * 3, hidden)
    assert_close(scene.colors(BESIDE), [RED], "beside the surface")
    Delete(scene.view)


def test_without_a_volume_they_are_points():
    scene = Scene()
    Hide(scene.bent, scene.view)
    assert_close(scene.colors(*PLACES, (16, 3, 4)), [RED] * 4 + [BLACK], "points alone")
    Delete(scene.view)


def test_colors_of_an_array():
    scene = Scene()
    Hide(scene.source, scene.view)
    heights = Calculator(Input=scene.source, Function="coordsZ", ResultArrayName="height")
    traces = show_traces(heights, scene.view)
    ColorBy(traces, ("POINTS", "height"))
    colors = GetColorTransferFunction("height")
    colors.ColorSpace = "RGB"
    colors.RGBPoints = [4, 1, 0, 1, 28, 1, 1, 0]
    traces.SetScalarBarVisibility(scene.view, False)
    assert_close(scene.colors(FRONT, BESIDE), ((1, 1, 0), (1, 0, 1)), "by height")
    assert_close(scene.colors(BEHIND), [(0.25, 0.75, 0.25)], "by height, faded")
    colors.RGBPoints = [4, 0, 0, 1, 28, 0, 0, 1]
    assert scene.frames() == 0, "another colour map of the points"
    assert_close(scene.colors(FRONT, BESIDE), [(0, 0, 1)] * 2, "another map")
    Delete(scene.view)


def test_points_up_to_a_moment():
    scene = Scene()
    Hide(scene.source, scene.view)
    with open(scratch("timed.csv"), "w", encoding="utf-8") as file:
        file.write("time,x,y,z\n")
        for time, point in enumerate(PLACES):
            file.write(",".join(str(number) for number in (time, *point)) + "\n")
    rows = ThresholdTable(Input=CSVReader(FileName=[scratch("timed.csv")]),
                          Column=["ROWS", "time"], MinValue=0.0, MaxValue=1.0)
    show_traces(TableToPoints(Input=rows, XColumn="x", YColumn="y", ZColumn="z"), scene.view)
    assert_close(scene.colors(*PLACES), (RED, mixed(0.25), GREEN, BLACK), "the first two")
    rows.MaxValue = 3.0
    assert scene.frames() == 0, "later"
    assert_close(scene.colors(*PLACES), (RED, mixed(0.25), mixed(0.25), RED), "all of them")
    Delete(scene.view)


def selected(scene, whole):
    SelectSurfacePoints(Rectangle=whole, View=scene.view)
    selection = scene.source.GetSelectionInput(0)
    found = []
    if selection and selection.GetProperty("Input").GetNumberOfProxies():
        pairs = selection.GetProperty("Input").GetProxy(0).GetProperty("IDs")
        found = sorted(pairs.GetElement(i) for i in range(1, pairs.GetNumberOfElements(), 2))
    ClearSelection(scene.source)
    return found


def test_tissue_hides_from_selections():
    # One row of points is in front of the ball, another behind it. In the corners ParaView's insets
    # write into the depths of the picture.
    row = [(x, 12.3 + 0.23 * x, z) for z in (30, 2) for x in range(13, 20)]
    for parallel in (True, False):
        scene = Scene(points=row, parallel=parallel)
        Render(scene.view)  # selecting does, and the first time moves the camera
        for aside in ((0, 0, 0), (12, 12, 0), (-12, -12, 0)):
            look(scene.view, (0.1, 0.2, -1), MIDDLE + aside, DISTANCE)
            found = selected(scene, [0, 0, SIZE - 1, SIZE - 1])
            assert found == list(range(len(row) // 2)), (parallel, aside, found)
        Delete(scene.view)


def test_with_a_server():
    def question():
        # The data is made on the server. High values of the wavelet make a ball.
        wave = Wavelet(WholeExtent=[-12, 12, -12, 12, -12, 12])
        view = view_along((0, 0, -1), (0, 0, 0), DISTANCE, size=SIZE, half_height=HALF_HEIGHT)
        display = show_volume(FreeFormDeformation(Input=wave), view, "Deformed Volume",
                              [0, *GREEN, 400, *GREEN],
                              [0, 0, 0.5, 0, 150, 0, 0.5, 0, 160, 1, 0.5, 0, 400, 1, 0.5, 0],
                              array="RTData")
        points = PolyPointSource(Points=[0, 0, 30, 5, 0, -30, 16, 16, 0])
        traces = show_traces(points, view)
        before = picture(view)
        frames = brainshift.counters(display)["frames"]
        traces.HiddenPoints = "Hide"
        after = picture(view)
        again = brainshift.counters(display)["frames"] - frames
        at = [int((place / HALF_HEIGHT + 1) * SIZE / 2) for place in (0, 5, 16)]
        return [image[row, column] for image in (before, after)
                for row, column in ((at[0], at[0]), (at[0], at[1]), (at[2], at[2]))], again

    colors, again = on_server(question, **server_finds_plugin())
    assert_close(colors, (RED, mixed(0.25), RED, RED, GREEN, RED), "faded, then hidden")
    assert again == 0, again


run_tests(globals())
