# SPDX-License-Identifier: BSD-3-Clause
"""A hand in ParaView's window: press, drag, turn the wheel and type over the active view, or the
one that over() was told. Acts inside the window's own Python only. Pixels count from the view's
lower left corner."""
import ctypes
import math
import os
import time

from paraview import simple

SHIFT, CONTROL, ALT = 0x02000000, 0x04000000, 0x08000000  # Qt::KeyboardModifiers
ESCAPE, PAGE_UP, PAGE_DOWN = 0x01000000, 0x01000016, 0x01000017  # Qt::Key; letters: their codes
_MOVE, _PRESS, _RELEASE, _DOUBLE_CLICK = 0, 1, 2, 3

NONE, MOVE, SOFT, STAMP, PULL = -1, 0, 1, 2, 3  # Tool of Stroke.h

# PyDLL: an action may run Python, which needs the lock that CDLL lets go.
_library = ctypes.PyDLL(os.environ["BRAINSHIFT_TEST_HAND"])
_library.test_hand_scale.restype = ctypes.c_double
_library.test_hand_set.restype = ctypes.c_double
_library.test_hand_label.restype = ctypes.c_char_p
_library.test_hand_cell.restype = ctypes.c_char_p
_library.test_hand_controls.restype = ctypes.c_char_p
_library.test_hand_messages.restype = ctypes.c_char_p
_library.test_hand_field.restype = ctypes.c_char_p
_library.test_hand_entries.restype = ctypes.c_char_p
_library.test_hand_answered.restype = ctypes.c_char_p
_library.test_hand_window.restype = ctypes.c_ulonglong
_library.test_hand_dialogs.restype = ctypes.c_char_p
_library.test_hand_seen_views.restype = ctypes.c_char_p
_library.test_hand_set.argtypes = [ctypes.c_char_p, ctypes.c_double]


_over = None  # a view, or the active one


def over(view=None):
    """Works in a view from now on without making it active; None: in the active view again."""
    global _over
    _over = view
    _library.test_hand_over(view.SMProxy.GetGlobalID() if view else 0)


def _from_top(y):
    return (_over or simple.GetActiveView()).ViewSize[1] - 1 - int(y)


def _mouse(kind, pixel, held, modifiers):
    _library.test_hand_mouse(kind, int(pixel[0]), _from_top(pixel[1]), int(held), modifiers)


def wait(milliseconds=0):
    """Lets the window draw what is due, and other threads of Python work."""
    end = time.monotonic() + milliseconds / 1000.0
    while True:
        left = 1000.0 * (end - time.monotonic())
        _library.test_hand_wait(max(0, min(10, int(left))))
        time.sleep(0.0005)  # lets the lock go
        if left <= 10:
            break


def hover(pixel, modifiers=0):
    _mouse(_MOVE, pixel, False, modifiers)


def press(pixel, modifiers=0):
    _mouse(_PRESS, pixel, True, modifiers)


def drag_to(pixel, modifiers=0):
    _mouse(_MOVE, pixel, True, modifiers)


def release(pixel, modifiers=0):
    _mouse(_RELEASE, pixel, False, modifiers)


def drag(start, end, steps=5, modifiers=0):
    """Presses, moves in even steps with a picture after each, and lets go."""
    hover(start, modifiers)
    press(start, modifiers)
    for step in range(1, steps + 1):
        share = step / steps
        drag_to([a + share * (b - a) for a, b in zip(start, end)], modifiers)
        wait()
    release(end, modifiers)
    wait()


def right_drag(start, end, steps=5, modifiers=0):
    """drag() with the right button."""
    _library.test_hand_right_button(1)
    drag(start, end, steps, modifiers)
    _library.test_hand_right_button(0)


def double_click(pixel):
    """Presses and lets go twice, with the left button."""
    hover(pixel)
    press(pixel)
    release(pixel)
    _mouse(_DOUBLE_CLICK, pixel, True, 0)
    release(pixel)
    wait(100)


def wheel(pixel, clicks, modifiers=0):
    """One event for each click; forward is positive."""
    for _ in range(abs(clicks)):
        _library.test_hand_wheel(
            int(pixel[0]), _from_top(pixel[1]), 1 if clicks > 0 else -1, modifiers)


def key_down(key, modifiers=0):
    _library.test_hand_key(key if isinstance(key, int) else ord(key.upper()), 1, modifiers)


def key_up(key, modifiers=0):
    _library.test_hand_key(key if isinstance(key, int) else ord(key.upper()), 0, modifiers)


def tap(key, modifiers=0):
    key_down(key, modifiers)
    key_up(key, modifiers)


def shortcut(letter, modifiers=0):
    """Types a letter that is a shortcut of the window."""
    _library.test_hand_shortcut(ord(letter.upper()), modifiers)


def is_checked(name):
    """Whether an action of menu or toolbar is checked."""
    return bool(_library.test_hand_is_checked(name.encode()))


def take(tool):
    """Takes a tool in hand, or NONE."""
    setting("tool", tool)
    wait()


def setting(name, value=math.nan):
    """Sets a property of the tool settings (ToolSettings.h); returns what it is afterwards."""
    return _library.test_hand_set(name.encode(), value)


def action(name):
    """Triggers an action of menu or toolbar; False if there is none or it is disabled."""
    return bool(_library.test_hand_action(name.encode()))


def create_filter(name):
    """Makes a filter of the active source, as the menu Filters does: undo takes it back."""
    _library.test_hand_create_filter(name.encode())


def create_filter_of_two(name, source, input_name, other):
    """Makes a filter of two sources, as the menu does once its dialog has been answered."""
    _library.test_hand_create_filter_of_two(
        name.encode(), source.SMProxy.GetGlobalID(), input_name.encode(),
        other.SMProxy.GetGlobalID())


def open_file(path):
    """Opens a file as File > Open does; click("Accept") applies it."""
    _library.test_hand_open(path.encode())


def click(name):
    """Presses a button of the window; False if there is none or it is disabled."""
    return bool(_library.test_hand_click(name.encode()))


def in_sight(name):
    """Whether a widget of the window is seen whole."""
    return bool(_library.test_hand_in_sight(name.encode()))


def is_visible(name):
    """Whether the window shows a widget."""
    return bool(_library.test_hand_is_visible(name.encode()))


def label(name):
    """The text of a label or of a field of a number of the window, or what another widget tells
    screen readers."""
    return _library.test_hand_label(name.encode()).decode()


def cut_off():
    """How many pixels of the panel the dock cuts off at the right."""
    return _library.test_hand_cut_off()


def is_enabled(name):
    """Whether the panel lets one edit a property; None if the panel does not show it."""
    enabled = _library.test_hand_is_enabled(name.encode())
    return None if enabled < 0 else bool(enabled)


def choose(name, entry):
    """Chooses in the list of a property that the panel shows; False if there is none."""
    chosen = bool(_library.test_hand_choose(name.encode(), entry.encode()))
    wait(100)
    return chosen


def entries(name):
    """The present entry of a list of the window, and all of them."""
    present, *every = _library.test_hand_entries(name.encode()).decode().split("\n")
    return present, every


def choose_by_keys(name, entry):
    """Opens a list of the window and chooses by Down or Up, and Enter; False if it has no such
    entry."""
    chosen = bool(_library.test_hand_choose_by_keys(name.encode(), entry.encode()))
    wait(100)
    return chosen


def drop(name, *paths):
    """Drops files onto a widget; whether it takes them."""
    return bool(_library.test_hand_drop(name.encode(), "\n".join(paths).encode()))


def answer(dialog, button, choose=("", "")):
    """Answers a dialog as soon as it is seen: chooses in a list of it, and presses a button."""
    _library.test_hand_answer(
        dialog.encode(), choose[0].encode(), choose[1].encode(), button.encode())


def answer_path(dialog, path):
    """Chooses a path in a file dialog as soon as it is seen."""
    _library.test_hand_answer_path(dialog.encode(), path.encode())


def answered():
    """The rows of the table of the dialog that was answered last: lists of texts."""
    lines = _library.test_hand_answered().decode().split("\n")
    return [line.split("\t") for line in lines if line]


def type_into(name, text):
    """Types into a field of the window, or the first one of a property that the panel shows, in
    place of what it holds; False if there is none."""
    return bool(_library.test_hand_type(name.encode(), str(text).encode()))


def field(owner, name):
    """The text of a field of a property that the panel shows."""
    return _library.test_hand_field(owner.encode(), name.encode()).decode()


def owner_of(name):
    """Whose tool a window is, as the window manager is told: the number of the window that it
    stays above, or 0. And the number of the main window."""
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XOpenDisplay.restype = ctypes.c_void_p
    display = ctypes.c_void_p(x11.XOpenDisplay(None))
    above = ctypes.c_ulong(0)
    x11.XGetTransientForHint(
        display, ctypes.c_ulong(_library.test_hand_window(name.encode())), ctypes.byref(above))
    x11.XCloseDisplay(display)
    return above.value, _library.test_hand_window(b"")


def remake_window():
    """Gives the main window another number, as Qt does by itself at times."""
    _library.test_hand_remake_window()
    wait(100)


def focus():
    """Gives the view the keyboard, as a click in it does."""
    _library.test_hand_focus()


def focus_on(name):
    """Gives a field of the window the keyboard; whether it has it."""
    return bool(_library.test_hand_focus_on(name.encode()))


def deactivate():
    """Another window of the desktop gets the keyboard."""
    _library.test_hand_deactivate()


def has_focus():
    """Whether the view has the keyboard."""
    return bool(_library.test_hand_has_focus())


def keeps_focus(name):
    """Clicks a button of the window with the mouse; whether the view keeps the keyboard."""
    return bool(_library.test_hand_keeps_focus(name.encode()))


def controls(name):
    """What can be operated inside a widget, in the order of the Tab key: class, object name, what
    screen readers are told, whether Tab reaches it, and its height in the widget (pixels)."""
    lines = _library.test_hand_controls(name.encode()).decode().splitlines()
    found = [line.split("\t") for line in lines]
    return [(kind, own, told, tab == "1", int(y)) for kind, own, told, tab, y in found]


def cell(name, row, column):
    """A cell of a list: whether it is checked (None: it has no check box), is bold, has a sign, and
    its text. None without such a row."""
    told = _library.test_hand_cell(name.encode(), row, column).decode()
    if not told:
        return None
    check, bold, sign, text = told.split("\t")
    return {"1": True, "0": False}.get(check), bold == "1", sign == "1", text


def click_cell(name, row, column=0, check=False):
    """Clicks a cell of a list with the mouse, on its check box or on its middle."""
    return bool(_library.test_hand_click_cell(name.encode(), row, column, int(check)))


def shows_all(name):
    """Whether a label of the window has room for all of its text."""
    return bool(_library.test_hand_shows_all(name.encode()))


def dark(is_dark):
    """Gives the window the colours of a dark theme, or those it had."""
    _library.test_hand_dark(int(is_dark))
    wait(100)


def scale():
    """Pixels of the screen for a logical pixel of the view, along a side."""
    return _library.test_hand_scale()


def save_picture(file, name=""):
    """Writes a widget, by its object name, or the whole screen as a picture."""
    return bool(_library.test_hand_picture(name.encode(), os.fspath(file).encode()))


def is_there():
    """Whether this Python is that of ParaView's window."""
    return bool(_library.test_hand_is_there())


def quit():
    """Closes ParaView when Python is done."""
    _library.test_hand_quit()


def close_view(view):
    """Presses the cross of a view's frame; False if there is none."""
    return press_frame(view, "Close")


def press_frame(view, button):
    """Presses a button of a view's frame: Close, Maximize, Restore, Split Horizontal Axis or Split
    Vertical Axis. False if there is none to press."""
    pressed = bool(_library.test_hand_frame(view.SMProxy.GetGlobalID(), button.encode()))
    wait(100)
    return pressed


def fill_frame(kind="Render View"):
    """Makes a view in an empty frame that is seen, by its button; False if there is none."""
    pressed = bool(_library.test_hand_fill_frame(kind.encode()))
    wait(100)
    return pressed


def seen_views():
    """The numbers of the proxies of views that are on the screen."""
    return [int(number) for number in _library.test_hand_seen_views().decode().split()]


def new_layout():
    """Opens a new tab of views, as the tab + does."""
    _library.test_hand_new_layout()
    wait(100)


def show_layout(tab):
    """Brings a tab of views to the front; from 0."""
    _library.test_hand_show_layout(tab)
    wait(100)


def close_layout(tab):
    """Closes a tab with its views; from 0."""
    _library.test_hand_close_layout(tab)
    wait(100)


def shown_layout():
    """The tab of views at the front; from 0."""
    return _library.test_hand_shown_layout()


def save_state(path):
    """As File > Save State does."""
    _library.test_hand_save_state(os.fspath(path).encode())


def load_state(path):
    """As File > Load State does: what is there stays."""
    _library.test_hand_load_state(os.fspath(path).encode())
    wait(300)


def select(source):
    """Clicks a source in the pipeline browser; False if it is not there."""
    return bool(_library.test_hand_select(source.SMProxy.GetGlobalID()))


def click_eye(source):
    """Clicks the eye of a source in the pipeline browser; False if it is not there."""
    return bool(_library.test_hand_eye(source.SMProxy.GetGlobalID()))


def delete_selected(downstream=False):
    """As Edit > Delete does with what is selected; `downstream`: and with what is made of it."""
    _library.test_hand_delete(int(downstream))
    wait(50)


def reset_session():
    """As Edit > Reset Session does: nothing is left but an empty view."""
    _library.test_hand_reset_session()
    wait(300)


def send_dialogs_away():
    """From now on dialogs are sent away, as Escape does; dialogs() says which."""
    _library.test_hand_send_dialogs_away()


def dialogs():
    """What dialogs that were sent away said, since the last call."""
    return _library.test_hand_dialogs().decode().splitlines()


def messages():
    """What Output Messages holds, one message each, and whether its window is shown."""
    told = _library.test_hand_messages().decode().splitlines()
    return told, bool(_library.test_hand_shows_messages())


def forget_messages():
    """Empties Output Messages."""
    _library.test_hand_forget_messages()


def close_messages():
    """Closes Output Messages, as its cross does."""
    _library.test_hand_close_messages()
    wait(50)


def resize_window(width, height):
    _library.test_hand_resize_window(width, height)
    wait(200)


def resize(width, height):
    """Gives a lone view a size of its own, and the window one that shows all of it."""
    _library.test_hand_resize(width, height)
    wait(100)
