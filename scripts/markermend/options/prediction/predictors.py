"""Options of all predictors, which detection, repair and filling share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any

from markermend.options.declaration import Changes
from markermend.options.prediction.global_regression import GlobalRegressionOptions
from markermend.options.prediction.interpolation import InterpolationOptions
from markermend.options.prediction.lagged_regression import LaggedRegressionOptions, ReplicatedNetworkOptions
from markermend.options.prediction.local_ridge import GaussianProcessOptions, LocalRidgeOptions
from markermend.options.prediction.low_rank import IteratedSvdOptions, WeightedPcaOptions
from markermend.options.prediction.neural_network import NeuralNetworkOptions
from markermend.options.prediction.reference_triangle import ReferenceTriangleOptions
from markermend.options.prediction.state_space import BoleroOptions, KalmanSmootherOptions


@dataclass(frozen=True)
class PredictorOptions:
    """Make the predictors, which detection, repair and filling share.

    `fill.members` may name all of them and the variants of local_ridge and local_gp; `repair.methods` may name local_ridge, linear, spline,
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
    """Members that are local_ridge with other options: their names, and the options in which they differ. Each local_ridge_NAME has
    a local_gp_NAME with the same frame and inputs."""

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
    """Gaussian process in the local frame, beyond the options of local_ridge and its variants."""

    neural_networks: NeuralNetworkOptions = field(default_factory=NeuralNetworkOptions)
    """The predictors network_linear, network_tanh, network_lstm, network_gru and network_bilstm (Skurowski & Pawlyta 2021),
    which need torch."""
