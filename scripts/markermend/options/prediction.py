"""Settings of the predictors."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class LocalRidgeOptions:
    """Settings of the local ridge (config section `local_ridge`).

    anchors: markers in the frame. inputs: neighbours regressed on. width_mm: anchors thinner than this get company.
    ridge_mm2: penalty, the variance of the noise on an input. frames: training frames at most. minimum_frames:
    fewer joint frames than this and no model is made. robust_sigmas: training residuals beyond this many robust sigmas
    lose weight. scales_s, longest_s, border_s: correlation lengths, longest lag, and reach of kriging, s. novelty:
    see Novelty.most.
    """

    anchors: int
    inputs: int
    width_mm: float
    ridge_mm2: float
    frames: int
    minimum_frames: int
    robust_sigmas: float
    scales_s: tuple[float, ...]
    longest_s: float
    border_s: float
    novelty: float


@dataclass(frozen=True)
class GaussianProcessOptions:
    """Settings of the Gaussian process beyond those of the local ridge.

    points: most training frames. lengths: reaches of the radial kernel that are tried, in units of the typical distance
    between training inputs. amplitudes: variances of the radial part that are tried, in units of the noise. blocks: the
    best is chosen by its error on so many stretches, each left out of its own training.
    """

    points: int
    lengths: tuple[float, ...]
    amplitudes: tuple[float, ...]
    blocks: int


@dataclass(frozen=True)
class ReferenceTriangleOptions:
    """Settings of the models in the frame of three references.

    references: triples are drawn from so many of the best. frames: most training frames. minimum_frames: fewer joint
    frames than this and a triple is passed over. height_mm: so is one whose third point is, at the median, nearer than
    this to the line of the first two. smoothness: width s of the GRNN's kernel, in standard deviations. ridge: penalty
    of the quadratic regression, as a share of the training frames (paper: 0).
    """

    references: int
    frames: int
    minimum_frames: int
    height_mm: float
    smoothness: float
    ridge: float


@dataclass(frozen=True)
class GlobalRegressionOptions:
    """Settings of the global linear regression.

    deviation_mm: references whose distance varies more are left out. frames: most training frames. minimum_frames:
    fewer joint frames than this and no model is made. minimum_inputs: so many references are used even if they vary
    more. centring: one of CENTRINGS.
    """

    deviation_mm: float
    frames: int
    minimum_frames: int
    minimum_inputs: int
    centring: str


@dataclass(frozen=True)
class IteratedSvdOptions:
    """Settings of the iterated truncated SVD.

    neighbours: most markers beside the one with the gap. frames: most frames outside the gap. minimum_frames: a marker
    seen in fewer is left out. share: a neighbour that leaves less than this share of them centres nothing. centred:
    subtract from each frame the mean of the neighbours that are there throughout.
    shrinkage: damp the singular values by the noise, or only truncate them. explained: share of the variance that sets
    the rank. tolerance_mm: iterate until no missing sample moves more.
    iterations: at most so many.
    """

    neighbours: int
    frames: int
    minimum_frames: int
    share: float
    centred: bool
    shrinkage: bool
    explained: float
    tolerance_mm: float
    iterations: int


@dataclass(frozen=True)
class WeightedPcaOptions:
    """Settings of the weighted principal components.

    strategy: one of STRATEGIES. frames: most training frames. minimum_frames: fewer joint frames than this and nothing
    is predicted. minimum_inputs: if so many markers are seen throughout the gap, only these are used. share: a marker
    is left out if with it fewer than this share of the training frames would remain. scale_mm: markers' weights fall
    with their distance as a Gaussian of this width. missing_weight: weight of markers with the gap. distal: markers
    with gaps of their own are left out beyond this multiple of the mean distance. explained: share of the sum of
    singular values that sets the number of components.
    """

    strategy: str
    frames: int
    minimum_frames: int
    minimum_inputs: int
    share: float
    scale_mm: float
    missing_weight: float
    distal: float
    explained: float


@dataclass(frozen=True)
class KalmanSmootherOptions:
    """Settings of the low-dimensional Kalman smoother.

    neighbours: most markers beside the one with the gap. frames: most training frames. minimum_frames: fewer joint
    frames than this and nothing is predicted. share: a marker is left out if with it fewer than this share of the
    training frames would remain. explained: share of the shape's variance that sets the number of components.
    components: at most so many. noise_mm: least deviation of a marker from the pose. context_s: how far the window
    reaches beyond the gap, s. folds: of stretches as long as the gap, one in so many is left out in turn to see how
    well the pose tells the marker.
    """

    neighbours: int
    frames: int
    minimum_frames: int
    share: float
    explained: float
    components: int
    noise_mm: float
    context_s: float
    folds: int


@dataclass(frozen=True)
class BoleroOptions:
    """Settings of the linear dynamical system with bone lengths.

    hidden: dimensions of its state, at most. neighbours: most markers beside the one with the gap, those seen in it
    first; the bones' other ends come on top. centred: whether the mean of the neighbours that are there throughout the
    window is subtracted from each frame. context_s: the window reaches beyond the gap by one to two times this, s.
    minimum_frames: markers seen on fewer frames of the window are left out. lag_s: the first guess of the states sees
    this far ahead, s; 0 leaves velocities out of it. iterations: of the learning, at most. tolerance: learning ends
    when the log-likelihood rises by less than this per observed number. floor_share: least deviation of noise, drive
    and bone lengths, and what ends the steps towards the bones, as a share of the markers' spread. bones: for each
    missing marker, how many lengths hold; 0 leaves the linear dynamical system alone (DynaMMo). frames: most frames
    that lengths are learned from. steps: most steps towards the bones.
    """

    hidden: int
    neighbours: int
    centred: bool
    context_s: float
    minimum_frames: int
    lag_s: float
    iterations: int
    tolerance: float
    floor_share: float
    bones: int
    frames: int
    steps: int


@dataclass(frozen=True)
class LaggedRegressionOptions:
    """Settings that the loose predictors share.

    nearest: so many nearest neighbours stand in for siblings and parent marker where the scene does not name them.
    lags, lag_s: samples before that are looked at, and how far apart they are. powers: highest power of a coordinate.
    frames: training frames, evenly spaced. minimum_frames: fewer joint frames than this and nothing is learned. share:
    an input that would leave less than this share of the marker's frames gives way to the next nearest neighbour.
    """

    nearest: int
    lags: int
    lag_s: float
    powers: int
    frames: int
    minimum_frames: int
    share: float


@dataclass(frozen=True)
class ReplicatedNetworkOptions(LaggedRegressionOptions):
    """Settings of the replicated network (config section `replicated_network`), beside those of LaggedRegressionOptions.

    average_s: window of the marker's own moving average, notably longer than artifacts. hidden: units of the hidden
    layers. replicas: of the output. held_out: share of the frames that are not trained on but tell when to stop.
    iterations, rest, probe, patience: of the training, see DescentOptions. seed: of the random beginning.
    """

    average_s: float
    hidden: tuple[int, ...]
    replicas: int
    held_out: float
    iterations: int
    rest: float
    probe: float
    patience: int
    seed: int


@dataclass(frozen=True)
class NeuralNetworkOptions:
    """Settings of the networks (config section `fill`, key `networks`).

    inputs: neighbours that a network is fed, at most. minimum_inputs: of these, so many must be seen in a frame to tell
    anything (all, if there are fewer). share: a neighbour that would leave less of the training frames is left out.
    frames, minimum_frames: most and fewest training frames. centred: whether the mean of the inputs is subtracted from
    each frame. units, recurrent_units: neurons of the dense and of the recurrent layer. stretch_s: recurrent networks
    learn from stretches of up to so many s, each from rest; None = as long as nothing is missing. context_s: how far
    before and behind a gap they begin. epochs, learning_rate, momentum: of the training; the rate falls by the factor
    drop every drop_every epochs. trial_epochs: in place of epochs on pseudo-gaps. clip: longest gradient. batch:
    networks trained at once, at most. seed: of the first weights.
    """

    inputs: int
    minimum_inputs: int
    share: float
    frames: int
    minimum_frames: int
    centred: bool
    units: int
    recurrent_units: int
    stretch_s: float | None
    context_s: float
    epochs: int
    trial_epochs: int
    learning_rate: float
    momentum: float
    drop: float
    drop_every: int
    clip: float
    batch: int
    seed: int
