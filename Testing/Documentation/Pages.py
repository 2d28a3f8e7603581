# SPDX-License-Identifier: BSD-3-Clause
# Proves that each filter, reader, writer and representation has a page with its properties and a
# picture, and that the generated references hold what they are generated from.
import re

from documents import (
    PAGES, format_reference, property_reference, python_reference, run_tests, similarity_reference,
    text_of)

MARKER = re.compile(r"<!-- properties: (\w+) -->")


def pages_by_proxy():
    return {proxy: page for page in PAGES.rglob("*.md") for proxy in MARKER.findall(text_of(page))}


def test_every_proxy_has_a_page_with_a_picture():
    pages = pages_by_proxy()
    for proxy in property_reference.public_proxies():
        assert proxy.name in pages, f"no page holds <!-- properties: {proxy.name} -->"
        text = text_of(pages[proxy.name])
        assert re.search(r"!\[[^\]]+\]\([^)]+\.png\)", text), f"no picture on {pages[proxy.name]}"


def test_markers_name_proxies():
    names = {proxy.name for proxy in property_reference.public_proxies()}
    unknown = set(pages_by_proxy()) - names
    assert not unknown, f"the XML has no {sorted(unknown)}"


def test_a_page_lists_the_similarities():
    table = similarity_reference.table()
    assert table.count("\n") >= 4 and '| `"auto"` | For volumes of any contrast.' in table, table
    assert any("<!-- similarities -->" in text_of(page) for page in PAGES.rglob("*.md"))


def test_a_page_lists_the_formats():
    page = text_of(PAGES / "formats.md")
    for item in format_reference.formats():
        assert f"| {item.table['format']} | {item.table['read']} |" in page, item.name
    assert "| tracts, read | MRtrix `.tck`, `.tck.gz`; TrackVis `.trk`, `.trk.gz`; TRX" in page
    assert "| tracts, written | MRtrix `.tck`; TrackVis `.trk`; TRX `.trx` |" in page
    assert "| transforms, read | ITK, Slicer `.tfm`, `.txt`; ITK, ANTs `.h5`, `.hdf5`;" in page
    assert "| `.lta` | FreeSurfer |" in text_of(PAGES / "filters" / "displacement-field-files.md")


def test_readers_have_the_words_of_their_folders():
    made = {root.find(".//SourceProxy").get("name"): root for root in format_reference.proxies()}
    short = {name: root.find(".//SourceProxy/Documentation").get("short_help")
             for name, root in made.items()}
    assert short["MHAVolumeReader"] == "Read a MetaImage volume in RAS millimetres.", short
    assert made["MGHVolumeReader"].find(".//ReaderFactory").get("extensions") == "mgz mgh mgh.gz"
    page = text_of(PAGES / "filters" / "volume-readers.md")
    assert "## FreeSurfer Volume Reader\n\nOpens `.mgz`" in page, page
    assert "## NIFTI Volume Reader" not in page, "it has a page of its own"


def test_every_property_is_documented():
    for proxy in property_reference.proxies().values():
        table = property_reference.table(proxy)
        for element in proxy.properties:
            assert f"| `{element.get('name')}` |" in table, (proxy.name, element.get("name"))


def test_properties_have_their_defaults():
    tables = {proxy.name: property_reference.table(proxy)
              for proxy in property_reference.public_proxies()}
    deformation = tables["FreeFormDeformation"]
    assert "| `LatticeDimensions` | 3 × integer (points), 4 to 257 | 19 19 19 |" in deformation
    assert "| `Feather` | number (mm), at least 0 | 10 |" in deformation
    assert '| `Kernel` | "Catmull-Rom", "B-Spline" | "Catmull-Rom" |' in deformation
    assert "| `Mask` | optional input |" in deformation  # from LatticeSettings.xml
    assert "| `TraceRadius` |" in tables["TracePointsRepresentation"]  # exposed by that name


def test_numbers_of_the_panel_say_their_unit():
    elsewhere = {"Strokes", "Strength", "PointOfInterest",    # their widget or group says it
                 "LandmarkPairs", "MaximumDisplacement", "MinimumJacobian",
                 "ControlPoints", "WorldFromFile"}        # no widget shows them
    for proxy in property_reference.public_proxies():
        for element in proxy.properties:
            if (element.tag == "DoubleVectorProperty" and element.get("name") not in elsewhere
                    and element.get("panel_visibility") != "never"
                    and not (element.get("information_only")
                             and element.get("panel_visibility") is None)
                    and element.get("si_class") != "vtkSIDataArrayProperty"):
                assert property_reference.unit(element), (proxy.name, element.get("name"))


def test_states_of_python_hold_what_a_user_set():
    """ParaView leaves what panel_visibility="never" hides out of states and traces of Python."""
    of_a_moment = {"Live", "KeepPicture", "CountSamples", "SliceLegend", "VolumeLegend"}
    of_the_reader = {"Format", "FileName"}  # a list of files is in states, however hidden
    for proxy in property_reference.proxies().values():
        lost = {element.get("name") for element in proxy.properties
                if element.get("panel_visibility") == "never" and element.tag != "InputProperty"
                and not element.get("information_only")} - of_a_moment - of_the_reader
        assert not lost, (proxy.name, lost)


def test_python_reference_has_the_public_functions():
    page = python_reference.page()
    for name in ("move", "soft", "stamp", "deformed_from_rest", "rest_from_deformed", "pick",
                 "counters", "four_views", "figure", "animate", "save_field", "load_field"):
        assert f"## {name}\n" in page, name
    assert "## _" not in page


run_tests(globals())
