"""Options of the whole run, and what the command of a stage is given about one recording."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal, get_args

from markermend.options.declaration import Distinct, Laboratory, NotEmpty, RegularExpression

EXPERIMENTS = "evaluate"
"""The key of the config that the experiments of the papers read, and no stage."""

FINISHING = ("fill", "export", "qc")
"""The stages that finish a recording, in their order; they share a job, `finish`."""

Stages = Literal["labels", "frames", "frozen", "tails", "peaks", "noise", "steps", "slow"]
"""The classes of artifacts that `detect` may list."""


@dataclass(frozen=True)
class GeneralOptions:
    """The whole run."""

    recordings: Annotated[str, NotEmpty, Laboratory] = "config/recordings.tsv"
    """A folder (every recording in it or below) or a table of recordings.

    Change it when you clean your own recordings; it may also be given on the command line."""

    follow_links: Annotated[bool, Laboratory] = False
    """Whether links in the folder of recordings are followed to files and folders outside of it.

    Change it when your folder of recordings consists of links. A table may name any file, links too."""

    day_folders: Annotated[tuple[Annotated[str, RegularExpression], ...], Laboratory] = (
        r"(19|20)\d\d[-_. ]?(0[1-9]|1[0-2])[-_. ]?(0[1-9]|[12]\d|3[01])",
        r"(0?[1-9]|[12]\d|3[01])[-_. ](0?[1-9]|1[0-2])[-_. ](19|20)\d\d",
        r"(new[-_ ]?)?session[-_ ]?\d*",
        r"(ses|day|visit)[-_ ]?\d+",
    )
    """Regular expressions for the whole names of folders that are days or sessions of a subject and no subjects: their recordings belong
    to the folder above or, with a subject's folder below, to that, and bear the name of the day.

    Change it when your folders of days have other names, or when such a folder is a subject of its own (`[]`)."""

    results: Annotated[str, NotEmpty, Laboratory] = "results"
    """The folder for the results.

    Change it when you clean your own recordings; it may also be given on the command line."""

    detect: Annotated[tuple[Stages, ...], Distinct, Laboratory] = get_args(Stages)
    """The classes of artifacts to look for; an empty list fills gaps only.

    Change it when your laboratory does not want a class to be touched; `[]` fills gaps only."""

    protect: Annotated[tuple[str, ...], Laboratory] = ()
    """Markers that neither repair nor filling touches, as name patterns with `*` and `?`.

    Change it when somebody cleaned markers by hand, or markers must stay as recorded."""

    decisions: Annotated[Annotated[str, NotEmpty] | None, Laboratory] = "config/decisions.tsv"
    """The table of a person's decisions on findings and gaps; `null` for none.

    Change it when you keep the table elsewhere."""


@dataclass(frozen=True)
class RecordingOptions:
    """What is known of one recording before it is read."""

    recording: str
    """Name of the recording."""

    subject: str
    """Name of the subject."""

    kind: Literal["auto", "dynamic", "static"]
    """Kind of the recording: dynamic, static (never repaired or filled), or auto (judged by name and motion)."""

    rate: float | None
    """Frame rate in Hz, in place of the file's; `none` for the file's."""

    unit: str | None = None
    """Unit of the positions, in place of the file's; `none` for the file's."""

    sha256: str | None = None
    """Checksum of the file; `none` for whatever it is."""


@dataclass(frozen=True)
class DecisionOptions:
    """What a person decided about one recording."""

    decisions: tuple[Mapping[str, Any], ...]
    """A person's decisions on the findings and gaps of the recording, as config/README.md describes them."""
