"""Scaled conjugate gradient: against its plain twin, on problems with known minima, and many at once as one by one."""

import numpy as np
import pytest

from markermend.numerics.scaled_conjugate_gradient import DescentOptions, minimise
from support.naive import numerics as naive

OPTIONS = DescentOptions(iterations=1000, gradient_tolerance=1e-8, probe=1e-6, patience=5)


def quadratics(count, size, seed=0):
    """Functions (x - middle)' A (x - middle) / 2 with eigenvalues from 0.1 to 10: an objective, and the middles."""
    rng = np.random.default_rng(seed)
    middle = rng.normal(0, 3, (count, size))
    bases = np.linalg.qr(rng.normal(size=(count, size, size)))[0]
    curved = np.einsum("bij,j,bkj->bik", bases, np.geomspace(0.1, 10, size), bases)

    def objective(parameters, which):
        gradient = np.einsum("bij,bj->bi", curved[which], parameters - middle[which])
        return np.einsum("bi,bi->b", gradient, parameters - middle[which]) / 2, gradient

    return objective, middle


def rosenbrock(parameters, which):
    """Rosenbrock's valley for points (b, 2), steeper for later problems, and its gradient; 0 at (1, 1)."""
    x, y = parameters.T
    steep = 1.0 + 10.0 * which
    value = (1 - x) ** 2 + steep * (y - x**2) ** 2
    return value, np.stack([-2 * (1 - x) - 4 * steep * x * (y - x**2), 2 * steep * (y - x**2)], axis=1)


def test_quadratics_are_solved_exactly_and_in_few_steps():
    objective, middle = quadratics(20, 8)
    result = minimise(objective, np.zeros((20, 8)), options=OPTIONS)
    assert np.allclose(result.parameters, middle, atol=1e-6)
    assert np.allclose(result.values, 0, atol=1e-12)
    assert result.iterations.max() <= 60  # eight without rounding and scale; steepest descent takes hundreds


def test_curved_valleys_are_followed_to_their_end():
    start = np.tile([-1.2, 1.0], (11, 1))
    result = minimise(rosenbrock, start, options=OPTIONS)
    assert np.allclose(result.parameters, 1, atol=1e-5)
    assert (np.diff(result.iterations[[0, 5, 10]]) > 0).all()


@pytest.mark.parametrize("iterations", [1, 2, 5, 17, 60])
def test_the_same_as_the_plain_twin(iterations):
    options = DescentOptions(iterations=iterations, gradient_tolerance=1e-8, probe=1e-6, patience=5)
    start = np.random.default_rng(1).normal(0, 1, (6, 2))
    found = minimise(rosenbrock, start, options=options).parameters
    for problem in range(6):
        twin = naive.scaled_conjugate_gradient(
            lambda w, k=problem: rosenbrock(w[None], np.array([k]))[0][0],
            lambda w, k=problem: rosenbrock(w[None], np.array([k]))[1][0],
            start[problem],
            iterations=iterations,
            rest=1e-8,
            probe=1e-6,
        )
        assert np.allclose(found[problem], twin, rtol=1e-5, atol=1e-7)


def test_each_problem_goes_its_own_way():
    objective, _ = quadratics(5, 4)
    start = np.random.default_rng(2).normal(size=(5, 4))
    together = minimise(objective, start, options=OPTIONS)
    for problem in range(5):
        alone = minimise(
            lambda parameters, which, k=problem: objective(parameters, which + k),
            start[problem : problem + 1],
            options=OPTIONS,
        )
        assert np.allclose(alone.parameters[0], together.parameters[problem], rtol=1e-9)
        assert alone.iterations[0] == together.iterations[problem]


def test_a_solved_problem_is_no_longer_evaluated():
    objective, middle = quadratics(3, 4)
    start = np.zeros((3, 4))
    start[1] = middle[1]
    asked = []

    def counted(parameters, which):
        asked.append(which.tolist())
        return objective(parameters, which)

    result = minimise(counted, start, options=OPTIONS)
    assert result.iterations[1] == 0
    assert np.array_equal(result.parameters[1], middle[1])
    assert asked[0] == [0, 1, 2] and all(1 not in which for which in asked[1:])


def test_what_was_best_on_held_out_data_is_the_result():
    objective, middle = quadratics(2, 6)
    halfway = middle / 2

    def held_out(parameters, which):
        return np.linalg.norm(parameters - halfway[which], axis=1)

    result = minimise(objective, np.zeros((2, 6)), options=OPTIONS, held_out=held_out)
    trace = [
        minimise(objective, np.zeros((2, 6)), options=DescentOptions(n, 1e-8, 1e-6, 5)).parameters
        for n in range(result.iterations.max() + 1)
    ]
    off = np.array([held_out(parameters, np.arange(2)) for parameters in trace])
    assert np.allclose(result.values, off.min(axis=0))
    best = off.argmin(axis=0)
    assert (result.iterations <= best + OPTIONS.patience).all()


def test_a_step_into_the_infinite_is_taken_back():
    def wall(parameters, which):
        with np.errstate(all="ignore"):
            value = -np.log(parameters[:, 0]) + parameters[:, 0] * 100
        return value, 100 - 1 / parameters

    result = minimise(wall, np.array([[1.0], [5.0]]), options=OPTIONS)
    assert np.allclose(result.parameters, 0.01, rtol=1e-4)


def test_no_finite_beginning_is_refused():
    with pytest.raises(ValueError, match="not finite where"):
        minimise(lambda w, which: (np.full(len(w), np.nan), w), np.zeros((1, 2)), options=OPTIONS)
