"""The predictors by name: how a config's list of members becomes objects."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from markermend.options.prediction.predictors import PredictorOptions
from markermend.prediction.global_regression import GlobalRegression
from markermend.prediction.interface import Predictor
from markermend.prediction.interpolation import KINDS, Interpolation
from markermend.prediction.lagged_regression.polynomial import Polynomial
from markermend.prediction.lagged_regression.replicated_network import ReplicatedNetwork
from markermend.prediction.local_ridge.gaussian_process import LocalGaussian
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.low_rank.iterated_svd import IteratedSvd
from markermend.prediction.low_rank.weighted_pca import WeightedPca
from markermend.prediction.neural_network.predictor import KINDS as NETWORKS
from markermend.prediction.neural_network.predictor import Network
from markermend.prediction.reference_triangle import LocalGRNN, LocalInterpolation, LocalQuadratic
from markermend.prediction.state_space.bolero import Bolero
from markermend.prediction.state_space.kalman_smoother import KalmanSmoother


def _interpolation(kind: str) -> Callable[[PredictorOptions], Predictor]:
    return lambda options: Interpolation(kind, knots=options.interpolation.knots)


def _network(name: str) -> Callable[[PredictorOptions], Predictor]:
    return lambda options: Network(name, options.neural_networks)


REGISTRY: dict[str, Callable[[PredictorOptions], Predictor]] = {
    **{kind: _interpolation(kind) for kind in KINDS},
    **{name: _network(name) for name in NETWORKS},
    "polynomial": lambda options: Polynomial(options.polynomial),
    "replicated_network": lambda options: ReplicatedNetwork(options.replicated_network),
    "linear_regression": lambda options: GlobalRegression(options.linear_regression),
    "local_interpolation": lambda options: LocalInterpolation(options.reference_triangle),
    "local_quadratic": lambda options: LocalQuadratic(options.reference_triangle),
    "local_grnn": lambda options: LocalGRNN(options.reference_triangle),
    "msvd": lambda options: IteratedSvd(options.msvd),
    "weighted_pca": lambda options: WeightedPca(options.weighted_pca),
    "kalman": lambda options: KalmanSmoother(options.kalman),
    "bolero": lambda options: Bolero(options.bolero),
    "local_gp": lambda options: LocalGaussian(options.local_ridge, options.local_gp),
    "local_ridge": lambda options: LocalRidge(options.local_ridge),
}
"""How to make each predictor from the options."""

POOLING = frozenset({"local_ridge", "local_gp"})
"""The predictors that learn from the subject's other recordings, too; so do their variants."""


def learn_from_pool(names: Sequence[str]) -> bool:
    """Say whether any of the named predictors learns from the subject's other recordings.

    Parameters
    ----------
    names : sequence of str
        Names of predictors and of variants of local_ridge and local_gp.

    Returns
    -------
    bool
        Whether a pool of poses would alter what they predict.
    """
    return any(name in POOLING or name not in REGISTRY for name in names)


def known_members(options: PredictorOptions) -> dict[str, Callable[[PredictorOptions], Predictor]]:
    """List the predictors and the variants of local_ridge and local_gp.

    Parameters
    ----------
    options : PredictorOptions
        The options that name the variants.

    Returns
    -------
    dict of str to Callable
        How to make each from the options, by name. Each variant local_ridge_NAME has a local_gp_NAME of the same frame and
        inputs.
    """
    known = dict(REGISTRY)
    for name, changes in options.local_ridge_variants.items():
        known[name] = _variant("local_ridge", name, changes)
        process = name.replace("local_ridge", "local_gp", 1)
        if process not in known:
            known[process] = _variant("local_gp", process, changes)
    return known


def _variant(kind: str, name: str, changes: Mapping[str, Any]) -> Callable[[PredictorOptions], Predictor]:
    """Make local_ridge or local_gp with some options of local_ridge changed."""

    def make(options: PredictorOptions) -> Predictor:
        made = REGISTRY[kind](replace(options, local_ridge=replace(options.local_ridge, **changes)))
        made.name = name
        return made

    return make


def members(
    names: Sequence[str], options: PredictorOptions, *, max_training_frames: int | None = None
) -> list[Predictor]:
    """Make the named predictors.

    Parameters
    ----------
    names : sequence of str
        Names of predictors and of variants of local_ridge and local_gp.
    options : PredictorOptions
        Their options.
    max_training_frames : int, optional
        For pseudo-gaps, with less training: training frames of local_ridge, local_gp and their variants, at most; the networks
        have their `pseudo_gap_epochs`.

    Returns
    -------
    list of Predictor
        The predictors, in the order of the names.

    Raises
    ------
    ValueError
        For a name that is neither known nor a variant, or that is there twice.
    """
    if max_training_frames is not None:
        ridge, networks = options.local_ridge, options.neural_networks
        options = replace(
            options,
            local_ridge=replace(ridge, max_training_frames=min(ridge.max_training_frames, max_training_frames)),
            neural_networks=replace(networks, epochs=networks.pseudo_gap_epochs),
        )
    known = known_members(options)
    unknown = [name for name in names if name not in known]
    if unknown:
        raise ValueError(f"unknown member {', '.join(unknown)}: known are {', '.join(known)}")
    if len(set(names)) < len(names):
        raise ValueError(f"a member is named twice: {', '.join(names)}")
    return [known[name](options) for name in names]
