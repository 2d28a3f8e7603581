# SPDX-License-Identifier: BSD-3-Clause
"""Proves that ParaView's window finds an installed BrainShift. The window plays this script. The
environment variable BRAINSHIFT_WINDOW says who loads the plugin: manager (this script, by its name,
as the Plugin Manager does) or launcher (the command of the launcher entry did)."""
import os
import sys
import traceback

from paraview import servermanager, simple


def say(words):
    print(words, file=sys.__stdout__, flush=True)  # sys.stdout is the window's own


def check():
    plugins = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager()
    local = plugins.GetLocalInformation()
    names = [local.GetPluginName(i) for i in range(local.GetNumberOfPlugins())]
    assert names.count("BrainShift") == 1, names
    # the libraries beside the plugin are no plugins
    assert not [name for name in names if "vtkBrainShift" in name], names
    index = names.index("BrainShift")
    by_launcher = os.environ["BRAINSHIFT_WINDOW"] == "launcher"
    assert bool(local.GetPluginLoaded(index)) == by_launcher, local.GetPluginStatusMessage(index)
    if not by_launcher:
        simple.LoadDistributedPlugin("BrainShift", remote=False, ns=simple.__dict__)
        local = plugins.GetLocalInformation()
        assert local.GetPluginLoaded(index)
    say(f"The plugin manager lists {len(names)} plugins; loaded: {local.GetPluginFileName(index)}")
    draw()


def draw():
    import brainshift
    bent = simple.FreeFormDeformation(
        Input=simple.Wavelet(), Strokes=brainshift.stamp((0, 0, 10), (0, 0, 0), 3.0))
    display = simple.Show(bent, simple.GetActiveViewOrCreate("RenderView"))
    assert "Deformed Volume" in display.Representation.Available, display.Representation.Available
    display.Representation = "Deformed Volume"
    simple.Render()
    say("Drawn as Deformed Volume")


status = 1
try:
    check()
    status = 0
except BaseException:  # the window would stay open
    traceback.print_exc(file=sys.__stderr__)
os._exit(status)
