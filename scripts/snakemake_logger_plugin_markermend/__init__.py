"""A logger plug-in of Snakemake: tells the command `markermend` which jobs begin and end, a line of JSON each.

Writes: the file that `--logger-markermend-events` names. Snakemake finds the plug-in by the name of this package.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, field
from logging import ERROR, LogRecord
from pathlib import Path
from typing import Any

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent
from snakemake_interface_logger_plugins.settings import LogHandlerSettingsBase

FIELDS = {
    LogEvent.RUN_INFO: ("stats",),
    LogEvent.JOB_INFO: ("jobid", "rule_name", "wildcards"),
    LogEvent.JOB_FINISHED: ("job_id",),
}
"""What is told of each event."""


@dataclass
class LogHandlerSettings(LogHandlerSettingsBase):
    """Settings of the plug-in.

    Attributes
    ----------
    events : Path or None
        The file that events are written to.
    """

    events: Path | None = field(default=None, metadata={"help": "File that events are written to", "type": Path})


class LogHandler(LogHandlerBase):
    """Writes events, and messages of errors; Snakemake's own output stays as it is."""

    def emit(self, record: LogRecord) -> None:
        """Write an event; see `logging.Handler.emit`."""
        if isinstance(self.settings, LogHandlerSettings) and self.settings.events:
            with self.settings.events.open("a", encoding="utf-8") as file:
                file.writelines(json.dumps(told) + "\n" for told in _told(record))

    @property
    def writes_to_stream(self) -> bool:
        """See `LogHandlerBase`."""
        return False

    @property
    def writes_to_file(self) -> bool:
        """See `LogHandlerBase`: no file that Snakemake should name."""
        return False

    @property
    def has_filter(self) -> bool:
        """See `LogHandlerBase`: Snakemake's filter follows its flags of quietness."""
        return True

    @property
    def has_formatter(self) -> bool:
        """See `LogHandlerBase`."""
        return True

    @property
    def needs_rulegraph(self) -> bool:
        """See `LogHandlerBase`."""
        return False


def _told(record: LogRecord) -> Iterator[dict[str, Any]]:
    """What is told of a record: nothing of most."""
    event = getattr(record, "event", None)
    if event in FIELDS:
        yield {"event": str(event), **{name: getattr(record, name) for name in FIELDS[event]}}
    elif event == LogEvent.GROUP_INFO:
        for job in vars(record)["jobs"]:
            wildcards = job.wildcards_dict
            yield {
                "event": str(LogEvent.JOB_INFO),
                "jobid": job.jobid,
                "rule_name": job.rule.name,
                "wildcards": wildcards,
            }
    elif event == LogEvent.ERROR or (event is None and record.levelno >= ERROR):
        yield {"event": str(LogEvent.ERROR), "message": record.getMessage()}
