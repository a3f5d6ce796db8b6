"""What a call says of its work while it lasts."""

import importlib
import sys
import warnings
from typing import Any, Callable, Optional, TextIO, Tuple, Union


class _Line:
    """The last line of the terminal, taken off again when the work ends."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def say(self, line: str) -> None:
        print(f"\r\033[K{line}", file=self._stream)

    def show(self, fraction: float, quantity: str, value: float) -> None:
        print(f"\r\033[K{100 * fraction:5.1f} %  {quantity} {value:.6g}", end="", file=self._stream, flush=True)

    def close(self) -> None:
        print("\r\033[K", end="", file=self._stream, flush=True)


class _Bar:
    """The same as a bar of tqdm, which begins anew with every step of the work."""

    def __init__(self, tqdm: Any, stream: TextIO) -> None:
        self._stream = stream
        self._bar = tqdm(total=1, leave=False, file=stream, bar_format="{l_bar}{bar}| {elapsed}<{remaining}{postfix}")

    def say(self, line: str) -> None:
        self._bar.write(line, file=self._stream)
        self._bar.reset()

    def show(self, fraction: float, quantity: str, value: float) -> None:
        self._bar.n = fraction
        self._bar.set_postfix_str(f"{quantity} {value:.6g}")

    def close(self) -> None:
        self._bar.close()


class _Nothing:
    def close(self) -> None:
        pass


def _is_notebook() -> bool:
    kernel = sys.modules.get("ipykernel.zmqshell")
    return kernel is not None and kernel.ZMQInteractiveShell.initialized()


def listener(quiet: bool) -> Tuple[Optional[Callable[[str], None]], Optional[Callable[[float, str, float], None]],
                                   Union[_Bar, _Line, _Nothing]]:
    """The callbacks of a piece of work on a terminal or in a notebook: one for lines about its steps and one for its progress,
    by tqdm if that is installed, and what is to be closed at its end.
    """
    if quiet or not (sys.stderr.isatty() or _is_notebook()):
        return None, None, _Nothing()
    shown: Union[_Bar, _Line]
    try:
        # A notebook without ipywidgets gets a bar of text; the warning about it is ignored.
        with warnings.catch_warnings(action="ignore"):
            tqdm = importlib.import_module("tqdm.auto").tqdm
        shown = _Bar(tqdm, sys.stderr)
    except ImportError:
        shown = _Line(sys.stderr)
    return shown.say, shown.show, shown
