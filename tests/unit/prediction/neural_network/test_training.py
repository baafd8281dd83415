"""Training side by side against plain networks of torch.nn, each on its own with torch's optimiser."""

from dataclasses import replace

import numpy as np
import pytest
import torch
from torch import nn

from markermend.options.prediction.neural_network import NeuralNetworkOptions
from markermend.prediction.neural_network.architecture import GATES
from markermend.prediction.neural_network.training import TrainingSet, evaluate, initial, train

KINDS = ("linear", "tanh", "lstm", "gru", "bilstm")
OPTIONS = NeuralNetworkOptions(
    dense_units=4,
    recurrent_units=5,
    epochs=15,
    learning_rate=0.05,
    momentum=0.8,
    learning_rate_factor=0.9,
    learning_rate_epochs=6,
    max_gradient_norm=0.3,
    batch_networks=8,
    seed=7,
)


def training_set(seed, *, inputs=6, lengths=(20,), size=1.0):
    """Smooth inputs, and targets that depend on them now and before."""
    rng = np.random.default_rng(seed)
    x = [np.cumsum(rng.standard_normal((length, inputs)), axis=0) / 4 for length in lengths]
    mixing = rng.standard_normal((inputs, 3))
    y = [size * np.tanh((part + np.roll(part, 1, axis=0)) @ mixing / inputs) for part in x]
    return TrainingSet(x, y)


class GatedUnits(nn.Module):
    """Gated recurrent units as the paper writes them: the reset gate acts before the multiplication."""

    def __init__(self, inputs, units):
        super().__init__()
        self.entry = nn.Linear(inputs, 3 * units).double()
        self.former = nn.Parameter(torch.zeros(units, 3 * units, dtype=torch.float64))
        self.units = units

    def forward(self, x):
        h, out = torch.zeros(self.units, dtype=torch.float64), []
        for row in self.entry(x):
            n = self.units
            update = torch.sigmoid(row[:n] + h @ self.former[:, :n])
            reset = torch.sigmoid(row[n : 2 * n] + h @ self.former[:, n : 2 * n])
            candidate = torch.tanh(row[2 * n :] + (reset * h) @ self.former[:, 2 * n :])
            h = (1 - update) * h + update * candidate
            out.append(h)
        return torch.stack(out)


class Twin(nn.Module):
    """One network of torch's own layers."""

    def __init__(self, kind, weights):
        super().__init__()
        self.kind = kind
        recurrent = {"lstm": 3, "gru": 3, "bilstm": 6}.get(kind, 0)
        parts = [torch.from_numpy(part) for part in weights]
        size = parts[0].shape[0]
        if kind == "gru":
            self.recurrent = GatedUnits(size, parts[1].shape[0])
            self.recurrent.entry.weight.data, self.recurrent.entry.bias.data = parts[0].T.clone(), parts[2][0].clone()
            self.recurrent.former.data = parts[1].clone()
        elif kind in GATES:
            units = parts[1].shape[0]
            self.recurrent = nn.LSTM(size, units, bidirectional=kind == "bilstm").double()
            # torch.nn has the gates in the order input, forget, candidate, output
            order = torch.cat([torch.arange(units) + units * gate for gate in (0, 1, 3, 2)])
            for d, suffix in enumerate(("", "_reverse")[: recurrent // 3]):
                entry, former, constants = parts[3 * d : 3 * d + 3]
                getattr(self.recurrent, f"weight_ih_l0{suffix}").data = entry.T[order].clone()
                getattr(self.recurrent, f"weight_hh_l0{suffix}").data = former.T[order].clone()
                getattr(self.recurrent, f"bias_ih_l0{suffix}").data = constants[0][order].clone()
                second = getattr(self.recurrent, f"bias_hh_l0{suffix}")
                second.data.zero_()
                second.requires_grad_(False)
        dense = []
        for entry, constants in zip(parts[recurrent::2], parts[recurrent + 1 :: 2], strict=True):
            layer = nn.Linear(*entry.shape).double()
            layer.weight.data, layer.bias.data = entry.T.clone(), constants[0].clone()
            dense.append(layer)
        *hidden, self.last = dense
        self.hidden = nn.ModuleList(hidden)

    def forward(self, x):
        if self.kind in GATES:
            x = self.recurrent(x) if self.kind == "gru" else self.recurrent(x)[0]
        for layer in self.hidden:
            x = layer(x) if self.kind == "linear" else torch.tanh(layer(x))
        return self.last(x)


def trained_twin(kind, task, options):
    """The twin after training with torch's optimiser, schedule and clipping."""
    twin = Twin(kind, initial(kind, task.inputs[0].shape[1], 3, options))
    free = [part for part in twin.parameters() if part.requires_grad]
    optimiser = torch.optim.SGD(free, lr=options.learning_rate, momentum=options.momentum)
    schedule = torch.optim.lr_scheduler.StepLR(optimiser, options.learning_rate_epochs, options.learning_rate_factor)
    count = sum(map(len, task.inputs))
    for _ in range(options.epochs):
        optimiser.zero_grad()
        pairs = zip(task.inputs, task.targets, strict=True)
        loss = sum((twin(torch.from_numpy(x)) - torch.from_numpy(y)).square().sum() for x, y in pairs) / count / 2
        loss.backward()
        for group in [free] if options.clipping == "network" else [[part] for part in free]:
            nn.utils.clip_grad_norm_(group, options.max_gradient_norm)
        optimiser.step()
        schedule.step()
    return twin


@pytest.mark.parametrize("published", [{}, {"recurrent_head": "direct", "clipping": "array"}])
@pytest.mark.parametrize("kind", KINDS)
def test_networks_of_a_batch_equal_twins_trained_alone(kind, published):
    """Unlike numbers of inputs, of stretches and of frames; some gradients are clipped and some are not."""
    tasks = [
        training_set(1),
        training_set(2, inputs=9, lengths=(15,), size=0.2),
        training_set(3, inputs=3, lengths=(12, 7, 1)),
    ]
    options = replace(OPTIONS, **published)
    for task, weights in zip(tasks, train(kind, tasks, options), strict=True):
        twin = trained_twin(kind, task, options)
        with torch.no_grad():
            expected = twin(torch.from_numpy(task.inputs[0])).numpy()
        assert np.abs(evaluate(kind, weights, task.inputs[0]) - expected).max() < 1e-5


@pytest.mark.parametrize("kind", KINDS)
def test_no_network_depends_on_its_batch(kind):
    tasks = [training_set(seed, inputs=3 + seed, lengths=(10 + seed, 7)) for seed in range(5)]
    together = train(kind, tasks, OPTIONS)
    for task, weights in zip(tasks, together, strict=True):
        (alone,) = train(kind, [task], OPTIONS)
        assert all(
            one.shape == other.shape and np.allclose(one, other, rtol=0, atol=1e-10)
            for one, other in zip(weights, alone, strict=True)
        )
    again = train(kind, tasks, OPTIONS)
    assert all(
        np.array_equal(a, b)
        for one, other in zip(together, again, strict=True)
        for a, b in zip(one, other, strict=True)
    )


@pytest.mark.parametrize("kind", KINDS)
def test_networks_learn(kind):
    task = training_set(4, lengths=(20, 20))
    options = replace(OPTIONS, epochs=100, learning_rate=0.2, learning_rate_factor=1.0)
    errors = []
    for weights in (initial(kind, 6, 3, options), train(kind, [task], options)[0]):
        away = [evaluate(kind, weights, x) - y for x, y in zip(task.inputs, task.targets, strict=True)]
        errors.append(np.sqrt((np.concatenate(away) ** 2).mean()))
    assert errors[1] < 0.5 * errors[0]


def test_the_gradient_of_each_network_is_clipped_on_its_own():
    """The first step is the learning rate times the gradient, which is as long as `clip` or as it was."""
    options = replace(OPTIONS, epochs=1, max_gradient_norm=0.01)
    wild, calm = training_set(1, size=1000.0), training_set(1, size=1000.0)
    start = initial("tanh", 6, 3, options)
    near = [evaluate("tanh", start, x) + 1e-4 for x in calm.inputs]
    steps = []
    for weights in train("tanh", [wild, TrainingSet(calm.inputs, near)], options):
        steps.append(np.sqrt(sum(((a - b) ** 2).sum() for a, b in zip(weights, start, strict=True))))
    assert steps[0] == pytest.approx(options.learning_rate * options.max_gradient_norm)
    assert 0 < steps[1] < 0.5 * options.learning_rate * options.max_gradient_norm


def test_each_array_of_weights_may_be_clipped_on_its_own():
    options = replace(OPTIONS, epochs=1, max_gradient_norm=0.01, clipping="array")
    start = initial("lstm", 6, 3, options)
    (weights,) = train("lstm", [training_set(1, size=1000.0)], options)
    steps = [np.sqrt(((a - b) ** 2).sum()) for a, b in zip(weights, start, strict=True)]
    assert steps == pytest.approx([options.learning_rate * options.max_gradient_norm] * len(start))


def test_weights_begin_as_the_sizes_say():
    weights = initial("bilstm", 30, 3, OPTIONS)
    units = OPTIONS.recurrent_units
    shapes = [(30, 4 * units), (units, 4 * units), (1, 4 * units)]
    dense = [(2 * units, 4), (1, 4), (4, 3), (1, 3)]
    assert [part.shape for part in weights] == [*shapes, *shapes, *dense]
    assert np.allclose(weights[1] @ weights[1].T, np.eye(units))
    assert weights[2][0].tolist() == [0.0] * units + [1.0] * units + [0.0] * 2 * units
    feed_forward = initial("tanh", 30, 3, replace(OPTIONS, dense_units=8))
    assert sum(part.size for part in feed_forward) == 275  # the paper's table 4


@pytest.mark.parametrize("kind", KINDS)
def test_single_precision_gives_almost_the_same_networks(kind):
    task = training_set(5, lengths=(20, 9))
    double, single = (train(kind, [task], replace(OPTIONS, precision=name))[0] for name in ("double", "single"))
    away = np.abs(evaluate(kind, double, task.inputs[0]) - evaluate(kind, single, task.inputs[0])).max()
    assert 0 < away < 1e-4
    assert all(part.dtype == float for part in single)
