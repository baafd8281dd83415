"""Options of the predictors, which detection, repair and filling share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, Literal

from markermend.options.declaration import (
    Above,
    AtLeast,
    AtMost,
    Below,
    Changes,
    Count,
    CountOrNone,
    Millimetres,
    NotEmpty,
    NotNegative,
    Positive,
    PositiveMillimetres,
    PositiveSeconds,
    Seconds,
    Share,
    Unit,
)


@dataclass(frozen=True)
class LocalRidgeOptions:
    """Ridge regression on the neighbours in a local frame: local_ridge."""

    anchors: Annotated[int, AtLeast(3)] = 3
    """Markers that carry the local frame."""

    inputs: Count = 12
    """Neighbours from which a marker is predicted, at most.

    Change it when marker sets have fewer than ten markers (lower)."""

    min_anchor_extent_mm: Millimetres = 15
    """Anchors are added while their extent across their longest direction is below this."""

    ridge_mm2: Annotated[float, Unit("mm^2", "square millimetres"), Above(0)] = 5
    """Penalty of the regression: the variance of the noise on an input."""

    max_training_frames: Count = 2500
    """Training frames, at most; they are evenly spaced.

    Change it when recordings are long and their motion is varied (higher, at the cost of time)."""

    min_training_frames: Count = 60
    """Frames on which marker and neighbours must be seen for a model."""

    outlier_sigmas: Positive = 6
    """Training residuals beyond this many robust standard deviations lose weight."""

    correlation_times_s: tuple[PositiveSeconds, ...] = (0.02, 0.05, 0.1, 0.2, 0.5, 1, 3)
    """Correlation times of the residual that are tried."""

    max_lag_s: PositiveSeconds = 2
    """Longest lag of the autocovariance of the residual."""

    border_s: PositiveSeconds = 0.15
    """Time on either side of a gap whose samples are used."""

    max_leverage: Positive = 20
    """Limit of the leverage of a pose, in units of its mean over the training; the expected error grows with it where poses
    are unlike those of the training."""


@dataclass(frozen=True)
class GaussianProcessOptions:
    """Gaussian process in the local frame, beyond the options of local_ridge: local_gp."""

    max_training_frames: Annotated[int, AtLeast(2)] = 500
    """Training frames, at most."""

    length_scales: Annotated[tuple[Positive, ...], NotEmpty] = (0.5, 1, 2)
    """Length scales of the radial kernel that are tried, in units of the typical distance of two poses."""

    variance_ratios: Annotated[tuple[NotNegative, ...], NotEmpty] = (3, 30)
    """Variances of the radial part that are tried, in units of the noise."""

    validation_blocks: Annotated[int, AtLeast(2)] = 6
    """Stretches that are left out in turn to choose among them."""


@dataclass(frozen=True)
class ReferenceTriangleOptions:
    """Models in the frame of three references: local_interpolation, local_quadratic and local_grnn."""

    references: Annotated[int, AtLeast(3)] = 8
    """Best references, from which triples are drawn."""

    max_training_frames: Count = 1000
    """Training frames, at most."""

    min_training_frames: Count = 60
    """Frames on which marker and triple must be seen."""

    min_height_mm: Millimetres = 5
    """Distance of the third point of a triple from the line through the other two, at least (median)."""

    kernel_width_sigmas: Positive = 0.3
    """Width of the kernel of local_grnn, in standard deviations."""

    ridge: NotNegative = 0.001
    """Penalty of local_quadratic, as a share of the training frames (0 in tits2018)."""


@dataclass(frozen=True)
class GlobalRegressionOptions:
    """Regression on all markers at a steady distance (tits2018): linear_regression."""

    max_distance_deviation_mm: Millimetres = 50
    """References whose distance varies by more than this are left out."""

    max_training_frames: Count = 1000
    """Training frames, at most."""

    min_training_frames: Count = 60
    """Frames on which marker and references must be seen for a model."""

    min_inputs: Count = 3
    """This many references are used even if their distances vary more."""

    centring: Literal["complete", "available"] = "complete"
    """What is subtracted: the mean of the markers that are never missing, or of those that are seen in each frame."""


@dataclass(frozen=True)
class IteratedSvdOptions:
    """Iterated truncated singular value decomposition: msvd."""

    neighbours: Count = 20
    """Neighbours in the model, at most."""

    max_training_frames: Count = 1000
    """Frames outside the gap, at most."""

    min_training_frames: Count = 60
    """A marker that is seen on fewer frames is left out."""

    min_joint_share: Share = 0.6
    """A neighbour that would leave less than this share of the training frames is left out (0 to 1)."""

    centred: bool = True
    """Whether the mean of the neighbours that are never missing is subtracted from each frame."""

    shrink_singular_values: bool = True
    """Whether the singular values are shrunk by the noise, or only truncated."""

    explained_variance: Share = 0.99999
    """Share of the variance that sets the rank (0 to 1)."""

    tolerance_mm: PositiveMillimetres = 0.1
    """Iteration ends when no missing sample moves by more than this."""

    max_iterations: Count = 100
    """Iterations, at most."""


@dataclass(frozen=True)
class WeightedPcaOptions:
    """Weighted principal components (Gløersen & Federolf 2016): weighted_pca."""

    strategy: Literal["together", "single"] = "single"
    """Whether all markers that are missing in the same frames are reconstructed `together`, or one at a time (`single`)."""

    max_training_frames: Count = 1000
    """Training frames, at most."""

    min_training_frames: Count = 60
    """Joint frames, at least."""

    min_inputs: Count = 3
    """If this many markers are seen throughout the gap, only these are used."""

    min_joint_share: Share = 0.6
    """A neighbour that would leave less than this share of the training frames is left out (0 to 1)."""

    weight_width_mm: PositiveMillimetres = 200
    """Width of the Gaussian by which weights fall with the distance to the marker."""

    missing_weight: Positive = 0.02
    """Weight of the markers with the gap."""

    max_distance_ratio: NotNegative = 0.5
    """Markers with gaps of their own are left out beyond this multiple of the mean distance."""

    explained_singular_values: Share = 0.99
    """Share of the sum of singular values that sets the number of components (0 to 1)."""


@dataclass(frozen=True)
class KalmanSmootherOptions:
    """Low-dimensional Kalman smoother (Burke & Lasenby 2016), the member for blackouts: kalman."""

    neighbours: Count = 20
    """Neighbours in the model, at most."""

    max_training_frames: Count = 1000
    """Training frames, at most."""

    min_training_frames: Count = 60
    """Joint frames, at least."""

    min_joint_share: Share = 0.6
    """A neighbour that would leave less than this share of the training frames is left out (0 to 1)."""

    explained_variance: Share = 0.9999
    """Share of the variance of the shape that sets the number of components (0 to 1)."""

    max_components: Count = 30
    """Components of the shape, at most."""

    min_noise_mm: PositiveMillimetres = 1
    """Deviation of a marker from the pose, at least."""

    context_s: PositiveSeconds = 0.3
    """Time on either side of a gap that the smoother uses."""

    folds: Annotated[int, AtLeast(2)] = 5
    """One in this many stretches as long as the gap is left out in turn to measure how well the pose predicts the marker."""


@dataclass(frozen=True)
class BoleroOptions:
    """Linear dynamical system with soft bone lengths (Li et al. 2009, 2010): bolero."""

    state_dimensions: Count = 16
    """Dimensions of the state, at most."""

    neighbours: Count = 8
    """Neighbours in the model, at most, without the other ends of bones."""

    centred: bool = True
    """Whether the mean of the neighbours that are never missing is subtracted from each frame."""

    context_s: PositiveSeconds = 3
    """The window extends beyond either border of the gap by one to two times this."""

    min_training_frames: Count = 60
    """Markers that are seen on fewer frames of the window are left out."""

    lag_s: Seconds = 0.05
    """Time by which the first guess of the states looks ahead; 0 leaves velocities out of it."""

    max_iterations: Count = 20
    """Steps of expectation maximisation, at most."""

    tolerance: NotNegative = 1e-4
    """Learning ends when the log-likelihood rises by less than this per observed number."""

    min_deviation_share: Positive = 0.001
    """Standard deviation of noise, innovation and bone lengths, as a share of the spread of the markers, at least."""

    bones: CountOrNone = 3
    """Bone lengths that hold for each missing marker; 0 leaves the plain linear dynamical system (DynaMMo)."""

    max_bone_frames: Count = 1000
    """Frames from which bone lengths are learned, at most."""

    max_bone_steps: Count = 10
    """Steps towards the bone lengths, at most."""


@dataclass(frozen=True)
class LaggedRegressionOptions:
    """Polynomial least squares on siblings and parent marker (skurowski2022): polynomial."""

    neighbours: Count = 6
    """Nearest neighbours that are used where siblings and parent marker are not known."""

    lags: CountOrNone = 3
    """Earlier samples that are used."""

    lag_interval_s: PositiveSeconds = 0.01
    """Time between them."""

    max_power: Count = 4
    """Highest power of a coordinate."""

    max_training_frames: Annotated[int, AtLeast(10)] = 2500
    """Training frames, at most; they are evenly spaced."""

    min_training_frames: Annotated[int, AtLeast(10)] = 60
    """Joint frames, at least."""

    min_joint_share: Share = 0.6
    """A neighbour that would leave less than this share of the frames gives way to the next nearest (0 to 1)."""


@dataclass(frozen=True)
class ReplicatedNetworkOptions(LaggedRegressionOptions):
    """Neural network with replicated outputs (skurowski2022): replicated_network."""

    lags: CountOrNone = 1
    """Earlier samples that are used."""

    max_power: Count = 2
    """Highest power of a coordinate."""

    max_training_frames: Annotated[int, AtLeast(10)] = 1500
    """Training frames, at most; they are evenly spaced."""

    moving_average_s: PositiveSeconds = 2
    """Window of the moving average of the marker's own trajectory, which is an input too.

    Change it when artifacts last longer than this."""

    hidden_units: tuple[Count, ...] = (12, 20)
    """Units of the hidden layers."""

    replicas: Count = 5
    """Copies of the output; the prediction is their mean."""

    validation_share: Annotated[float, Above(0), AtMost(0.5)] = 0.15
    """Share of the frames that is held out to decide when training stops (0 to 0.5)."""

    max_iterations: Count = 500
    """Steps of the training, at most.

    Change it when you trade time for accuracy."""

    gradient_tolerance: NotNegative = 1e-6
    """Training ends when no component of the gradient is larger."""

    curvature_step: Positive = 5e-5
    """Length of the step over which the training measures curvature."""

    patience: Count = 6
    """Training ends after this many steps without a smaller error on the held-out frames."""

    seed: CountOrNone = 1
    """Seed of the first weights."""


@dataclass(frozen=True)
class NeuralNetworkOptions:
    """Neural networks (Skurowski & Pawlyta 2021), which need torch: network_linear, _tanh, _lstm, _gru and _bilstm."""

    inputs: Count = 5
    """Neighbours that are inputs of a network, at most."""

    min_inputs: Count = 3
    """Inputs that must be seen in a frame for a prediction (all, if there are fewer)."""

    min_joint_share: Share = 0.6
    """A neighbour that would leave less than this share of the training frames is left out (0 to 1)."""

    max_training_frames: Count = 1000
    """Training frames, at most."""

    min_training_frames: Annotated[int, AtLeast(2)] = 60
    """Joint frames, at least."""

    centred: bool = True
    """Whether the mean of the inputs is subtracted from each frame."""

    dense_units: Count = 8
    """Units of the hidden dense layer."""

    recurrent_units: Count = 60
    """Units of the recurrent layer, in each direction.

    Change it when training takes too long (lower)."""

    max_sequence_s: PositiveSeconds | None = 1
    """Longest sequence of which recurrent networks are trained, each from the zero state; `null` for as long as nothing is missing.

    Change it when you repeat skurowski2021 (`null`), at ten times the time."""

    context_s: Seconds = 0.5
    """Time before and after a gap at which the networks begin."""

    epochs: Count = 600
    """Passes through the training frames."""

    pseudo_gap_epochs: Count = 200
    """Passes through the training frames on pseudo-gaps."""

    learning_rate: Positive = 0.01
    """Learning rate of the first epoch."""

    momentum: Annotated[float, AtLeast(0), Below(1)] = 0.8
    """Share of the former step in each step (0 to 1)."""

    learning_rate_factor: Annotated[float, Above(0), AtMost(1)] = 0.9
    """Factor by which the learning rate falls (0 to 1)."""

    learning_rate_epochs: Count = 10
    """Epochs after which it falls."""

    max_gradient_norm: Positive = 0.7
    """Norm of a network's gradient, at most; a larger one is scaled down."""

    batch_networks: Count = 32
    """Networks that are trained at once, at most; memory grows with it."""

    seed: CountOrNone = 1
    """Seed of the first weights."""


@dataclass(frozen=True)
class InterpolationOptions:
    """Interpolation of the marker's own trajectory: linear, spline, pchip and makima."""

    knots: Annotated[int, AtLeast(2)] = 30
    """Observed samples on either side of a gap through which an interpolation goes, at most."""


@dataclass(frozen=True)
class PredictorOptions:
    """Make the predictors, which detection, repair and filling share.

    `fill.members` may name all of them and the variants of local_ridge; `repair.methods` may name local_ridge, linear, spline,
    pchip, makima, polynomial and replicated_network, and the preset `paper` of slow changes the two last.
    """

    local_ridge: LocalRidgeOptions = field(default_factory=LocalRidgeOptions)
    """Ridge regression on the neighbours, in a local frame: the predictor of detection, repair and filling."""

    local_ridge_variants: Mapping[str, Annotated[Mapping[str, Any], Changes(LocalRidgeOptions)]] = field(
        default_factory=lambda: {
            "local_ridge_wide": {"anchors": 6, "inputs": 20},
            "local_ridge_fine": {"anchors": 4, "inputs": 8, "ridge_mm2": 1.0},
        }
    )
    """Members that are local_ridge with other options: their names, and the options in which they differ."""

    interpolation: InterpolationOptions = field(default_factory=InterpolationOptions)
    """The predictors linear, spline, pchip and makima."""

    polynomial: LaggedRegressionOptions = field(default_factory=LaggedRegressionOptions)
    """Polynomial least squares that predict a marker from its siblings and its parent marker (skurowski2022)."""

    replicated_network: ReplicatedNetworkOptions = field(default_factory=ReplicatedNetworkOptions)
    """One neural network with replicated outputs per marker, trained by scaled conjugate gradient (skurowski2022); it takes about
    half a second to a second per marker."""

    linear_regression: GlobalRegressionOptions = field(default_factory=GlobalRegressionOptions)
    """Regression on all markers at a steady distance (tits2018)."""

    reference_triangle: ReferenceTriangleOptions = field(default_factory=ReferenceTriangleOptions)
    """The predictors local_interpolation, local_quadratic and local_grnn (tits2018)."""

    msvd: IteratedSvdOptions = field(default_factory=IteratedSvdOptions)
    """Iterated truncated singular value decomposition."""

    weighted_pca: WeightedPcaOptions = field(default_factory=WeightedPcaOptions)
    """Weighted principal components (Gløersen & Federolf 2016)."""

    kalman: KalmanSmootherOptions = field(default_factory=KalmanSmootherOptions)
    """Low-dimensional Kalman smoother (Burke & Lasenby 2016), the member for blackouts."""

    bolero: BoleroOptions = field(default_factory=BoleroOptions)
    """Linear dynamical system with soft bone lengths (Li et al. 2009, 2010)."""

    local_gp: GaussianProcessOptions = field(default_factory=GaussianProcessOptions)
    """Gaussian process in the local frame, beyond the options of local_ridge."""

    neural_networks: NeuralNetworkOptions = field(default_factory=NeuralNetworkOptions)
    """The predictors network_linear, network_tanh, network_lstm, network_gru and network_bilstm (Skurowski & Pawlyta 2021),
    which need torch."""
