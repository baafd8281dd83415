"""The published detectors, with the network trained on the clean recording or on the contaminated one (skurowski2022, 3.3.3, E1, E3).

The paper does not say on which it trained. Its errors over located samples (Tables 3 to 5) are 1.04 to 1.17 mm at every share of the time and
for every class, as only those of a network are that never saw what is put in; and 6,000 contaminated recordings of 53 markers would
have been 318,000 trainings.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from markermend import api
from markermend.core import events
from markermend.core.events import Event
from markermend.core.mesh import Mesh
from markermend.core.recording import Recording
from markermend.detection.published import slow
from markermend.evaluation.artifacts2022.network_file import read_networks
from markermend.evaluation.artifacts2022.options import Artifacts2022Options
from markermend.evaluation.artifacts2022.readings import published_options
from markermend.prediction.interface import ResidualSource
from markermend.prediction.lagged_regression.predictor import TrainedRegressions
from markermend.prediction.lagged_regression.replicated_network import ReplicatedNetwork
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class PublishedDetectors:
    """The published detectors.

    Attributes
    ----------
    options : Options
        Their options; see readings.published_options.
    network : ResidualSource
        The network as the source of residuals: trained on the clean recording, or one that learns the recording that it is shown.
    """

    options: api.Options
    network: ResidualSource

    def find(self, recording: Recording, mesh: Mesh, kinds: Sequence[str] | None = None) -> dict[str, list[Event]]:
        """Find the artifacts of a recording.

        Parameters
        ----------
        recording : Recording
            The contaminated recording.
        mesh : Mesh
            Its mesh.
        kinds : sequence of str, optional
            The classes to look for; those of the options by default.

        Returns
        -------
        dict of str to list of Event
            The findings by class.
        """
        wanted = tuple(kinds if kinds is not None else self.options.general.detect)
        found = api.detect(recording, mesh, _only(self.options, [kind for kind in wanted if kind != "slow"]))
        if "slow" not in wanted:
            return found
        own, _ = slow.detect_slow(
            Scene.of(recording, mesh),
            markers=recording.markers,
            earlier=claimed(found, recording),
            options=self.options.slow.paper,
            predictor=self.network,
        )
        return {**found, "slow": sorted(own, key=lambda event: event.order)}


def network_of(options: api.Options) -> ReplicatedNetwork:
    """Make the network of the preset, untrained.

    Parameters
    ----------
    options : Options
        The options of the published detectors.

    Returns
    -------
    ReplicatedNetwork
        The network.
    """
    return slow.make_network(options.slow.paper, options.slow.predictors)


def learn(clean: Recording, options: api.Options) -> TrainedRegressions:
    """Train the networks on a clean recording.

    Parameters
    ----------
    clean : Recording
        The recording before it is contaminated.
    options : Options
        The options of the published detectors.

    Returns
    -------
    TrainedRegressions
        A network for each marker.
    """
    return network_of(options).trained_on(Scene.of(clean, api.infer_mesh([clean])))


def options_of(options: Artifacts2022Options) -> api.Options:
    """Make the options of the published detectors for the experiments.

    Parameters
    ----------
    options : Artifacts2022Options
        How the network learns.

    Returns
    -------
    Options
        The options of all stages.
    """
    return published_options({}, network_steps=options.network_steps, training_frames=options.training_frames)


def read_detectors(options: Artifacts2022Options, networks: Path | None) -> PublishedDetectors:
    """Make the published detectors for contaminated copies of a recording.

    Parameters
    ----------
    options : Artifacts2022Options
        What the network learns, and how.
    networks : Path or None
        The file of the networks that learned the clean recording; see network_file. It is not needed where they learn the contaminated one.

    Returns
    -------
    PublishedDetectors
        The detectors.

    Raises
    ------
    ValueError
        Without networks that are needed.
    """
    own = options_of(options)
    network = network_of(own)
    if options.trained_on == "contaminated":
        return PublishedDetectors(own, network)
    if networks is None:
        raise ValueError("trained_on: a network that learns the clean recording must be given (--networks)")
    return PublishedDetectors(own, read_networks(networks, network.options))


def claimed(found: Mapping[str, Sequence[Event]], recording: Recording) -> np.ndarray:
    """Mark the samples of findings.

    Parameters
    ----------
    found : mapping of str to sequence of Event
        The findings by class.
    recording : Recording
        The recording in which they are.

    Returns
    -------
    ndarray of bool, shape (frames, markers, 3)
        The samples of all of them.
    """
    every = [event for own in found.values() for event in own]
    return events.coordinates(every, recording.frames, recording.markers)


def _only(options: api.Options, kinds: Sequence[str]) -> api.Options:
    """The options with these of the classes to look for."""
    own = tuple(kind for kind in options.general.detect if kind in kinds)
    return replace(options, general=replace(options.general, detect=own))
