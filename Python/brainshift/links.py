# SPDX-License-Identifier: BSD-3-Clause
"""Keeps a property equal in several displays or views."""

import itertools

#: Of the names of links. ParaView's window keeps links so named out of its link manager, which
#: would empty the undo stack when one goes: see Interaction/Workarounds/QuietLinks.h.
PREFIX = "BrainShift "


def link(proxies, group, name):
    """Keeps a property equal in all proxies from now on, also after a view is closed.

    When a view is closed, ParaView's link keeps a null pointer to its proxy and follows it, and
    ParaView's window drops the whole link. So the link is then made again without that proxy.

    - `proxies`: displays or views.
    - `group`: where they are registered, `"representations"` or `"views"`.
    """
    from paraview import servermanager

    manager = servermanager.ProxyManager()
    made = servermanager.vtkSMPropertyLink()
    link_name = f"{PREFIX}{name}{proxies[0].SMProxy.GetGlobalIDAsString()}"
    linked = {manager.GetProxyName(group, proxy.SMProxy): proxy.SMProxy.GetGlobalID()
              for proxy in proxies}

    def remaining():
        found = ((manager.SMProxyManager.GetProxy(group, registered), number)
                 for registered, number in linked.items())
        return [proxy for proxy, number in found
                if proxy is not None and proxy.GetGlobalID() == number]  # a name may be reused

    def relink(*_):
        made.RemoveAllLinks()
        left = remaining()
        if len(left) < 2:
            return
        if manager.SMProxyManager.GetRegisteredLink(link_name) != made:
            manager.RegisterLink(link_name, made)
        for proxy, direction in itertools.product(left, (made.INPUT, made.OUTPUT)):
            made.AddLinkedProperty(proxy, name, direction)

    for proxy in proxies:
        proxy.SMProxy.AddObserver("DeleteEvent", relink)
    relink()
