"""The user's callbacks for the events of a frame."""

from __future__ import annotations

import warnings
from typing import Any, Callable, Dict, List, TypeVar

from ._errors import SslamWarning
from ._sslam import Result

Callback = TypeVar("Callback", bound=Callable[[Any], Any])

EVENTS = ("frame_tracked", "keyframe_made", "loop_closed", "maps_joined", "map_changed", "warning")


def warn(line: str, level: int) -> None:
    """Of the caller's caller, and so on: as warnings.warn counts from here."""
    warnings.warn(line, SslamWarning, stacklevel=level)


class Callbacks:
    """Callbacks by event, in the order in which they were added."""

    def __init__(self) -> None:
        self._told: Dict[str, List[Callable[[Any], Any]]] = {event: [] for event in EVENTS}

    def add(self, event: str, callback: Callback) -> Callback:
        self._of_event(event)
        if not callable(callback):
            raise TypeError(f"callback: expected a function, not {type(callback).__name__}")
        self._told[event].append(callback)
        return callback

    def remove(self, event: str, callback: Callable[[Any], Any]) -> None:
        if callback not in self._of_event(event):
            raise ValueError(f"callback: {callback!r} is not called at {event}")
        self._told[event].remove(callback)

    def tell(self, result: Result) -> None:
        """To be called by the method that the user calls: warnings are those of its caller."""
        told = self._told
        for line in result.warnings:
            if not told["warning"]:
                warn(line, 4)
            for callback in tuple(told["warning"]):
                callback(line)
        happened = (True, result.keyframe, result.loop_closed, result.maps_joined, result.map_changed)
        for event, yes in zip(EVENTS, happened):
            if yes:
                for callback in tuple(told[event]):
                    callback(result)

    def _of_event(self, event: str) -> List[Callable[[Any], Any]]:
        if not isinstance(event, str) or event not in self._told:
            raise ValueError(f"event: {event!r} is not known; use one of {', '.join(EVENTS)}")
        return self._told[event]
