# SPDX-License-Identifier: BSD-3-Clause
"""Makes tables of properties from the XML that ParaView reads: for the page of each filter and for
the page that lists all of them."""

import pathlib
import xml.etree.ElementTree as ElementTree

import format_reference

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("Formats", "Filters", "Representations", "Widgets")
PROXIES = ("SourceProxy", "WriterProxy", "RepresentationProxy", "Proxy",
           "NewWidgetRepresentationProxy")
PUBLIC = PROXIES[:3]
GROUPS = (("filters", "Filters"), ("sources", "Readers"), ("writers", "Writers"),
          ("representations", "Representations"), ("misc", "For BrainShift's own use"))


def _files():
    return sorted(file for folder in FOLDERS for file in (CHECKOUT / folder).rglob("*.xml"))


def _elements():
    """(group, element) of each proxy and each extension of one."""
    roots = [ElementTree.parse(file).getroot() for file in _files()]
    for root in [*roots, *format_reference.proxies()]:
        for group in root.iter("ProxyGroup"):
            for element in group:
                if element.tag in PROXIES or element.tag == "Extension":
                    yield group.get("name"), element


def _text(element):
    documentation = element.find("Documentation")
    text = "" if documentation is None else documentation.text or ""
    return " ".join(text.split())


def _children(element):
    """What a proxy consists of, with the settings of a lattice where it takes them."""
    for child in element:
        if child.tag == "LatticeSettings":
            yield from ElementTree.parse(CHECKOUT / "Filters/Proxies/LatticeSettings.xml").getroot()
        else:
            yield child


class Proxy:
    """A proxy of the XML: name, title, documentation, and its properties as XML elements."""

    def __init__(self, group, element):
        self.group, self.name, self.kind = group, element.get("name"), element.tag
        self.title = element.get("label") or self.name
        self.text = _text(element)
        self.properties = []
        self.add(element)

    def add(self, element):
        self.properties += [child for child in _children(element)
                            if child.tag.endswith("Property") and _text(child)]


def _title_representations(proxies, extensions):
    """What users choose in the menu Representation, and the names properties are exposed by."""
    for extension in extensions:
        subproxy = extension.find("RepresentationType")
        if subproxy is None:
            continue
        proxy = proxies["representations", subproxy.get("subproxy")]
        proxy.title = subproxy.get("text")
        exposed = {entry.get("name"): entry.get("exposed_name")
                   for entry in extension.iter("Property") if entry.get("exposed_name")}
        for found in proxy.properties:
            found.set("name", exposed.get(found.get("name"), found.get("name")))


def proxies():
    """All proxies of the XML by (group, name), each with the properties of its extensions."""
    found, extensions = {}, []
    for group, element in _elements():
        if element.tag == "Extension":
            extensions.append((group, element))
        else:
            found[group, element.get("name")] = Proxy(group, element)
    for group, extension in extensions:
        if (group, extension.get("name")) in found:
            found[group, extension.get("name")].add(extension)
    _title_representations(found, [extension for _, extension in extensions])
    return found


def public_proxies():
    """What users choose: filters, readers, writers, representations."""
    return [proxy for proxy in proxies().values()
            if proxy.kind in PUBLIC and proxy.group != "misc"]


def _range(domain):
    """"from 0 to 1", from what the domain says; of several components the first one."""
    least, greatest = (domain.get(end, "").split()[:1] for end in ("min", "max"))
    return " ".join([f"at least {least[0]}"] if least and not greatest else
                    [f"{least[0]} to {greatest[0]}"] if least else [])


def unit(element):
    """The unit in the label of a property, or beside its value, if the XML says one."""
    for decorator in element.iter("PropertyWidgetDecorator"):
        if decorator.get("type") == "BrainShiftUnit":
            return decorator.get("unit")
    beside = element.find("Hints/Unit")
    return "" if beside is None else beside.get("name")


def _values(element):
    """What the property takes."""
    if element.tag in ("InputProperty", "ProxyProperty"):
        return "optional input" if element.get("null_on_empty") or (
            element.find("Hints/Optional") is not None) else "input"
    if element.tag == "Property":  # a command, or a panel of buttons
        return "none"
    entries = [f'"{entry.get("text")}"' for entry in element.iter("Entry")]
    if entries:
        return ", ".join(entries)
    if element.find("BooleanDomain") is not None:
        return "0 or 1"
    kind = {"Int": "integer", "Double": "number", "String": "text"}[
        element.tag.removesuffix("VectorProperty")]
    ranges = [_range(domain) for domain in element if domain.tag.endswith("RangeDomain")]
    if unit(element) and unit(element) not in ranges:
        kind += f" ({unit(element)})"
    kind = ", ".join([kind, *filter(None, ranges)])
    count = element.get("number_of_elements")
    if element.get("repeat_command"):
        return f"list: {kind}"
    return f"{count} × {kind}" if count and int(count) > 1 else kind


def _default(element):
    if element.get("information_only"):
        return "read only"
    default = element.get("default_values", "")
    for entry in element.iter("Entry"):
        if entry.get("value") == default:
            return f'"{entry.get("text")}"'
    return default


def table(proxy):
    """The properties as a table of Markdown."""
    if not proxy.properties:
        return "*No properties of its own.*"
    rows = ["| Property | Values | Default | Meaning |", "|---|---|---|---|"]
    for element in proxy.properties:
        meaning = _text(element).replace("|", "\\|")
        rows.append(f"| `{element.get('name')}` | {_values(element)} | {_default(element)}"
                    f" | {meaning} |")
    return "\n".join(rows)


def page():
    """All proxies with their tables, as Markdown."""
    lines = ["# Property reference", "",
             "Each property can be set in the panel and, by this name, in Python. The lists come"
             " from the files that define the properties to ParaView.", ""]
    found = sorted(proxies().values(), key=lambda proxy: proxy.title)
    for group, heading in GROUPS:
        members = [proxy for proxy in found if proxy.group == group]
        lines += [f"## {heading}", ""]
        for proxy in members:
            lines += [f"### {proxy.title}", "", proxy.text, "", table(proxy), ""]
    return "\n".join(lines)
