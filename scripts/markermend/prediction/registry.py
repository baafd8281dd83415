"""The predictors by name: how a config's list of members becomes objects."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from markermend.options.prediction import (
    BoleroOptions,
    GaussianProcessOptions,
    GlobalRegressionOptions,
    IteratedSvdOptions,
    KalmanSmootherOptions,
    LaggedRegressionOptions,
    LocalRidgeOptions,
    NeuralNetworkOptions,
    ReferenceTriangleOptions,
    ReplicatedNetworkOptions,
    WeightedPcaOptions,
)
from markermend.prediction.global_regression import GlobalRegression
from markermend.prediction.interpolation import KINDS, Interpolation
from markermend.prediction.lagged_regression.polynomial import Polynomial
from markermend.prediction.lagged_regression.predictor import LAGGED_REGRESSIONS
from markermend.prediction.lagged_regression.replicated_network import ReplicatedNetwork
from markermend.prediction.local_ridge.gaussian_process import LocalGaussian
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.low_rank.iterated_svd import IteratedSvd
from markermend.prediction.low_rank.weighted_pca import WeightedPca
from markermend.prediction.neural_network.predictor import KINDS as NETWORKS
from markermend.prediction.neural_network.predictor import Network
from markermend.prediction.reference_triangle import LocalGRNN, LocalInterpolation, LocalQuadratic
from markermend.prediction.scene import Predictor
from markermend.prediction.state_space.bolero import Bolero
from markermend.prediction.state_space.kalman_smoother import KalmanSmoother

FAMILIES = {
    "local_ridge": "the predictor local_ridge",
    "variants": "members that are local_ridge with other settings, by their names",
    "interpolation": "the predictors linear, spline, pchip and makima",
    "polynomial": "the predictor polynomial",
    "replicated_network": "the predictor replicated_network",
    "linear_regression": "the predictor linear_regression",
    "reference_frame": "local_interpolation, local_quadratic and local_grnn",
    "msvd": "the predictor msvd",
    "weighted_pca": "the predictor weighted_pca",
    "kalman": "the predictor kalman",
    "bolero": "the predictor bolero",
    "local_gp": "the predictor local_gp beyond those of local_ridge",
    "networks": "network_linear, network_tanh, network_lstm, network_gru and network_bilstm",
}
"""The families that have settings, and whose settings they are."""

SHARED = ("local_ridge", "interpolation", *LAGGED_REGRESSIONS)
"""Families with a section of the config of their own, because several stages use them."""

Settings = Mapping[str, Mapping[str, Any]]
"""Settings by family; those of families that are not asked for may be absent."""


def _interpolation(kind: str) -> Callable[[Settings], Predictor]:
    return lambda settings: Interpolation(kind, **settings["interpolation"])


def _network(name: str) -> Callable[[Settings], Predictor]:
    return lambda settings: Network(name, NeuralNetworkOptions(**settings["networks"]))


REGISTRY: dict[str, Callable[[Settings], Predictor]] = {
    **{kind: _interpolation(kind) for kind in KINDS},
    **{name: _network(name) for name in NETWORKS},
    "polynomial": lambda settings: Polynomial(LaggedRegressionOptions(**settings["polynomial"])),
    "replicated_network": lambda settings: ReplicatedNetwork(
        ReplicatedNetworkOptions(**settings["replicated_network"])
    ),
    "linear_regression": lambda settings: GlobalRegression(GlobalRegressionOptions(**settings["linear_regression"])),
    "local_interpolation": lambda settings: LocalInterpolation(ReferenceTriangleOptions(**settings["reference_frame"])),
    "local_quadratic": lambda settings: LocalQuadratic(ReferenceTriangleOptions(**settings["reference_frame"])),
    "local_grnn": lambda settings: LocalGRNN(ReferenceTriangleOptions(**settings["reference_frame"])),
    "msvd": lambda settings: IteratedSvd(IteratedSvdOptions(**settings["msvd"])),
    "weighted_pca": lambda settings: WeightedPca(WeightedPcaOptions(**settings["weighted_pca"])),
    "kalman": lambda settings: KalmanSmoother(KalmanSmootherOptions(**settings["kalman"])),
    "bolero": lambda settings: Bolero(BoleroOptions(**settings["bolero"])),
    "local_gp": lambda settings: LocalGaussian(
        LocalRidgeOptions(**settings["local_ridge"]), GaussianProcessOptions(**settings["local_gp"])
    ),
    "local_ridge": lambda settings: LocalRidge(LocalRidgeOptions(**settings["local_ridge"])),
}
"""How to make each predictor from the settings."""


def members(names: Sequence[str], settings: Settings, *, most_frames: int | None = None) -> list[Predictor]:
    """Make the named predictors.

    most_frames: for trials, with less training: so many frames at most for local_ridge and its variants, and the
    networks' `trial_epochs`.

    Raises ValueError for a name that is neither known nor a variant, or named twice.
    """
    if most_frames is not None:
        ridge = settings["local_ridge"]
        settings = {**settings, "local_ridge": {**ridge, "frames": min(ridge["frames"], most_frames)}}
        if "networks" in settings:
            networks = settings["networks"]
            settings = {**settings, "networks": {**networks, "epochs": networks["trial_epochs"]}}
    variants = settings.get("variants", {})
    unknown = [name for name in names if name not in REGISTRY and name not in variants]
    if unknown:
        raise ValueError(f"unknown member {', '.join(unknown)}: known are {', '.join([*REGISTRY, *variants])}")
    if len(set(names)) < len(names):
        raise ValueError(f"a member is named twice: {', '.join(names)}")
    made: list[Predictor] = []
    for name in names:
        if name in variants:
            variant = LocalRidge(LocalRidgeOptions(**{**settings["local_ridge"], **variants[name]}))
            variant.name = name
            made.append(variant)
        else:
            made.append(REGISTRY[name](settings))
    return made
