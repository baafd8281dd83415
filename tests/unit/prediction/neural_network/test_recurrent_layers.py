"""Recurrent layers: outputs are those of the equations, frame by frame, and gradients those of finite differences."""

import pytest
import torch

from markermend.prediction.neural_network.recurrent_layers import gru, lstm


def drive_and_weights(gates, *, networks=2, sequences=3, frames=5, units=4):
    generator = torch.Generator().manual_seed(gates)
    drive = torch.randn(networks, sequences, frames, gates * units, generator=generator, dtype=torch.float64)
    former = torch.randn(networks, units, gates * units, generator=generator, dtype=torch.float64)
    return drive.requires_grad_(), former.requires_grad_()


def lstm_step(sums, former, output, memory):
    entry, keep, leave, candidate = (sums + output @ former).chunk(4, -1)
    memory = keep.sigmoid() * memory + entry.sigmoid() * candidate.tanh()
    return leave.sigmoid() * memory.tanh(), memory


def gru_step(sums, former, output, memory):
    units = output.shape[-1]
    update, reset = (sums[..., : 2 * units] + output @ former[..., : 2 * units]).sigmoid().chunk(2, -1)
    candidate = (sums[..., 2 * units :] + (reset * output) @ former[..., 2 * units :]).tanh()
    return (1 - update) * output + update * candidate, memory


@pytest.mark.parametrize(("layer", "step", "gates"), [(lstm, lstm_step, 4), (gru, gru_step, 3)])
def test_outputs_are_those_of_the_equations(layer, step, gates):
    drive, former = drive_and_weights(gates)
    output = memory = torch.zeros(2, 3, 4, dtype=torch.float64)
    found = layer(drive, former)
    for t in range(5):
        output, memory = step(drive[:, :, t], former, output, memory)
        assert torch.allclose(found[:, :, t], output, rtol=0, atol=1e-12)


@pytest.mark.parametrize(("layer", "gates"), [(lstm, 4), (gru, 3)])
@pytest.mark.parametrize("sizes", [{}, {"networks": 1, "sequences": 1}, {"frames": 1}])
def test_gradients_are_those_of_finite_differences(layer, gates, sizes):
    assert torch.autograd.gradcheck(layer, drive_and_weights(gates, **sizes))


@pytest.mark.parametrize(("layer", "gates"), [(lstm, 4), (gru, 3)])
def test_nothing_given_is_modified(layer, gates):
    drive, former = drive_and_weights(gates, networks=1, sequences=1)
    before = drive.detach().clone(), former.detach().clone()
    layer(drive, former).sum().backward()
    assert torch.equal(drive, before[0])
    assert torch.equal(former, before[1])
