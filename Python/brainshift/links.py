# SPDX-License-Identifier: BSD-3-Clause
"""Keeps a property equal in several displays or views."""

import contextlib
import itertools

#: Of the names of links. ParaView's window keeps links so named out of its link manager, which
#: would empty the undo stack when one goes: see Interaction/Workarounds/QuietLinks.h.
PREFIX = "BrainShift "


@contextlib.contextmanager
def _unrecorded(manager):
    """What is done here is nothing to undo: undo would restore links to views that are gone."""
    builder = manager.GetUndoStackBuilder()
    before = builder.GetIgnoreAllChanges() if builder else False
    if builder:
        builder.SetIgnoreAllChanges(True)
    try:
        yield
    finally:
        if builder:
            builder.SetIgnoreAllChanges(before)


def _registered(manager, group):
    """All proxies of a group. Not by name: views of two layouts have the same names."""
    from paraview.modules.vtkRemotingServerManager import vtkSMProxyIterator

    each = vtkSMProxyIterator()
    each.SetSessionProxyManager(manager.SMProxyManager)
    each.SetModeToOneGroup()
    each.Begin(group)
    while not each.IsAtEnd():
        yield each.GetProxy()
        each.Next()


def link(proxies, group, name):
    """Keeps a property equal in all proxies from now on, also after a view is closed.

    When a view is closed, ParaView's link keeps a null pointer to its proxy and follows it. So the
    link is then made again without that proxy. In a window Interaction/Workarounds/QuietLinks.h
    does that, and takes in again what undo brings back.

    - `proxies`: displays or views.
    - `group`: where they are registered, `"representations"` or `"views"`.
    """
    from paraview import servermanager

    manager = servermanager.ProxyManager()
    registered = f"{PREFIX}{name}{proxies[0].SMProxy.GetGlobalIDAsString()}"
    linked = [proxy.SMProxy.GetGlobalID() for proxy in proxies]

    def add(made, members):
        for proxy, direction in itertools.product(members, (made.INPUT, made.OUTPUT)):
            made.AddLinkedProperty(proxy, name, direction)

    # It holds no link. One that ends with the last of its proxies, while that lets go of what
    # observes it, would search the list that goes for ever.
    def leave_out(*_):
        made = manager.SMProxyManager.GetRegisteredLink(registered)
        if made is None:
            return
        left = [proxy for proxy in _registered(manager, group) if proxy.GetGlobalID() in linked]
        if made.GetNumberOfLinkedObjects() > 2 * len(left):  # in a window QuietLinks was faster
            with _unrecorded(servermanager.vtkSMProxyManager.GetProxyManager()):
                made.RemoveAllLinks()
                add(made, left)

    with _unrecorded(servermanager.vtkSMProxyManager.GetProxyManager()):
        made = servermanager.vtkSMPropertyLink()
        manager.RegisterLink(registered, made)
        add(made, [proxy.SMProxy for proxy in proxies])
    for proxy in proxies:
        proxy.SMProxy.AddObserver("DeleteEvent", leave_out)
