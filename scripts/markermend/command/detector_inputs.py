"""What detectors are given alike: the files that they read, each read once in a process."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from markermend.command import inputs
from markermend.core.events import Event
from markermend.core.mesh import Mesh
from markermend.core.recording import Recording
from markermend.storage import mesh_file, stage_files


class DetectorInputs:
    """The inputs of one detector, or of several that run one after the other on a recording.

    No detector modifies what it is given. A file must not change once it was read.
    """

    def __init__(self) -> None:
        self._checksums: dict[Path, str] = {}
        self._recordings: dict[Path, Recording] = {}
        self._meshes: dict[Path, Mesh] = {}
        self._events: dict[Path, list[Event]] = {}

    def checksums(self, paths: Path | Sequence[Path], *, own: Path) -> str | list[str]:
        """Compute the checksums of inputs, which are then as they were written.

        Parameters
        ----------
        paths : Path or sequence of Path
            One input or several.
        own : Path
            The folder of what the stage is about.

        Returns
        -------
        str or list of str
            Their sha256.

        Raises
        ------
        BadRecording
            Where one is not there.
        SetAside
            Where one is damaged, and could not be made anew.
        """
        return self._checksum(paths, own) if isinstance(paths, Path) else [self._checksum(path, own) for path in paths]

    def _checksum(self, path: Path, own: Path) -> str:
        """The checksum of one input."""
        if path not in self._checksums:
            checksum = inputs.checksums(path, own=own)
            assert isinstance(checksum, str)
            self._checksums[path] = checksum
        return self._checksums[path]

    def recording(self, path: Path) -> Recording:
        """Read trajectories.

        Parameters
        ----------
        path : Path
            The trajectories as ingested.

        Returns
        -------
        Recording
            The recording.

        Raises
        ------
        SetAside
            If an earlier stage set the recording aside.
        """
        if path not in self._recordings:
            self._recordings[path] = stage_files.read_recording(path)
        return self._recordings[path]

    def mesh(self, path: Path, recording: Recording) -> Mesh:
        """Read the mesh of a recording.

        Parameters
        ----------
        path : Path
            The meshes of its subject.
        recording : Recording
            The recording, always the same.

        Returns
        -------
        Mesh
            Its functional body mesh.

        Raises
        ------
        SetAside
            Where the mesh stage set the subject aside.
        """
        if path not in self._meshes:
            self._meshes[path] = mesh_file.read(path, recording.facts["recording"], recording.markers)
        return self._meshes[path]

    def events(self, paths: Sequence[Path]) -> list[Event]:
        """Read what earlier detectors found.

        Parameters
        ----------
        paths : sequence of Path
            The events of each of them.

        Returns
        -------
        list of Event
            The events of all.

        Raises
        ------
        SetAside
            If an earlier stage set the recording aside.
        """
        for path in paths:
            if path not in self._events:
                self._events[path] = stage_files.read_events(path)
        return [event for path in paths for event in self._events[path]]
