"""The predictors by name: how a config's list of members becomes objects."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from markermend.options.prediction.predictors import PredictorOptions
from markermend.prediction.interface import Predictor
from markermend.prediction.interpolation import KINDS, Interpolation
from markermend.prediction.local_ridge.predictor import LocalRidge

Maker = Callable[[PredictorOptions], Predictor]
"""Makes a predictor from the options; most import theirs, since a stage needs few of them."""

NETWORKS = ("network_linear", "network_tanh", "network_lstm", "network_gru", "network_bilstm")
"""Names of the neural networks."""


def _interpolation(kind: str) -> Maker:
    return lambda options: Interpolation(kind, knots=options.interpolation.knots)


def _network(name: str) -> Maker:
    def make(options: PredictorOptions) -> Predictor:
        from markermend.prediction.neural_network.predictor import Network

        return Network(name, options.neural_networks)

    return make


def _polynomial(options: PredictorOptions) -> Predictor:
    from markermend.prediction.lagged_regression.polynomial import Polynomial

    return Polynomial(options.polynomial)


def _replicated_network(options: PredictorOptions) -> Predictor:
    from markermend.prediction.lagged_regression.replicated_network import ReplicatedNetwork

    return ReplicatedNetwork(options.replicated_network)


def _linear_regression(options: PredictorOptions) -> Predictor:
    from markermend.prediction.global_regression import GlobalRegression

    return GlobalRegression(options.linear_regression)


def _local_interpolation(options: PredictorOptions) -> Predictor:
    from markermend.prediction.reference_triangle import LocalInterpolation

    return LocalInterpolation(options.reference_triangle)


def _local_quadratic(options: PredictorOptions) -> Predictor:
    from markermend.prediction.reference_triangle import LocalQuadratic

    return LocalQuadratic(options.reference_triangle)


def _local_grnn(options: PredictorOptions) -> Predictor:
    from markermend.prediction.reference_triangle import LocalGRNN

    return LocalGRNN(options.reference_triangle)


def _msvd(options: PredictorOptions) -> Predictor:
    from markermend.prediction.low_rank.iterated_svd import IteratedSvd

    return IteratedSvd(options.msvd)


def _weighted_pca(options: PredictorOptions) -> Predictor:
    from markermend.prediction.low_rank.weighted_pca import WeightedPca

    return WeightedPca(options.weighted_pca)


def _kalman(options: PredictorOptions) -> Predictor:
    from markermend.prediction.state_space.kalman_smoother import KalmanSmoother

    return KalmanSmoother(options.kalman)


def _bolero(options: PredictorOptions) -> Predictor:
    from markermend.prediction.state_space.bolero import Bolero

    return Bolero(options.bolero)


def _local_gp(options: PredictorOptions) -> Predictor:
    from markermend.prediction.local_ridge.gaussian_process import LocalGaussian

    return LocalGaussian(options.local_ridge, options.local_gp)


REGISTRY: dict[str, Maker] = {
    **{kind: _interpolation(kind) for kind in KINDS},
    **{name: _network(name) for name in NETWORKS},
    "polynomial": _polynomial,
    "replicated_network": _replicated_network,
    "linear_regression": _linear_regression,
    "local_interpolation": _local_interpolation,
    "local_quadratic": _local_quadratic,
    "local_grnn": _local_grnn,
    "msvd": _msvd,
    "weighted_pca": _weighted_pca,
    "kalman": _kalman,
    "bolero": _bolero,
    "local_gp": _local_gp,
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


def known_members(options: PredictorOptions) -> dict[str, Maker]:
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


def _variant(kind: str, name: str, changes: Mapping[str, Any]) -> Maker:
    """Make local_ridge or local_gp with some options of local_ridge changed."""

    def make(options: PredictorOptions) -> Predictor:
        made = REGISTRY[kind](replace(options, local_ridge=replace(options.local_ridge, **changes)))
        made.name = name
        return made

    return make


def members(names: Sequence[str], options: PredictorOptions) -> list[Predictor]:
    """Make the named predictors.

    Parameters
    ----------
    names : sequence of str
        Names of predictors and of variants of local_ridge and local_gp.
    options : PredictorOptions
        Their options.

    Returns
    -------
    list of Predictor
        The predictors, in the order of the names.

    Raises
    ------
    ValueError
        For a name that is neither known nor a variant, or that is there twice.
    """
    known = known_members(options)
    unknown = [name for name in names if name not in known]
    if unknown:
        raise ValueError(f"unknown member {', '.join(unknown)}: known are {', '.join(known)}")
    if len(set(names)) < len(names):
        raise ValueError(f"a member is named twice: {', '.join(names)}")
    return [known[name](options) for name in names]
