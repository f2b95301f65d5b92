# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
# Types; what arguments and values mean is in the docstrings, help(sigloc) shows them.
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, Optional, Union

import numpy
import numpy.typing

_Float64 = numpy.typing.NDArray[numpy.float64]
_Float32 = numpy.typing.NDArray[numpy.float32]
_Int8 = numpy.typing.NDArray[numpy.int8]
_Path = Union[str, os.PathLike[str]]
_Numbers = numpy.typing.ArrayLike

__all__ = [
    "Answer",
    "Decision",
    "Hypothesis",
    "Landmarks",
    "Localizer",
    "Log",
    "Map",
    "Policy",
    "Region",
    "Scan",
    "Step",
    "Tracker",
    "Verdict",
    "__version__",
    "probability_text",
    "write_log",
]

__version__: str

class Map:
    @staticmethod
    def load(
        path: _Path, *, resolution: float = 0.0, heights: tuple[float, float] = (0.2, 1.5)
    ) -> Map: ...
    @staticmethod
    def from_grid(
        array: numpy.typing.NDArray[Any], resolution: float, origin: _Numbers = (0.0, 0.0)
    ) -> Map: ...
    def save(self, path: _Path) -> None: ...
    @property
    def area(self) -> float: ...
    @property
    def walls(self) -> _Float64: ...  # (N, 4)
    @property
    def grid(self) -> Optional[_Int8]: ...  # (height, width)
    @property
    def resolution(self) -> Optional[float]: ...
    @property
    def origin(self) -> Optional[tuple[float, float]]: ...
    @property
    def warning(self) -> Optional[str]: ...
    def __len__(self) -> int: ...

class Scan:
    def __init__(
        self,
        ranges: _Numbers,  # (N,)
        angle_min: float,
        angle_increment: float,
        *,
        range_min: float = 0.0,
        range_max: float = ...,
        pose: _Numbers = (0.0, 0.0, 0.0),
        sigma: float = 0.01,
    ) -> None: ...
    @property
    def ranges(self) -> _Float32: ...  # (N,)
    @property
    def angle_min(self) -> float: ...
    @property
    def angle_increment(self) -> float: ...
    @property
    def range_max(self) -> float: ...
    @property
    def sigma(self) -> float: ...
    @property
    def pose(self) -> _Float64: ...  # (3,)
    @property
    def points(self) -> _Float64: ...  # (M, 2)
    def __len__(self) -> int: ...

class Landmarks:
    def __init__(self, positions: _Numbers, *, sigma: float = 0.05) -> None: ...
    @property
    def positions(self) -> _Float64: ...  # (N, 2)
    def __len__(self) -> int: ...

_Observations = Union[Scan, Landmarks, Sequence[Union[Scan, Landmarks]]]

class Step:
    @property
    def time(self) -> float: ...
    @property
    def motion(self) -> Optional[_Float64]: ...  # (3,)
    @property
    def motion_covariance(self) -> Optional[_Float64]: ...  # (3, 3)
    @property
    def observations(self) -> list[Union[Scan, Landmarks]]: ...

class Log:
    def __init__(self, path: _Path, *, heights: tuple[float, float] = (0.2, 1.5)) -> None: ...
    def __iter__(self) -> Iterator[Step]: ...
    def __next__(self) -> Step: ...
    @property
    def truncated(self) -> bool: ...

def write_log(
    path: _Path, entries: Iterable[tuple[float, Union[Scan, _Numbers], str]]
) -> tuple[int, int]: ...

def probability_text(probability: float, digits: int = 3) -> str: ...

class Verdict:
    LOCALIZED: Verdict
    AMBIGUOUS: Verdict
    NOT_HERE: Verdict
    TOO_LITTLE_SEEN: Verdict
    __members__: dict[str, Verdict]
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __index__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __eq__(self, other: object) -> bool: ...
    def __ne__(self, other: object) -> bool: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Hypothesis:
    @property
    def pose(self) -> _Float64: ...  # (3,)
    @property
    def covariance(self) -> _Float64: ...  # (3, 3)
    @property
    def probability(self) -> float: ...
    @property
    def id(self) -> Optional[int]: ...
    @property
    def age(self) -> Optional[int]: ...

class Answer:
    @property
    def verdict(self) -> Verdict: ...
    @property
    def probability(self) -> float: ...
    @property
    def elsewhere(self) -> float: ...
    @property
    def reason(self) -> str: ...
    @property
    def hypotheses(self) -> list[Hypothesis]: ...
    @property
    def poses(self) -> _Float64: ...  # (N, 3)
    @property
    def covariances(self) -> _Float64: ...  # (N, 3, 3)
    @property
    def probabilities(self) -> _Float64: ...  # (N,)

class Region:
    def __init__(
        self,
        x_min: float,
        x_max: float,
        y_min: float,
        y_max: float,
        heading: float = 0.0,
        heading_tolerance: float = ...,
    ) -> None: ...
    @property
    def x_min(self) -> float: ...
    @property
    def x_max(self) -> float: ...
    @property
    def y_min(self) -> float: ...
    @property
    def y_max(self) -> float: ...
    @property
    def heading(self) -> float: ...
    @property
    def heading_tolerance(self) -> float: ...

class Localizer:
    def __init__(
        self,
        map: Map,
        *,
        mode: int = ...,
        use_dense_field: bool = ...,
        max_candidates: int = ...,
        min_beams: int = ...,
        seed: int = ...,
    ) -> None: ...
    def localize(self, observations: _Observations, region: Optional[Region] = None) -> Answer: ...

class Tracker:
    def __init__(
        self,
        localizer: Localizer,
        *,
        max_hypotheses: int = ...,
        localized_probability: float = ...,
        prune_weight: float = ...,
        evidence_distance: float = ...,
        evidence_turn: float = ...,
        lost_distance: float = ...,
        min_elsewhere: float = ...,
        relocation_distance: float = ...,
        confirmation_distance: float = ...,
        score_drop: float = ...,
        suspicion: float = ...,
        free_motion_sigma: float = ...,
        free_turn_sigma: float = ...,
    ) -> None: ...
    def step(
        self,
        observations: _Observations,
        motion: Optional[_Numbers] = None,  # (3,)
        motion_covariance: Optional[_Numbers] = None,  # (3, 3)
    ) -> Answer: ...
    @property
    def answer(self) -> Answer: ...
    @property
    def relocated(self) -> bool: ...
    def reset(self, region: Optional[Region] = None) -> None: ...

class Decision:
    @property
    def state(self) -> str: ...
    @property
    def pose(self) -> Optional[_Float64]: ...  # (3,)
    @property
    def covariance(self) -> Optional[_Float64]: ...  # (3, 3)
    @property
    def announce(self) -> bool: ...
    @property
    def restart(self) -> bool: ...
    @property
    def alarm(self) -> bool: ...
    @property
    def message(self) -> str: ...

class Policy:
    def __init__(
        self,
        *,
        confirm_steps: int = ...,
        confirm_time: float = ...,
        agree_distance: float = ...,
        agree_turn: float = ...,
        lost_time: float = ...,
        disagree_time: float = ...,
        settle_time: float = ...,
        attempt_time: float = ...,
        max_attempts: int = ...,
    ) -> None: ...
    def update(
        self,
        time: float,
        answer: Answer,
        motion: Optional[_Numbers] = None,  # (3,)
        filter_pose: Optional[_Numbers] = None,  # (3,)
        localize_alone: Optional[Callable[[], Answer]] = None,
    ) -> Decision: ...
    def request_restart(self) -> None: ...
